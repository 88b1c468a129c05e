//! Where an output goes: a file to be replaced, something that is written to as it is, or standard output.

use std::fmt;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::IoError;
use crate::replace::{prepare, replace};

/// Links of a chain that leads nowhere; the system itself follows no more.
const MOST_LINKS: usize = 40;

/// Where an output goes.
///
/// A path is taken as it is found when it is written: symbolic links are followed, a regular file is replaced
/// atomically where it lies, a missing one is made, and a device, a terminal or a FIFO is written to as it is. Paths
/// turn into destinations by themselves and never mean standard output; [`Destination::from_argument`] is for words
/// of a command line, where `-` does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Destination {
    /// Standard output of the process.
    Stdout,
    /// Whatever is at this path.
    Path(PathBuf),
}

impl<P: AsRef<Path>> From<P> for Destination {
    fn from(path: P) -> Self {
        Self::Path(path.as_ref().to_owned())
    }
}

impl fmt::Display for Destination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.name().display().fmt(f)
    }
}

/// What is at a path.
enum Place {
    /// A regular file, or none yet, here behind all links.
    File(PathBuf),
    /// Written to as it is.
    Stream { append: bool },
}

impl Destination {
    /// From a word of the command line: `-` is standard output, and so is every other name of what standard output is
    /// connected to, such as `/dev/stdout` of a pipe; anything else is a path.
    #[must_use]
    pub fn from_argument(word: impl AsRef<Path>) -> Self {
        let word = word.as_ref();
        if word.as_os_str() == "-" || system::is_stdout(word) {
            Self::Stdout
        } else {
            Self::Path(word.to_owned())
        }
    }

    /// Name for messages.
    pub(crate) fn name(&self) -> &Path {
        match self {
            Self::Stdout => Path::new("standard output"),
            Self::Path(path) => path,
        }
    }

    /// The path, unless it is standard output.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Stdout => None,
            Self::Path(path) => Some(path),
        }
    }

    /// The file that will be replaced or made, behind all links; none for standard output and for what is written to
    /// as it is.
    ///
    /// # Errors
    /// [`IoError::Write`] if a folder is in the way or the path leads nowhere.
    pub fn file(&self) -> Result<Option<PathBuf>, IoError> {
        match self {
            Self::Stdout => Ok(None),
            Self::Path(path) => match place(path).map_err(|cause| IoError::write(path, cause))? {
                Place::File(file) => Ok(Some(file)),
                Place::Stream { .. } => Ok(None),
            },
        }
    }

    /// Whether writing here would write over `input`: the same file on disk, under whatever name.
    #[must_use]
    pub fn is_same_file(&self, input: &Path) -> bool {
        match self {
            Self::Stdout => system::is_stdout(input),
            Self::Path(path) => same_file(path, input),
        }
    }

    /// Finds out before any work whether a file can be written here: its folder must take a new file, and a file that
    /// is there must not be read-only. What is written to as it is, is not opened: a FIFO would wait for its reader.
    ///
    /// # Errors
    /// As [`Destination::write`].
    pub fn check(&self) -> Result<(), IoError> {
        match self.file()? {
            Some(file) => prepare(&file).map(drop).map_err(|cause| IoError::write(self.name(), cause)),
            None => Ok(()),
        }
    }

    /// Writes what `fill` writes. A regular file appears whole or not at all and keeps its permissions.
    ///
    /// # Errors
    /// [`IoError::Write`]: missing or unwritable folder, read-only file, full disk or device, reader gone, or the
    /// error that `fill` returned. A regular file that was there before is unchanged then.
    pub fn write(&self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), IoError> {
        let attempt = || match self {
            Self::Stdout => {
                let mut out = io::stdout().lock();
                fill(&mut out)?;
                out.flush()
            }
            Self::Path(path) => match place(path)? {
                Place::File(file) => replace(&file, fill),
                Place::Stream { append } => {
                    let file = OpenOptions::new().write(true).append(append).open(path)?;
                    stream(file, fill)
                }
            },
        };
        attempt().map_err(|cause| IoError::write(self.name(), cause))
    }
}

fn stream(file: File, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::new(file);
    fill(&mut buffered)?;
    buffered.flush()
}

/// Whether two paths lead to the same file on disk, through links of either kind. A path without a file is no file.
#[must_use]
pub fn same_file(one: &Path, other: &Path) -> bool {
    system::same_file(one, other)
}

fn place(path: &Path) -> io::Result<Place> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(found) if !found.is_file() => Ok(Place::Stream { append: false }),
        Ok(_) => follow(path),
        Err(error) if error.kind() == io::ErrorKind::NotFound => follow(path),
        Err(error) => Err(error),
    }
}

/// The end of a chain of symbolic links, whether or not there is a file.
fn follow(path: &Path) -> io::Result<Place> {
    let mut at = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::symlink_metadata(&at) {
            Ok(found) if found.is_symlink() => {}
            _ => return Ok(Place::File(at)),
        }
        let folder = at.parent().unwrap_or(Path::new("")).to_owned();
        // A name such as /dev/fd/3 means what the process has open, not the file that may lie there by now.
        if fs::canonicalize(&folder).is_ok_and(|folder| folder.starts_with("/proc")) {
            return Ok(Place::Stream { append: true });
        }
        at = folder.join(fs::read_link(&at)?);
    }
    Err(io::Error::other("a chain of links that does not end"))
}

#[cfg(unix)]
mod system {
    use std::fs::{self, File, Metadata};
    use std::os::fd::AsFd as _;
    use std::os::unix::fs::{FileTypeExt as _, MetadataExt as _};
    use std::path::Path;

    fn id(of: &Metadata) -> (u64, u64) {
        (of.dev(), of.ino())
    }

    pub fn same_file(one: &Path, other: &Path) -> bool {
        fs::metadata(one).is_ok_and(|one| fs::metadata(other).is_ok_and(|other| id(&one) == id(&other)))
    }

    /// Whether a path leads to what standard output is connected to. A device is not meant: whoever sends messages and
    /// an image to /dev/null says so twice.
    pub fn is_stdout(path: &Path) -> bool {
        let Ok(stdout) = std::io::stdout().as_fd().try_clone_to_owned() else { return false };
        let Ok(stdout) = File::from(stdout).metadata() else { return false };
        !stdout.file_type().is_char_device()
            && fs::metadata(path).is_ok_and(|found| id(&found) == id(&stdout))
    }
}

#[cfg(not(unix))]
mod system {
    use std::fs;
    use std::path::Path;

    pub fn same_file(one: &Path, other: &Path) -> bool {
        fs::canonicalize(one).is_ok_and(|one| fs::canonicalize(other).is_ok_and(|other| one == other))
    }

    pub fn is_stdout(_: &Path) -> bool {
        false
    }
}
