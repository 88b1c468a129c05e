//! What questions measure over all replicates of a level: frames and outputs beside each other and their truth.

use std::collections::BTreeMap;

use noisefloor_frame::{Frame, Image, Reference};
use noisefloor_stats::IntervalFamily;
use noisefloor_study::{BASELINE, MethodRow, RowFrames, Study};
use serde_json::Value;

use crate::cell::{Measure, PixelClasses};

/// One of a level's frames, the study's own of a replicate.
#[derive(Debug)]
pub struct LevelFrame {
    /// Its number.
    pub replicate: u32,
    /// The frame, mended.
    pub frame: Frame,
    /// Flags the pixels that were not finite on input; empty for none.
    pub invalid: Vec<bool>,
}

/// Outputs of a row, by replicate; nothing where they cannot be read.
pub type Outputs = Vec<(u32, Image)>;

/// A level of a scene with all its replicates.
#[derive(Clone, Copy)]
pub struct LevelCell<'a> {
    /// The study that asks.
    pub study: &'a Study,
    /// Scene id.
    pub scene: &'a str,
    /// Samples per pixel.
    pub spp: u32,
    /// The truth.
    pub reference: &'a Reference,
    /// Its samples per pixel; 0 if exact or unknown.
    pub reference_spp: u64,
    /// Value of every pixel and channel, where a formula gives it.
    pub known_mean: Option<f64>,
    /// What to tell apart.
    pub classes: &'a PixelClasses,
    /// The study's own frames, by replicate.
    pub frames: &'a [LevelFrame],
    /// The intervals that are judged.
    pub intervals: &'a dyn IntervalFamily,
    /// Labels of the rows that have outputs here, in the order of the study.
    pub rows: &'a [String],
    /// Reads a row's outputs, those that are there.
    pub outputs: &'a dyn Fn(&str) -> Outputs,
}

impl std::fmt::Debug for LevelCell<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LevelCell").field("spp", &self.spp).field("rows", &self.rows).finish_non_exhaustive()
    }
}

impl LevelCell<'_> {
    /// Label of the row that is the input itself, on the study's own frames.
    pub(crate) fn input_label(&self) -> &str {
        let plain = |row: &&MethodRow| row.id == BASELINE && row.frames == RowFrames::Uniform;
        self.study.methods.iter().find(plain).map_or(BASELINE, |row| row.label.as_str())
    }

    /// Each frame against the truth.
    pub(crate) fn measures(&self) -> impl Iterator<Item = Measure<'_>> {
        self.frames.iter().map(|f| {
            Measure::new(&f.frame, self.reference, self.classes, &f.invalid, false)
                .with_intervals(self.intervals)
        })
    }
}

/// A picture of something, such as where coverage is lost.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Label of the row that it is about.
    pub label: String,
    /// What it shows, for people.
    pub name: String,
    /// The picture.
    pub image: Image,
}

/// What was measured of a level.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LevelFound {
    /// By the question's id.
    pub answers: BTreeMap<String, Value>,
    /// Pictures for the viewer.
    pub maps: Vec<Map>,
}

#[cfg(test)]
pub(crate) mod made;
