//! Rendered frames by content hash, shared by all studies of a user.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use noisefloor_frame::Frame;
use noisefloor_io::ReadOptions;
use serde::{Deserialize, Serialize};

use crate::error::HarnessError;
use crate::observer::Observer;
use crate::store::{hash_of, read_json, sweep, write_json};

/// Age from which a temporary file of the cache is that of a process that is gone.
const ABANDONED: Duration = Duration::from_secs(24 * 3600);

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

/// `KEY.json`: which file holds the frame, and what is known of its making that is no part of the frame. It is written
/// after that file, whose name has the first digits of its hash: whatever several processes do at once, the entry and the
/// file that it names are of one of them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Entry {
    /// Hash of the file's bytes.
    hash: String,
    /// Wall-clock seconds of rendering.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    render_seconds: Option<f64>,
    /// Threads that rendered it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    render_threads: Option<u32>,
    /// Seconds that the decisions took where to place samples, as they were printed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    density_seconds: Option<String>,
}

/// A folder of frames.
#[derive(Debug, Clone)]
pub(crate) struct Cache {
    root: PathBuf,
}

impl Cache {
    /// Opens or makes a cache, and removes what processes that were killed long ago left half written.
    pub(crate) fn open(root: &Path) -> Result<Self, HarnessError> {
        std::fs::create_dir_all(root).map_err(HarnessError::io("make folder", root))?;
        let cache = Self { root: root.to_owned() };
        cache.sweep();
        Ok(cache)
    }

    /// A cache to be asked what it has, and nothing more: it need not be there.
    pub(crate) fn unopened(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    fn sweep(&self) {
        let Ok(entries) = std::fs::read_dir(&self.root) else { return };
        for entry in entries.filter_map(Result::ok) {
            let name = entry.file_name();
            // Keys' first two digits: whatever else is in the folder is somebody else's.
            if name.len() == 2 && name.to_string_lossy().chars().all(|c| c.is_ascii_hexdigit()) {
                sweep(&entry.path(), 0, ABANDONED);
            }
        }
    }

    fn folder(&self, key: &str) -> PathBuf {
        self.root.join(&key[..2])
    }

    fn entry(&self, key: &str) -> PathBuf {
        self.folder(key).join(format!("{key}.json"))
    }

    fn file(&self, key: &str, hash: &str) -> PathBuf {
        self.folder(key).join(format!("{key}-{}.exr", hash.get(..16).unwrap_or(hash)))
    }

    /// Whether there is something under the key, not looked at.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.entry(key).exists()
    }

    /// The file of a key with its entry if it is as it was written, or what is wrong with it.
    fn look(&self, key: &str) -> Result<Result<(PathBuf, Entry), Lookup>, HarnessError> {
        let path = self.entry(key);
        let entry: Entry = match read_json(&path) {
            Ok(entry) => entry,
            Err(HarnessError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
                return Ok(Err(Lookup::Miss));
            }
            Err(HarnessError::Kept { message, .. }) => return Ok(Err(Lookup::Damaged(path, message))),
            Err(other) => return Err(other),
        };
        let file = self.file(key, &entry.hash);
        match hash_of(&file) {
            Ok(hash) if hash == entry.hash => Ok(Ok((file, entry))),
            Ok(_) => Ok(Err(Lookup::Damaged(file, "its checksum does not match".into()))),
            Err(HarnessError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
                Ok(Err(Lookup::Damaged(file, "it is missing".into())))
            }
            Err(other) => Err(other),
        }
    }

    /// Reads a frame and checks every byte of it.
    pub(crate) fn get(&self, key: &str) -> Result<Lookup, HarnessError> {
        let (path, entry) = match self.look(key)? {
            Ok(found) => found,
            Err(lookup) => return Ok(lookup),
        };
        match noisefloor_io::read_frame(&path, &ReadOptions::default()) {
            Ok(mut frame) => {
                frame.provenance.render_seconds = entry.render_seconds;
                frame.provenance.render_threads = entry.render_threads;
                if let Some(rounds) = &mut frame.provenance.rounds {
                    rounds.density_seconds = entry.density_seconds.and_then(|seconds| seconds.parse().ok());
                }
                Ok(Lookup::Hit(Box::new(frame)))
            }
            Err(error) => Ok(Lookup::Damaged(path, error.to_string())),
        }
    }

    /// The frame of a key: what is kept, or else what `make` makes, which is kept then.
    pub(crate) fn frame(
        &self,
        key: &str,
        observer: &dyn Observer,
        make: impl FnOnce() -> Result<Frame, HarnessError>,
    ) -> Result<Frame, HarnessError> {
        match self.get(key)? {
            Lookup::Hit(frame) => return Ok(*frame),
            Lookup::Miss => {}
            Lookup::Damaged(path, why) => {
                observer.warning(&format!("{}: {why}; made again", path.display()));
            }
        }
        let mut frame = make()?;
        self.put(key, &mut frame)?;
        Ok(frame)
    }

    /// Writes a frame, then its entry; does nothing if a good one is there. The file's bytes depend on what the frame
    /// carries alone.
    pub(crate) fn put(&self, key: &str, frame: &mut Frame) -> Result<(), HarnessError> {
        if self.look(key)?.is_ok() {
            return Ok(());
        }
        let folder = self.folder(key);
        std::fs::create_dir_all(&folder).map_err(HarnessError::io("make folder", &folder))?;
        let whole = frame.provenance.clone();
        let density_seconds = whole.rounds.and_then(|rounds| rounds.density_seconds).map(|s| s.to_string());
        let (render_seconds, render_threads) = (whole.render_seconds, whole.render_threads);
        // Nobody else writes here, so that the hash is that of these bytes.
        let staged = folder.join(own_name());
        let written = noisefloor_io::write_frame(&staged, frame);
        frame.provenance = whole;
        written?;
        let hash = hash_of(&staged)?;
        let path = self.file(key, &hash);
        std::fs::rename(&staged, &path).map_err(HarnessError::io("write", &path))?;
        let entry = Entry { hash, render_seconds, render_threads, density_seconds };
        write_json(&self.entry(key), &entry)
    }
}

/// A name for a temporary file that no other call and no other process uses.
fn own_name() -> String {
    static CALLS: AtomicU64 = AtomicU64::new(0);
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
    let call = CALLS.fetch_add(1, Ordering::Relaxed);
    let unique = format!("{} {call} {}", std::process::id(), now.as_nanos());
    format!(".tmp{}", &blake3::hash(unique.as_bytes()).to_hex()[..24])
}

#[cfg(test)]
mod tests {
    use noisefloor_frame::RoundsTaken;
    use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

    use super::*;

    const KEY: &str = "0123456789abcdef0123456789abcdef";

    fn frame(seed: u64) -> Frame {
        let mut frame = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), SampleLaw::Exponential, 12, 9)
            .unwrap()
            .render(4, seed);
        frame.provenance.render_seconds = Some(seed as f64);
        frame.provenance.render_threads = Some(3);
        frame.provenance.rounds = Some(RoundsTaken { count: 4, density_seconds: Some(0.5) });
        frame
    }

    fn hit(cache: &Cache) -> Option<Frame> {
        match cache.get(KEY).unwrap() {
            Lookup::Hit(frame) => Some(*frame),
            Lookup::Miss => None,
            Lookup::Damaged(path, why) => panic!("{}: {why}", path.display()),
        }
    }

    #[test]
    fn a_frame_comes_back_with_its_times_which_are_no_part_of_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::open(folder.path()).unwrap();
        assert!(hit(&cache).is_none() && !cache.has(KEY));
        cache.put(KEY, &mut frame(1)).unwrap();
        assert_eq!(hit(&cache).unwrap(), frame(1));
        let mut slower = frame(1);
        slower.provenance.render_seconds = Some(99.0);
        slower.provenance.rounds = Some(RoundsTaken { count: 4, density_seconds: Some(7.0) });
        let elsewhere = tempfile::tempdir().unwrap();
        Cache::open(elsewhere.path()).unwrap().put(KEY, &mut slower).unwrap();
        let names = |root: &Path| -> Vec<String> {
            let entries = std::fs::read_dir(root.join(&KEY[..2])).unwrap();
            let mut names: Vec<String> =
                entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
            names.sort();
            names
        };
        // The names have the hashes of the bytes.
        assert_eq!((names(folder.path()).len(), names(folder.path())), (2, names(elsewhere.path())));
    }

    #[test]
    fn a_good_entry_is_left_alone_and_a_damaged_one_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::open(folder.path()).unwrap();
        cache.put(KEY, &mut frame(1)).unwrap();
        let entry = std::fs::read(cache.entry(KEY)).unwrap();
        let mut again = frame(1);
        again.provenance.render_seconds = Some(2.0);
        cache.put(KEY, &mut again).unwrap();
        assert_eq!(std::fs::read(cache.entry(KEY)).unwrap(), entry);
        std::fs::write(cache.entry(KEY), "{").unwrap();
        assert!(matches!(cache.get(KEY).unwrap(), Lookup::Damaged(path, _) if path == cache.entry(KEY)));
        cache.put(KEY, &mut frame(1)).unwrap();
        assert_eq!(hit(&cache).unwrap(), frame(1));
    }

    #[test]
    fn writers_and_readers_at_once_never_see_a_damaged_entry() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::open(folder.path()).unwrap();
        // Worse than what can happen: the writers do not even agree about the frame.
        let frames: Vec<Frame> = (0..4).map(frame).collect();
        std::thread::scope(|scope| {
            for frame in &frames {
                scope.spawn(|| (0..8).for_each(|_| cache.put(KEY, &mut frame.clone()).unwrap()));
            }
            for _ in 0..2 {
                scope.spawn(|| (0..200).for_each(|_| drop(hit(&cache))));
            }
        });
        let found = hit(&cache).unwrap();
        assert!(frames.contains(&found), "the entry and the file are of one writer");
    }

    #[test]
    fn old_temporary_files_are_swept_and_young_ones_and_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::open(folder.path()).unwrap();
        cache.put(KEY, &mut frame(1)).unwrap();
        let inside = |name: &str| folder.path().join(&KEY[..2]).join(name);
        for name in [".tmpAb12Cd", ".tmpYoung1", ".tmp-mine", "notes.tmp"] {
            std::fs::write(inside(name), "x").unwrap();
        }
        let old = std::time::SystemTime::now() - 2 * ABANDONED;
        for name in [".tmpAb12Cd", ".tmp-mine", "notes.tmp"] {
            std::fs::File::options().write(true).open(inside(name)).unwrap().set_modified(old).unwrap();
        }
        let again = Cache::open(folder.path()).unwrap();
        assert!(!inside(".tmpAb12Cd").exists());
        assert!([".tmpYoung1", ".tmp-mine", "notes.tmp"].iter().all(|name| inside(name).exists()));
        assert_eq!(hit(&again).unwrap(), frame(1));
    }
}
