use noisefloor_study::record::{Outcome, Record};

/// What a run is about to do, so that a caller can draw a bar and estimate the time left.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Workload {
    /// Camera samples to render (pixels × samples per pixel), references included, frames of the cache not.
    pub samples: u64,
    /// Cells to run.
    pub cells: u64,
    /// Cells that are finished from an earlier run.
    pub kept: u64,
}

/// The part of the work that begins.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Renders a part of a reference.
    Reference {
        /// Scene id.
        scene: String,
        /// Part from 0.
        part: u32,
        /// Parts in all.
        parts: u32,
    },
    /// Renders or reads a noisy frame.
    Frame {
        /// Scene id.
        scene: String,
        /// Samples per pixel.
        spp: u32,
        /// Replicate from 0.
        replicate: u32,
    },
    /// Denoises and measures the frame that was last announced.
    Denoise {
        /// Scene id.
        scene: String,
        /// Samples per pixel.
        spp: u32,
        /// Replicate from 0.
        replicate: u32,
        /// Label of the row.
        label: String,
    },
    /// Analyses all records.
    Analysis,
}

/// Is told how a run goes. Every function may be called from any thread and does nothing unless overridden.
pub trait Observer: Sync {
    /// Once, before any work.
    fn planned(&self, work: &Workload) {
        let _ = work;
    }

    /// A stage begins.
    fn stage(&self, stage: &Stage) {
        let _ = stage;
    }

    /// `samples` more camera samples are rendered; all calls add up to [`Workload::samples`] unless a damaged cache
    /// file has to be made again.
    fn rendered(&self, samples: u64) {
        let _ = samples;
    }

    /// A cell is finished and on disk.
    fn cell(&self, record: &Record, outcome: &Outcome) {
        let _ = (record, outcome);
    }

    /// Something that a person should read, such as a damaged cache file that is made again.
    fn warning(&self, text: &str) {
        let _ = text;
    }

    /// Asked often; `true` stops the run at once with [`crate::HarnessError::Cancelled`].
    fn cancelled(&self) -> bool {
        false
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Observer for Silent {}
