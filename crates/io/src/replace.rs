//! Regular files, replaced by renaming.

use std::fs::{self, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::{Builder, NamedTempFile};

/// Replaces or makes a regular file.
///
/// `fill` writes to a temporary file in the same folder, which is flushed to disk and renamed. If anything fails
/// the temporary file is removed and a file that was at `path` before is unchanged. A killed process can leave a
/// hidden `.tmp…` file behind, never a partial file at `path`.
pub(crate) fn replace(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let (mut temporary, before) = prepare(path)?;
    let mut buffered = BufWriter::new(temporary.as_file_mut());
    fill(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    if let Some(permissions) = before {
        temporary.as_file().set_permissions(permissions)?;
    }
    // Without this a crash of the machine could keep the rename and lose the contents.
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|failed| nameless(failed.error))?;
    Ok(())
}

/// A temporary file beside `path`, and the permissions of a file that is there already.
pub(crate) fn prepare(path: &Path) -> io::Result<(NamedTempFile, Option<Permissions>)> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let before = fs::metadata(path).ok().map(|found| found.permissions());
    // The rename would not ask.
    if before.as_ref().is_some_and(Permissions::readonly) {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is read-only"));
    }
    Ok((create_in(folder).map_err(nameless)?, before))
}

/// The system's reason without the name of the temporary file, which says nothing to the user and which `tempfile`
/// appends to the text.
fn nameless(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((reason, _)) => io::Error::new(error.kind(), reason.to_owned()),
        None => error,
    }
}

fn create_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    // Temporary files are private by default, but this one becomes an ordinary file of the user.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.prefix(".tmp").tempfile_in(folder)
}
