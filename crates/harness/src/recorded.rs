//! Recorded studies: the numbers of a study without its images, small enough for a repository.
//!
//! A recording has `study.json`, `context.json` with everything that the analysis must know beside the records,
//! `levels.jsonl.gz` with what was measured over all replicates of levels, and `results.jsonl.gz`. It is analysed like the
//! study itself. Recordings of earlier programs have `results.jsonl` and `summary.json`; a built-in study's is understood
//! from these.

mod earlier;
mod levels;
mod packed;

use std::path::Path;

use noisefloor_questions::{Kept, flicker, summarise};
use noisefloor_study::files;
use serde::Serialize;

use crate::error::HarnessError;
use crate::looks;
use crate::machine;
use crate::store::{FolderImages, Layout, Records, read_json, write_whole};
use noisefloor_study::Study;
use noisefloor_study::context::Context;
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

/// What a study's folder keeps, that of a run or of a recording.
pub(crate) struct KeptStudy {
    pub(crate) study: Study,
    pub(crate) context: Context,
    pub(crate) records: Vec<Record>,
    /// Without images.
    pub(crate) recorded: bool,
}

impl KeptStudy {
    /// Reads the folder of a recording, also of an earlier program; `None` if it is that of a study.
    pub(crate) fn of_recording(dir: &Path) -> Result<Option<Self>, HarnessError> {
        let layout = Layout::new(dir);
        if layout.packed_records().is_file() {
            let study = read_json(&layout.study())?;
            let mut context = read_json(&layout.context())?;
            levels::give(&layout.packed_levels(), &mut context)?;
            let path = layout.packed_records();
            let records = Records::parse(&packed::read(&path)?).whole_or_error(&path)?;
            return Ok(Some(Self { study, context, records, recorded: true }));
        }
        // What is not there at all is told by who reads it.
        if layout.study().is_file() || !dir.is_dir() { Ok(None) } else { earlier::read(dir).map(Some) }
    }

    /// The analysis of it; images are looked for in `dir` unless it is a recording.
    pub(crate) fn summary(&self, dir: &Path) -> Summary {
        let images = FolderImages(dir);
        let kept = if self.recorded { Kept::Recorded } else { Kept::Images(&images) };
        summarise(&self.study, &self.context, &self.records, &kept, machine::now())
    }

    /// Reads either and changes nothing in it.
    pub(crate) fn read(dir: &Path) -> Result<Self, HarnessError> {
        if let Some(recording) = Self::of_recording(dir)? {
            return Ok(recording);
        }
        let layout = Layout::new(dir);
        let study: Study = read_json(&layout.study())?;
        let mut context: Context = read_json(&layout.context())?;
        context.looks = looks::read(&layout);
        for scene in &study.scenes {
            let path = dir.join(files::scene(&scene.id));
            if path.exists() {
                context.scenes.push(read_json(&path)?);
            }
        }
        let records = Records::read(&layout.records())?.records;
        Ok(Self { study, context, records, recorded: false })
    }
}

/// The analysis of what a study's folder or a recording keeps; writes nothing.
///
/// # Errors
/// As [`record`], for reading.
pub fn analysis_of(dir: &Path) -> Result<Summary, HarnessError> {
    let kept = KeptStudy::read(dir)?;
    Ok(kept.summary(dir))
}

/// Writes the recording of a study: `study.json`, `context.json`, `levels.jsonl.gz` and `results.jsonl.gz`. The same study gives the same
/// bytes.
///
/// `dir` is a study's folder, or a recording, also of an earlier program; `to` may be `dir`. What is measured over the
/// frames of a sequence is measured now, because that needs images.
///
/// # Errors
/// [`HarnessError::NotAStudy`] if `dir` is none, [`HarnessError::Kept`] for a damaged file, [`HarnessError::Io`] and
/// [`HarnessError::Image`] if a file cannot be read or written.
pub fn record(dir: &Path, to: &Path) -> Result<(), HarnessError> {
    let KeptStudy { study, mut context, records, recorded } = KeptStudy::read(dir)?;
    if !recorded {
        context.flicker = flicker(&study, &context, &records, &FolderImages(dir)).measured;
    }
    let layout = Layout::new(to);
    std::fs::create_dir_all(to).map_err(HarnessError::io("make folder", to))?;
    write_lines(&layout.study(), &study)?;
    levels::take(&mut context, &layout.packed_levels())?;
    write_lines(&layout.context(), &context)?;
    packed::write(&layout.packed_records(), &records)?;
    Ok(())
}

/// Compact JSON in one line.
fn write_lines(path: &Path, value: &impl Serialize) -> Result<(), HarnessError> {
    let mut text = serde_json::to_vec(value).map_err(|e| HarnessError::kept(path, e))?;
    text.push(b'\n');
    write_whole(path, &text)
}
