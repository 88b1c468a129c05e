//! The membership test (moon2013flash, Eq. 2), shared by the twins, the fast kernel and the diagnostics.

use std::borrow::Cow;

use super::volume::{TARGET, Volume};
use super::{FlashInputs, Membership};

/// Half-widths at or above this mean "everything passes"; the value itself stands for that.
///
/// It lies above every difference of two source values and below the value that the fast kernel puts
/// outside the image, so that one comparison does the membership test and the clipping of the window.
pub(super) const EVERYTHING: f32 = 1e38;

/// Half-width of the interval that a neighbour's value is compared with, rounding allowance included.
///
/// The test |v_q − v_p| ≤ τ + 4·eps·max(|v_p|, |v_q|) has the neighbour on both sides. With δ = |v_q − v_p| and
/// |v_q| ≤ |v_p| + δ it implies δ ≤ (τ + 4·eps·|v_p|)·(1 + 4·eps), to first order in eps. That bound depends on the
/// centre pixel alone, and the reverse holds up to a factor 1 + 4·eps. It is what this returns: the same test up to
/// one part in 2 million of the threshold, at a third of the arithmetic. `tolerance` = τ ≥ 0, `center` = v_p.
/// The allowance is ours: equal values that differ by rounding stay equal.
pub fn half_width(tolerance: f32, center: f32) -> f32 {
    const ALLOWANCE: f32 = 4.0 * f32::EPSILON;
    ((tolerance + ALLOWANCE * center.abs()) * (1.0 + ALLOWANCE)).min(EVERYTHING)
}

/// Rec. 709 luminance of one pixel.
pub fn luminance(r: f32, g: f32, b: f32) -> f32 {
    0.2126f32.mul_add(r, 0.7152f32.mul_add(g, 0.0722 * b))
}

/// One value plane to be tested, with its tolerance; no tolerance means that everything passes.
#[derive(Clone, Debug)]
pub(super) struct Test<'a> {
    /// What is compared, one plane for each frame of the volume.
    pub values: Vec<Cow<'a, [f32]>>,
    /// τ ≥ 0 of each centre pixel.
    pub tolerance: Option<&'a [f32]>,
}

impl Test<'_> {
    /// Half-width at centre pixel `p`, rounding allowance included.
    pub fn half_width(&self, p: usize) -> f32 {
        self.tolerance.map_or(EVERYTHING, |tolerance| half_width(tolerance[p], self.values[TARGET][p]))
    }

    /// Whether pixel `q` of a frame passes the test of the target's pixel `p`.
    pub fn passes(&self, p: usize, frame: usize, q: usize) -> bool {
        (self.values[frame][q] - self.values[TARGET][p]).abs() <= self.half_width(p)
    }
}

/// The membership rule as tests on value planes.
#[derive(Clone, Debug)]
pub(super) enum Tests<'a> {
    /// One set for all channels: all of these tests must pass.
    Shared(Vec<Test<'a>>),
    /// Channel c's set is what passes test c.
    PerChannel([Test<'a>; 3]),
}

impl<'a> Tests<'a> {
    pub fn new(inputs: &FlashInputs<'a>, volume: &Volume) -> Self {
        let frames = volume.of(inputs);
        let values = |c: usize| frames.iter().map(|frame| Cow::Borrowed(frame.source[c])).collect();
        let of = |c: usize, tolerance| Test { values: values(c), tolerance };
        match inputs.membership {
            Membership::Joint(t) => Tests::Shared((0..3).map(|c| of(c, Some(t[c]))).collect()),
            Membership::PerChannel(t) => Tests::PerChannel([0, 1, 2].map(|c| of(c, Some(t[c])))),
            Membership::Luminance(tolerance) => {
                let values = frames.iter().map(|frame| {
                    let [r, g, b] = frame.source;
                    r.iter().zip(g).zip(b).map(|((&r, &g), &b)| luminance(r, g, b)).collect()
                });
                Tests::Shared(vec![Test { values: values.collect(), tolerance: Some(tolerance) }])
            }
            Membership::Off => Tests::Shared(vec![of(0, None)]),
        }
    }

    /// For each channel, whether `q` of a frame is in the set of the target's `p`.
    pub fn members(&self, p: usize, frame: usize, q: usize) -> [bool; 3] {
        match self {
            Tests::Shared(tests) => [tests.iter().all(|test| test.passes(p, frame, q)); 3],
            Tests::PerChannel(tests) => [0, 1, 2].map(|c| tests[c].passes(p, frame, q)),
        }
    }
}
