//! What a study will do, as one list (`plan.jsonl`): references, frames and cells, each with its key and what it costs.
//!
//! The list is made once, before any work, in the order in which it is worked off. References are ranges of samples that
//! merge in fixed order, so that a part of the list can be worked off elsewhere.

use noisefloor_frame::Sampling;
use serde::{Deserialize, Serialize};

use crate::Key;

/// Version of the plan format.
pub const PLAN_SCHEMA: u32 = 1;

/// One thing to do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "what", rename_all = "kebab-case")]
pub enum Item {
    /// The study.
    Study {
        /// [`PLAN_SCHEMA`] when written.
        schema: u32,
        /// Its name.
        study: String,
        /// Number of items that follow.
        items: usize,
    },
    /// Samples of a reference: of several ranges the mean is taken, each weighted with its samples, in this order.
    Reference(ReferenceRange),
    /// A noisy frame.
    Frame(PlannedFrame),
    /// A row on a frame.
    Cell(PlannedCell),
}

/// A range of a reference's samples with random numbers of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceRange {
    /// Scene id.
    pub scene: String,
    /// Hash of all that determines these samples; empty where the reference is exact or comes from a file.
    pub key: Key,
    /// First sample of every pixel.
    pub from: u64,
    /// First sample after the range.
    pub to: u64,
    /// Random seed.
    pub seed: u64,
    /// How samples are placed.
    pub sampling: Sampling,
    /// Camera samples in all.
    pub samples: u64,
}

/// How a frame's samples are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Placed {
    /// As many in every pixel as its level says.
    Uniform,
    /// Another number in every pixel.
    Samples,
    /// In rounds, where a row's method asks for them.
    Rounds,
}

/// A noisy frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedFrame {
    /// Scene id.
    pub scene: String,
    /// Level: samples per pixel.
    pub spp: u32,
    /// Replicate, from 0.
    pub replicate: u32,
    /// How samples are placed.
    pub placed: Placed,
    /// Hash of all that determines the frame.
    pub key: Key,
    /// Random seed.
    pub seed: u64,
    /// Camera samples in all; 0 for frames that are not rendered.
    pub samples: u64,
}

/// A row on a frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedCell {
    /// Scene id.
    pub scene: String,
    /// Level: samples per pixel.
    pub spp: u32,
    /// Replicate, from 0.
    pub replicate: u32,
    /// Row label.
    pub label: String,
    /// Hash of all that determines the cell's numbers.
    pub key: Key,
    /// Key of its frame.
    pub frame: Key,
    /// Keys of neighbouring frames that its method looks at.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<Key>,
    /// Seconds that it will take on one core, to a factor of three: by what its card says, the pixels and the runs.
    pub seconds: f64,
}
