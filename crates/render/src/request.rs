//! One image to render, and its random numbers.

use noisefloor_frame::{PixelFilter, Sampling};

use crate::limits::{DEEPEST, LONGEST_SEQUENCE, MAX_MEMORY, check_size};
use crate::{FeatureHit, Integrator, OptionalRecord, PhotonMaps, Prepared, Recorded, RenderError};

/// Raised whenever equal requests start to give other values: caches of frames should depend on it.
pub const REVISION: u32 = 3;

/// Random seed of frame `frame` of a sequence that starts with `seed`: frame 0 has the seed itself, every other one
/// numbers that have nothing to do with it.
#[must_use]
pub fn sequence_seed(seed: u64, frame: u32) -> u64 {
    if frame == 0 { seed } else { crate::sampler::pixel_key(seed ^ SEQUENCE, u64::from(frame)) }
}

/// What an image is rendered for: inputs that must be independent are drawn from different streams of random numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// A noisy frame of so many samples per pixel: frames of different numbers must not share samples.
    Frame {
        /// Samples per pixel.
        spp: u32,
    },
    /// A reference in parts, of so many samples per pixel in all.
    Reference {
        /// Samples per pixel.
        spp: u32,
    },
}

/// Random seed of an image for which nobody has chosen one, below 2³¹: the same for the same purpose, another one for
/// every other purpose.
#[must_use]
pub fn usual_seed(purpose: Purpose) -> u64 {
    let (stream, number) = match purpose {
        Purpose::Frame { spp } => (FRAME, spp),
        Purpose::Reference { spp } => (REFERENCE, spp),
    };
    crate::sampler::pixel_key(stream, u64::from(number)) >> 33
}

/// Streams of [`usual_seed`].
const FRAME: u64 = 0x6672_616D_6500_0000;
const REFERENCE: u64 = 0x7265_6665_7265_6E63;

/// Keeps the seeds of a sequence apart from everything else that is derived from a seed.
const SEQUENCE: u64 = 0x7365_7175_656E_6365;

/// One image to render.
#[derive(Debug, Clone)]
pub struct RenderRequest<'a> {
    /// The scene with its acceleration structure.
    pub scene: &'a Prepared,
    /// Columns, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
    /// Samples per pixel, at least 1.
    pub spp: u32,
    /// Index of the first sample: a range of a longer run of the same random seed. Even indices make half A.
    pub sample_start: u32,
    /// Random seed; frames of different seeds are independent.
    pub seed: u64,
    /// Largest number of path edges from the eye to a light, in 1..=1024: 1 shows emission seen directly, 2 adds light
    /// scattered once (direct light), 3 scattered twice, and so on.
    pub depth: u32,
    /// Placement of camera rays in a pixel.
    pub filter: PixelFilter,
    /// Independent samples, or two separately randomised Owen-scrambled Sobol sequences, one for each half.
    pub sampling: Sampling,
    /// What to record beside the colour.
    pub record: Recorded,
    /// Statistics of the colour to record beyond mean, variance and halves; none unless asked for.
    pub optional: OptionalRecord,
    /// Where along a path the features are taken.
    pub feature_hit: FeatureHit,
    /// How light is carried; photon mapping needs `photons`.
    pub integrator: Integrator,
    /// Photon maps of the scene.
    pub photons: Option<&'a PhotonMaps>,
    /// Most bytes of memory that the image may take, see [`RenderRequest::memory`].
    pub max_memory: u64,
}

impl<'a> RenderRequest<'a> {
    /// Independent samples, depth 8, box filter, random seed 0, recording everything available.
    #[must_use]
    pub fn new(scene: &'a Prepared, width: usize, height: usize, spp: u32) -> Self {
        Self {
            scene,
            width,
            height,
            spp,
            sample_start: 0,
            seed: 0,
            depth: 8,
            filter: PixelFilter::Box,
            sampling: Sampling::Independent,
            record: Recorded::Available,
            optional: OptionalRecord::default(),
            feature_hit: FeatureHit::First,
            integrator: Integrator::PathTracing,
            photons: None,
            max_memory: MAX_MEMORY,
        }
    }

    /// Checks everything but the recorded quantities.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        check_size(self.width, self.height)?;
        let range = |parameter, value: String, expected: &str| {
            Err(RenderError::InvalidRequest { parameter, value, expected: expected.to_owned() })
        };
        if self.spp == 0 {
            return range("spp", "0".into(), "at least 1");
        }
        let Some(end) = self.sample_start.checked_add(self.spp) else {
            return range("sample_start + spp", "too large".into(), "below 2^32");
        };
        if !(1..=DEEPEST).contains(&self.depth) {
            return range("depth", self.depth.to_string(), "1..=1024");
        }
        if self.sampling == Sampling::LowDiscrepancy && end.div_ceil(2) > LONGEST_SEQUENCE {
            return range("spp", end.to_string(), "at most 131072 with low-discrepancy sampling");
        }
        if self.feature_hit == FeatureHit::ThroughSpecular && self.scene.medium.is_some() {
            let allowed =
                "`first` in a scene with a medium, where a path may never reach what a mirror shows";
            return range("feature_hit", self.feature_hit.name().into(), allowed);
        }
        match self.photons {
            None if self.integrator == Integrator::PhotonMapping => {
                return range("photons", "absent".into(), "photon maps, for photon mapping");
            }
            Some(maps) if maps.scene() != self.scene.id() => {
                let expected = format!("of scene `{}`", self.scene.id());
                return range("photons", format!("of scene `{}`", maps.scene()), &expected);
            }
            Some(maps) if !maps.are_of(self.scene) => {
                return range(
                    "photons",
                    "of another preparation".into(),
                    "made of the prepared scene that is rendered",
                );
            }
            _ => {}
        }
        self.optional.check((self.width, self.height), self.spp, self.sampling)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn purposes_levels_and_frames_of_a_sequence_have_seeds_of_their_own() {
        let mut seen = BTreeSet::new();
        for spp in [1, 2, 4, 16, 64, 256, 1024, u32::MAX] {
            for purpose in [Purpose::Frame { spp }, Purpose::Reference { spp }] {
                for frame in 0..4 {
                    assert!(seen.insert(sequence_seed(usual_seed(purpose), frame)), "{purpose:?} {frame}");
                }
            }
        }
        // Nobody who counts seeds from 0 meets one of them.
        assert!(seen.iter().all(|seed| *seed > 1 << 20), "{seen:?}");
        assert_eq!(usual_seed(Purpose::Frame { spp: 16 }), usual_seed(Purpose::Frame { spp: 16 }));
    }
}
