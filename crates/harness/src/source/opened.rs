//! What is known of a scene before anything is rendered or decoded.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Finding, Maps, Sampling};
use noisefloor_study::Key;

use crate::source::frame::FrameSpec;

/// A scene, whatever its frames come from.
pub(crate) struct Opened {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) about: String,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Kind of sampling of the noisy frames.
    pub(crate) sampling: Sampling,
    pub(crate) settings: BTreeMap<String, String>,
    /// Which photon maps light the frames, if any do.
    pub(crate) maps: Option<Maps>,
    pub(crate) frames: Vec<FrameSpec>,
    /// What the headers of its files show.
    pub(crate) findings: Vec<Finding>,
    /// Names of the layers in its files that have no fixed meaning.
    pub(crate) extra_features: BTreeSet<String>,
    /// Hash of all that determines the reference.
    pub(crate) reference_key: Key,
    /// Samples per pixel of the reference; 0 if exact or unknown.
    pub(crate) reference_spp: u64,
    /// Sampling of the reference, or `exact`.
    pub(crate) reference_sampling: String,
    /// Value of every pixel and channel, where a formula gives it.
    pub(crate) known_mean: Option<f64>,
    /// Samples per pixel of frames of equal time.
    pub(crate) equal_time_spp: Option<u32>,
}
