//! Denoising animations (Sec. 4): the target and the frames around it are a volume, and windows and patches are cubes in it.
//!
//! This file says which frames those are; how a pixel is filtered in them is the kernel's part, and `guide.rs` and `algorithm.rs`
//! do for each frame what they do for one.

use noisefloor_denoiser::{DenoiseError, Input, MethodCard};
use noisefloor_frame::Frame;
use noisefloor_kernels::flash_filter::{MAX_SOURCE, PatchWeights};

use crate::card::ID;

/// The frames in use, in time order; one for a still image.
#[derive(Debug)]
pub(crate) struct Volume<'a> {
    pub frames: Vec<&'a Frame>,
    /// Which of them is to be denoised.
    pub target: usize,
    /// Frames that any of them takes in on each side.
    pub neighbors: usize,
}

impl<'a> Volume<'a> {
    /// The target of a checked input and at most `neighbors` frames on each side of it.
    pub fn new(input: &Input<'a>, neighbors: usize) -> Self {
        let before = &input.before[input.before.len().saturating_sub(neighbors)..];
        let after = &input.after[..neighbors.min(input.after.len())];
        let frames = before.iter().chain([input.target]).chain(after).collect();
        Self { frames, target: before.len(), neighbors }
    }

    /// The frame to denoise.
    pub fn target(&self) -> &'a Frame {
        self.frames[self.target]
    }

    /// Refuses frames beside the target without what the card asks of it, and colours that the kernel does not take.
    pub fn check(&self, card: &MethodCard) -> Result<(), DenoiseError> {
        for (at, frame) in self.frames.iter().enumerate() {
            let missing = card.missing(frame);
            if !missing.is_empty() {
                return Err(DenoiseError::MissingInputs { method: ID.into(), missing, ways_out: Vec::new() });
            }
            let what = if at == self.target {
                "colour is not finite or above 1e30"
            } else {
                "colour of a neighbouring frame is not finite or above 1e30"
            };
            DenoiseError::refuse(ID, what, &frame.color.mean, |v| v.abs() <= MAX_SOURCE)?;
        }
        Ok(())
    }
}

/// The items around the one at `at`, with their share in a mean over the frames of its patch: G along time over those that are
/// there, scaled to a sum of 1.
pub(crate) fn patch_in_time<'a, T>(items: &'a [T], at: usize, patch: &PatchWeights) -> Vec<(f64, &'a T)> {
    let first = at.saturating_sub(patch.radius());
    let weighted = items.iter().enumerate().skip(first).take(at + patch.radius() + 1 - first);
    let mut shares: Vec<(f64, &'a T)> = weighted.map(|(i, item)| (patch.tap(i.abs_diff(at)), item)).collect();
    // The middle tap is among them and the largest, above 0.
    let sum: f64 = shares.iter().map(|(weight, _)| weight).sum();
    shares.iter_mut().for_each(|(weight, _)| *weight /= sum);
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_a_patch_in_time_add_up_to_one_over_the_frames_that_are_there() {
        let patch = PatchWeights::gaussian(2, 1.25).unwrap();
        let items = [0, 1, 2, 3, 4, 5];
        for (at, expected) in [(0, 0..3), (1, 0..4), (3, 1..6), (5, 3..6)] {
            let shares = patch_in_time(&items, at, &patch);
            assert_eq!(
                shares.iter().map(|(_, item)| **item).collect::<Vec<_>>(),
                expected.collect::<Vec<_>>()
            );
            assert!((shares.iter().map(|(share, _)| share).sum::<f64>() - 1.0).abs() < 1e-12);
            let largest = shares.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            assert_eq!(*largest.1, at);
        }
        assert_eq!(patch_in_time(&[7], 0, &patch), [(1.0, &7)]);
    }

    #[test]
    fn the_nearest_frames_of_each_side_are_in_use() {
        let image = |v: f32| noisefloor_frame::Image::filled(1, 1, 3, v);
        let frame = |v: f32| {
            Frame::from_color(
                noisefloor_frame::Estimate::from_mean(image(v)),
                noisefloor_frame::Samples::uniform(2),
                noisefloor_frame::Sampling::Independent,
            )
        };
        let (before, target, after) = ([frame(1.0), frame(2.0), frame(3.0)], frame(4.0), [frame(5.0)]);
        let input = Input::new(&target).with_neighbors(&before, &after);
        let told = |neighbors| {
            let volume = Volume::new(&input, neighbors);
            let values: Vec<f32> = volume.frames.iter().map(|f| f.color.mean.get(0, 0, 0)).collect();
            assert_eq!(volume.target().color.mean.get(0, 0, 0), 4.0);
            values
        };
        assert_eq!(told(0), [4.0]);
        assert_eq!(told(1), [3.0, 4.0, 5.0]);
        assert_eq!(told(5), [1.0, 2.0, 3.0, 4.0, 5.0]);
    }
}
