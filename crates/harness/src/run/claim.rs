//! Whose folder it is, and what is in it.

use std::path::{Path, PathBuf};

use noisefloor_study::{SceneSource, Study};

use crate::error::HarnessError;
use crate::observer::Observer;
use crate::store::{Layout, Records, read_json, write_json};

/// Refuses a folder that belongs to another study; writes the study into it.
pub(super) fn claim(layout: &Layout, study: &Study, observer: &dyn Observer) -> Result<(), HarnessError> {
    let path = layout.study();
    match name_there(layout)? {
        Named::As(found) if found != study.name => {
            return Err(HarnessError::OtherStudy {
                path: layout.root().to_owned(),
                found,
                wanted: study.name.clone(),
            });
        }
        Named::As(_) | Named::Nobody => {}
        Named::Unreadable(why) => observer.warning(&format!("{}: {why}; written again", path.display())),
    }
    // Where a folder of frames stood on this machine says nothing elsewhere, and nothing here reads it again.
    let mut kept = study.clone();
    for scene in &mut kept.scenes {
        if let SceneSource::Folder(folder) = &mut scene.source {
            *folder = folder.file_name().map(PathBuf::from).unwrap_or_default();
        }
    }
    write_json(&path, &kept)
}

/// The records so far. Lines that cannot be read are set aside and told; their cells run again.
pub(super) fn open_records(layout: &Layout, observer: &dyn Observer) -> Result<Records, HarnessError> {
    let (records, damaged) = Records::open(&layout.records(), &layout.damaged())?;
    for line in damaged {
        observer.warning(&format!(
            "{}, line {}: {}; set aside in {}",
            layout.records().display(),
            line.line,
            line.why,
            file_name(&layout.damaged())
        ));
    }
    Ok(records)
}

/// A file's name without its folder, for a sentence that has named the folder.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whose folder it is.
enum Named {
    Nobody,
    As(String),
    /// The study's description is damaged, and there is no record that would tell.
    Unreadable(String),
}

/// The study that a folder belongs to: what its description says, else what its records say.
fn name_there(layout: &Layout) -> Result<Named, HarnessError> {
    match read_json::<Study>(&layout.study()) {
        Ok(study) => Ok(Named::As(study.name)),
        Err(HarnessError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
            Ok(Named::Nobody)
        }
        Err(HarnessError::Kept { message, .. }) => {
            let record = Records::read(&layout.records())?.records.into_iter().next();
            Ok(record.map_or(Named::Unreadable(message), |record| Named::As(record.study)))
        }
        Err(other) => Err(other),
    }
}
