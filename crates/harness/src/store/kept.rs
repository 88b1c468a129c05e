//! Files that must be what was written: their hashes are in the records and in the descriptions of scenes.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use crate::error::HarnessError;

/// Path relative to the study's folder, and the hash of the file there.
pub(crate) type Files = BTreeMap<String, String>;

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
