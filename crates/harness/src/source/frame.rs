//! Noisy frames that the plan asks for.

use noisefloor_frame::{Finding, Frame, Hygiene};
use noisefloor_study::plan::Placed;
use noisefloor_study::{AdaptiveFrames, Key, SceneSpec, Study, seed_of};
use serde_json::json;

/// A noisy frame that the plan asks for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FrameSpec {
    pub(crate) spp: u32,
    pub(crate) replicate: u32,
    pub(crate) seed: u64,
    /// Hash of all that determines the frame.
    pub(crate) key: Key,
    pub(crate) kind: FrameKind,
}

/// How a frame differs from the study's own of its level and replicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrameKind {
    /// Not at all.
    Uniform,
    /// So many samples in every pixel instead of the level's.
    Samples(u32),
    /// With the variance of their law.
    KnownVariance,
    /// Rendered in rounds.
    Adaptive(AdaptiveFrames),
}

impl FrameSpec {
    /// Samples per pixel, on average.
    pub(crate) fn samples(&self) -> u32 {
        match self.kind {
            FrameKind::Samples(spp) => spp,
            FrameKind::Uniform | FrameKind::KnownVariance | FrameKind::Adaptive(_) => self.spp,
        }
    }
}

impl FrameKind {
    /// In the words of the plan.
    pub(crate) fn placed(self) -> Placed {
        match self {
            Self::Uniform | Self::KnownVariance => Placed::Uniform,
            Self::Samples(_) => Placed::Samples,
            Self::Adaptive(_) => Placed::Rounds,
        }
    }
}

/// A noisy frame that was checked, see [`Frame::inspect`]: methods may look at it.
#[derive(Debug, Clone)]
pub(crate) struct Checked {
    pub(crate) frame: Frame,
    /// What was found and mended.
    pub(crate) hygiene: Hygiene,
    /// Scene, and file or level and replicate.
    pub(super) name: String,
}

impl Checked {
    /// What was found, with the frame's name.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        self.hygiene.findings.iter().cloned().map(|finding| finding.within(&self.name)).collect()
    }
}

/// Random seed of a noisy frame.
pub(super) fn frame_seed(study_seed: u64, identity: &serde_json::Value, spp: u32, replicate: u32) -> u64 {
    seed_of(&json!({
        "purpose": "frame", "seed": study_seed, "scene": identity, "spp": spp, "replicate": replicate
    }))
}

/// The frames of a scene whose random seeds follow from study seed, scene, level and replicate, never from the study's
/// name, so that studies share frames.
pub(super) fn frame_specs(
    study: &Study,
    spec: &SceneSpec,
    identity: &serde_json::Value,
    key: impl Fn(u32, u64) -> Key,
) -> Vec<FrameSpec> {
    let mut frames = Vec::new();
    for &spp in study.levels(spec) {
        for replicate in 0..study.replicates(spec, spp) {
            let seed = frame_seed(study.seed, identity, spp, replicate);
            frames.push(FrameSpec { spp, replicate, seed, key: key(spp, seed), kind: FrameKind::Uniform });
        }
    }
    frames
}
