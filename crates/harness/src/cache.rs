//! Rendered frames by content hash, shared by all studies of a user.

use std::path::{Path, PathBuf};

use noisefloor_frame::Frame;
use noisefloor_io::ReadOptions;
use serde::Serialize;

use crate::error::HarnessError;
use crate::store::write_whole;

/// Raise when anything changes what a key stands for.
const CACHE_VERSION: u32 = 1;

/// A content hash in hexadecimal.
pub(crate) type Key = String;

/// Hash of a serialisable description. Maps are sorted by serde_json, so equal descriptions have equal keys.
pub(crate) fn key_of(description: &impl Serialize) -> Key {
    let value = serde_json::to_value(description).unwrap_or_default();
    let mut hasher = blake3::Hasher::new();
    hasher.update(&CACHE_VERSION.to_le_bytes());
    hasher.update(value.to_string().as_bytes());
    hasher.finalize().to_hex()[..32].to_owned()
}

/// First 8 bytes of the hash of a description: a random seed.
pub(crate) fn seed_of(description: &impl Serialize) -> u64 {
    let value = serde_json::to_value(description).unwrap_or_default();
    let hash = blake3::hash(value.to_string().as_bytes());
    u64::from_le_bytes(hash.as_bytes()[..8].try_into().expect("a hash has 32 bytes"))
}

/// What the cache has under a key.
#[derive(Debug)]
pub(crate) enum Lookup {
    /// The frame, as it was written.
    Hit(Box<Frame>),
    /// Nothing.
    Miss,
    /// A file that is not what was written; it must be made again.
    Damaged(PathBuf, String),
}

/// A folder of frames, each with the hash of its bytes beside it.
#[derive(Debug, Clone)]
pub(crate) struct Cache {
    root: PathBuf,
}

impl Cache {
    pub(crate) fn open(root: &Path) -> Result<Self, HarnessError> {
        std::fs::create_dir_all(root).map_err(HarnessError::io("make folder", root))?;
        Ok(Self { root: root.to_owned() })
    }

    fn path(&self, key: &str) -> PathBuf {
        self.root.join(&key[..2]).join(format!("{key}.exr"))
    }

    /// Whether there is something under the key, not looked at.
    pub(crate) fn has(&self, key: &str) -> bool {
        let path = self.path(key);
        path.exists() && path.with_extension("b3").exists()
    }

    /// Reads a frame and checks every byte of it.
    pub(crate) fn get(&self, key: &str) -> Result<Lookup, HarnessError> {
        let path = self.path(key);
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(Lookup::Miss),
            Err(e) => return Err(HarnessError::io("read", &path)(e)),
        };
        // A process that died between the two files leaves no hash: made again, like any other damage.
        let Ok(expected) = std::fs::read_to_string(path.with_extension("b3")) else {
            return Ok(Lookup::Damaged(path, "its checksum is missing".into()));
        };
        if expected.trim() != blake3::hash(&bytes).to_hex().as_str() {
            return Ok(Lookup::Damaged(path, "its checksum does not match".into()));
        }
        match noisefloor_io::read_frame(&path, &ReadOptions::default()) {
            Ok(frame) => Ok(Lookup::Hit(Box::new(frame))),
            Err(error) => Ok(Lookup::Damaged(path, error.to_string())),
        }
    }

    /// Writes a frame, then its hash.
    pub(crate) fn put(&self, key: &str, frame: &Frame) -> Result<(), HarnessError> {
        let path = self.path(key);
        let folder = path.parent().unwrap_or(&self.root);
        std::fs::create_dir_all(folder).map_err(HarnessError::io("make folder", folder))?;
        noisefloor_io::write_frame(&path, frame)?;
        let bytes = std::fs::read(&path).map_err(HarnessError::io("read", &path))?;
        write_whole(&path.with_extension("b3"), blake3::hash(&bytes).to_hex().as_bytes())
    }
}
