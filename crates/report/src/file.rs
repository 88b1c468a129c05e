//! Files that appear whole or not at all.

use std::fs;
use std::path::Path;

use crate::error::ReportError;

/// Writes a file whole or not at all, and its folder first.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(ReportError::write(folder))?;
    }
    Ok(noisefloor_io::write_atomically(path, |out| out.write_all(bytes))?)
}
