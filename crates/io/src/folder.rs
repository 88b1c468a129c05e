use std::path::{Path, PathBuf};

use crate::read::read_info;
use crate::{FileInfo, IoError, ReadOptions};

/// A folder of frames of one scene at one or several sample counts, with their reference: what any renderer can
/// hand over. Only headers are read.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameFolder {
    /// The folder.
    pub path: PathBuf,
    /// The reference's file.
    pub reference: PathBuf,
    /// What its header says; all frames have its size.
    pub reference_info: FileInfo,
    /// The other files, by sample count and replicate. At least one.
    pub frames: Vec<FolderFrame>,
}

/// A frame of a [`FrameFolder`].
#[derive(Debug, Clone, PartialEq)]
pub struct FolderFrame {
    /// File.
    pub path: PathBuf,
    /// Samples per pixel; the rounded mean if they differ from pixel to pixel.
    pub spp: u32,
    /// Number among the frames of equal `spp`, from 0, in the order of random seeds, then of file names.
    pub replicate: usize,
    /// What its header says.
    pub info: FileInfo,
}

impl FrameFolder {
    /// Finds the frames (`*.exr`) of a folder. The reference is the one file whose name without extension has the word
    /// `ref` or `gt` in it, digits behind it or not, or `reference` anywhere.
    ///
    /// # Errors
    /// [`IoError::Read`] if the folder cannot be listed, [`IoError::NoReference`], [`IoError::ManyReferences`],
    /// [`IoError::NoFrames`], [`IoError::SizeMismatch`], [`IoError::WindowMismatch`], [`IoError::MissingSpp`] if a header has no sample count
    /// and `options` neither, and whatever [`read_info`] finds wrong with a file.
    pub fn scan(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, IoError> {
        let path = path.as_ref();
        let files = exr_files(path)?;
        if files.is_empty() {
            return Err(IoError::NoFrames { folder: path.to_owned(), children: false });
        }
        let (references, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| is_reference(file));
        let reference = match references.as_slice() {
            [one] => one.clone(),
            [] => return Err(IoError::NoReference { folder: path.to_owned(), files: others.len() }),
            [first, second, ..] => {
                let (first, second) = (file_name(first), file_name(second));
                return Err(IoError::ManyReferences { folder: path.to_owned(), first, second });
            }
        };
        if others.is_empty() {
            return Err(IoError::NoFrames { folder: path.to_owned(), children: false });
        }
        let reference_info = read_info(&reference)?;
        let frames = list(others, &reference, &reference_info, options)?;
        Ok(Self { path: path.to_owned(), reference, reference_info, frames })
    }

    /// The name of the folder, to tell the scenes of several folders apart.
    #[must_use]
    pub fn name(&self) -> String {
        let resolved = self.path.canonicalize();
        file_name(resolved.as_deref().unwrap_or(&self.path))
    }
}

/// Finds scenes: the folder itself if it holds EXR files, else each direct sub-folder that does, by name.
///
/// # Errors
/// [`IoError::NoFrames`] if there is none, and the errors of [`FrameFolder::scan`] for any of them.
pub fn scan_scenes(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Vec<FrameFolder>, IoError> {
    let path = path.as_ref();
    if !exr_files(path)?.is_empty() {
        return Ok(vec![FrameFolder::scan(path, options)?]);
    }
    let mut scenes = Vec::new();
    for child in entries(path)?.into_iter().filter(|child| child.is_dir()) {
        if !exr_files(&child)?.is_empty() {
            scenes.push(FrameFolder::scan(child, options)?);
        }
    }
    if scenes.is_empty() {
        return Err(IoError::NoFrames { folder: path.to_owned(), children: true });
    }
    Ok(scenes)
}

fn list(
    files: Vec<PathBuf>,
    reference_file: &Path,
    reference: &FileInfo,
    options: &ReadOptions,
) -> Result<Vec<FolderFrame>, IoError> {
    let mut frames = Vec::new();
    for path in files {
        let info = read_info(&path)?;
        info.window.expect(&path, &reference.window, reference_file)?;
        let spp = match (info.spp, options.spp) {
            (Some(mean), _) => mean.round() as u32, // the reader keeps it within 1 ..= u32::MAX
            (None, Some(spp)) => spp,
            (None, None) => return Err(IoError::MissingSpp { file: path }),
        };
        frames.push(FolderFrame { path, spp, replicate: 0, info });
    }
    frames.sort_by_key(|frame| (frame.spp, frame.info.provenance.seed, frame.path.clone()));
    for k in 1..frames.len() {
        if frames[k].spp == frames[k - 1].spp {
            frames[k].replicate = frames[k - 1].replicate + 1;
        }
    }
    Ok(frames)
}

fn exr_files(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let is_exr = |path: &PathBuf| {
        let hidden = file_name(path).starts_with('.');
        !hidden && path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr")) && path.is_file()
    };
    Ok(entries(folder)?.into_iter().filter(is_exr).collect())
}

/// Everything in a folder, sorted: the order of the file system is arbitrary.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let failed = |cause| IoError::read(folder, cause);
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        paths.push(entry.map_err(failed)?.path());
    }
    paths.sort();
    Ok(paths)
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn is_reference(path: &Path) -> bool {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
    let mut words = stem.split(|c: char| !c.is_alphanumeric());
    let names_it = |word: &str| matches!(word.trim_end_matches(|c: char| c.is_ascii_digit()), "ref" | "gt");
    stem.contains("reference") || words.any(names_it)
}

#[cfg(test)]
mod tests {
    use super::is_reference;
    use std::path::Path;

    #[test]
    fn references_are_told_from_words_that_look_alike() {
        for name in ["reference.exr", "kitchen_ref.exr", "GT.exr", "scene-ref4096.exr", "myReference2.exr"] {
            assert!(is_reference(Path::new(name)), "{name}");
        }
        for name in ["refraction_16.exr", "spp0016.exr", "lengthgt.exr", "prefix.exr"] {
            assert!(!is_reference(Path::new(name)), "{name}");
        }
    }
}
