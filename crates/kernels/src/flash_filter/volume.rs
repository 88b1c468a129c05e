//! The target and the frames beside it as a volume (moon2013flash, Sec. 4, denoising animations): which of them the window
//! and the patches take in.

use super::{FlashInputs, FlashParams, Neighbor, PatchWeights};

/// Place of the target among a volume's frames; those before it and then those after it follow, in time order.
pub(super) const TARGET: usize = 0;

/// A cube around the target, clipped to the frames that are there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Volume {
    /// Frames before the target that are looked at.
    before: isize,
    /// Frames after it.
    after: isize,
    /// Window radius, in frames as in pixels.
    reach: isize,
    patch: PatchWeights,
    /// Patch radius, in frames as in pixels; 0 without a guide.
    patch_reach: isize,
}

/// Two frames whose guides are compared: one part of the patches' distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slab {
    /// Place of the frame in the patch of the pixel.
    pub here: usize,
    /// Place of the frame in the patch of its neighbour.
    pub there: usize,
    /// Share in the distance. Those of a pair of patches add up to 1.
    pub weight: f64,
}

impl Volume {
    pub fn new(params: &FlashParams, inputs: &FlashInputs<'_>) -> Self {
        let reach = params.window_radius as isize;
        let patch_reach = if inputs.guide.is_some() { params.patch.radius() as isize } else { 0 };
        // A window that stays in the target's frame asks nothing of others.
        let most = if reach == 0 { 0 } else { reach + patch_reach };
        let clipped = |frames: &[Neighbor<'_>]| (frames.len() as isize).min(most);
        let (before, after) = (clipped(inputs.before), clipped(inputs.after));
        Self { before, after, reach, patch: params.patch, patch_reach }
    }

    /// Number of frames, the target among them.
    pub fn frames(&self) -> usize {
        (1 + self.before + self.after) as usize
    }

    /// The frames in their places.
    pub fn of<'a>(&self, inputs: &FlashInputs<'a>) -> Vec<Neighbor<'a>> {
        let times = std::iter::once(0).chain(-self.before..=-1).chain(1..=self.after);
        times.filter_map(|time| inputs.frame(time)).collect()
    }

    /// Place of the frame `time` after the target, if it is there.
    pub fn place(&self, time: isize) -> Option<usize> {
        match time {
            0 => Some(TARGET),
            1.. => (time <= self.after).then_some((self.before + time) as usize),
            _ => (-time <= self.before).then_some((1 + self.before + time) as usize),
        }
    }

    /// The frames of the window in time order: distance from the target, and place.
    pub fn window(&self) -> impl Iterator<Item = (isize, usize)> {
        let (first, last) = (self.before.min(self.reach), self.after.min(self.reach));
        (-first..=last).filter_map(|time| Some((time, self.place(time)?)))
    }

    /// What the patches of a pixel and its neighbour `time` later compare, in time order. A tap counts where both its frames
    /// are there, and the weights of those that count are scaled to a sum of 1: mirroring, as at the border of the image, would
    /// set the future of one pixel beside the past of the other.
    pub fn slabs(&self, time: isize) -> Vec<Slab> {
        let taps = (-self.patch_reach..=self.patch_reach).filter_map(|tap| {
            let weight = self.patch.tap(tap.unsigned_abs());
            Some(Slab { here: self.place(tap)?, there: self.place(time + tap)?, weight })
        });
        let mut slabs: Vec<Slab> = taps.collect();
        // The middle tap always counts and has the largest weight, above 0.
        let sum: f64 = slabs.iter().map(|slab| slab.weight).sum();
        slabs.iter_mut().for_each(|slab| slab.weight /= sum);
        slabs
    }
}
