//! Files that must be what was written: their hashes are in the records and in the descriptions of scenes.

use std::fs::File;
use std::path::Path;

use noisefloor_frame::{Image, Reference};
use noisefloor_io::{ReadOptions, read_color, read_reference};
use noisefloor_questions::Images;
use noisefloor_study::context::Files;
use noisefloor_study::files;

use crate::error::HarnessError;

/// The images in a study's folder.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FolderImages<'a>(pub(crate) &'a Path);

impl Images for FolderImages<'_> {
    fn color(&self, path: &str) -> Result<Image, String> {
        read_color(self.0.join(path)).map_err(|error| error.to_string())
    }

    fn reference(&self, scene: &str) -> Result<Reference, String> {
        // The sample count of a reference plays no part here.
        let options = ReadOptions { spp: Some(1), ..ReadOptions::default() };
        read_reference(self.0.join(files::reference(scene)), &options).map_err(|error| error.to_string())
    }
}

/// Hash of a file's bytes in hexadecimal.
pub(crate) fn hash_of(path: &Path) -> Result<String, HarnessError> {
    let mut file = File::open(path).map_err(HarnessError::io("read", path))?;
    let mut hasher = blake3::Hasher::new();
    std::io::copy(&mut file, &mut hasher).map_err(HarnessError::io("read", path))?;
    Ok(hasher.finalize().to_hex()[..32].to_owned())
}

/// Whether a file is what was written. Of one without a known hash, written by an older program, it is enough that it is
/// there.
pub(crate) fn whole(root: &Path, relative: &str, files: &Files) -> bool {
    let path = root.join(relative);
    match files.get(relative) {
        Some(hash) => hash_of(&path).is_ok_and(|found| found == *hash),
        None => path.is_file(),
    }
}

/// Those of the known files that are not what was written, or gone.
pub(crate) fn damaged(root: &Path, files: &Files) -> Vec<String> {
    files.keys().filter(|relative| !whole(root, relative, files)).cloned().collect()
}
