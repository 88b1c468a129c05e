//! A study of somebody else's frames.

use std::collections::BTreeSet;
use std::path::Path;

use noisefloor_io::{ReadOptions, scan_scenes};

use crate::error::HarnessError;
use noisefloor_study::{LONGEST_NAME, MethodRow, SceneSource, SceneSpec, Shot, Study};

/// A study of somebody else's frames: the folder itself, or each of its sub-folders, with a reference in it. `spp`
/// is the sample count of frames that do not say theirs; the rows are the caller's, because the harness names no
/// method.
///
/// # Errors
/// [`HarnessError::Image`] if there are no frames or no reference, [`HarnessError::Folder`] for `spp` with frames
/// of several levels, [`HarnessError::Study`] for rows of equal label.
pub fn study_of_folder(path: &Path, spp: Option<u32>, rows: Vec<MethodRow>) -> Result<Study, HarnessError> {
    let folders = scan_scenes(path, &ReadOptions { spp, ..ReadOptions::default() })?;
    let name = clean(&path.canonicalize().unwrap_or_else(|_| path.to_owned()));
    let mut levels = BTreeSet::new();
    let mut scenes = Vec::new();
    let mut taken = BTreeSet::new();
    for folder in &folders {
        levels.extend(folder.frames.iter().map(|frame| frame.spp));
        let mut id = clean(&folder.path.canonicalize().unwrap_or_else(|_| folder.path.clone()));
        let first = id.clone();
        for number in 1.. {
            if taken.insert(id.clone()) {
                break;
            }
            // One more of that name, then numbers: names stay short however many are equal.
            id = if number == 1 { format!("{first}_") } else { format!("{first}_{number}") };
        }
        let silent = folder.frames.iter().any(|frame| frame.info.spp.is_none());
        let own: BTreeSet<u32> = folder.frames.iter().map(|frame| frame.spp).collect();
        if silent && own.len() > 1 {
            return Err(HarnessError::Folder {
                path: folder.path.clone(),
                reason:
                    "some frames say their samples per pixel and some do not; give the attribute `spp` to all"
                        .into(),
            });
        }
        scenes.push(SceneSpec {
            id,
            source: SceneSource::Folder(folder.path.clone()),
            spp: silent.then(|| own.into_iter().collect()),
            replicates: None,
            shot: Shot::default(),
            sequence: None,
            set: serde_json::Map::new(),
            equal_time_spp: None,
        });
    }
    let study = Study {
        title: format!("Frames of {name}"),
        question: "On these frames of another renderer: which denoiser has the lowest error at which cost, and do the \
                   confidence intervals and error bounds hold?"
            .into(),
        width: folders[0].reference_info.width, // at least one folder by contract
        height: folders[0].reference_info.height,
        ..Study::plain(name, levels.into_iter().collect(), scenes, rows)
    };
    study.check(&path.display().to_string())?;
    Ok(study)
}

/// Last part of a path as a name without special characters.
fn clean(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // With room for what tells equal names apart.
    let most = LONGEST_NAME - 40;
    let kept: String = name
        .chars()
        .take(most)
        .map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' })
        .collect();
    if kept.is_empty() { "frames".into() } else { kept }
}
