//! What the homogeneity test takes as the spread of what it compares: the input's in step 1 (s_p/√n_p of Eq. 2), in step 2,
//! of which Sec. 3.5 does not say it, what `second_spread` says, from sums that step 1 carries along.

use std::borrow::Cow;

use noisefloor_frame::{Frame, Image, Samples, Variance, luminance};
use noisefloor_kernels::flash_filter::Carried;

use crate::{Params, SpreadKind, TestKind};

/// Variance of the input's mean as it is tested: three channels, or one of luminance. `None` without a test.
pub(crate) fn tested_variance<'a>(frame: &'a Frame, params: &Params) -> Option<Cow<'a, Image>> {
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance)?;
    match params.test {
        _ if !params.homogeneous => None,
        TestKind::Joint | TestKind::PerChannel => Some(Cow::Borrowed(variance)),
        TestKind::Luminance => Some(Cow::Owned(luminance_variance(variance))),
    }
}

/// Variance of luminance if the channels were fully correlated: (Σ weight·standard deviation)². An upper bound of the true
/// one, whose covariances a frame does not carry.
fn luminance_variance(variance: &Image) -> Image {
    Image::from_fn(variance.width(), variance.height(), 1, |_, x, y| {
        luminance([0, 1, 2].map(|c| variance.get(c, x, y).max(0.0).sqrt())).powi(2)
    })
}

/// What step 1 carries along for the test of step 2: three channels, or one of luminance.
pub(crate) enum Along<'a> {
    /// Variances of what is tested.
    Variances(&'a Image),
    /// Difference of the two halves.
    Difference(Image),
}

impl<'a> Along<'a> {
    /// `None` if step 2 tests with the input's spread, or if there is no step 2 or no test.
    pub fn new(frame: &Frame, params: &Params, tested: Option<&'a Image>) -> Option<Self> {
        let tested = tested.filter(|_| params.steps == 2)?;
        match params.second_spread {
            SpreadKind::Raw => None,
            SpreadKind::Least | SpreadKind::Propagated => Some(Self::Variances(tested)),
            SpreadKind::Halves => {
                // A filter with given weights is linear: the filtered difference is the difference of filtered halves.
                let [a, b] = frame.color.halves.as_ref()?;
                let difference = a.zip_map(b, |a, b| a - b);
                Some(Self::Difference(match params.test {
                    TestKind::Joint | TestKind::PerChannel => difference,
                    TestKind::Luminance => Image::from_fn(a.width(), a.height(), 1, |_, x, y| {
                        luminance([0, 1, 2].map(|c| difference.get(c, x, y)))
                    }),
                }))
            }
        }
    }

    /// The planes for the kernel; luminance three times.
    pub fn planes(&self) -> [&[f32]; 3] {
        match self {
            Self::Variances(image) => three_planes(image),
            Self::Difference(image) => three_planes(image),
        }
    }

    /// The same with what is to be made of them.
    pub fn carried(&self) -> Carried<'_> {
        match self {
            Self::Variances(_) => Carried::Variances(self.planes()),
            Self::Difference(_) => Carried::Values(self.planes()),
        }
    }

    /// Variance of step 1's output as step 2 tests it, from the sums that step 1 carried.
    pub fn variance(&self, sums: Image, kind: SpreadKind, samples: &Samples) -> Image {
        match self {
            Self::Variances(raw) => {
                let mut out = sums;
                if out.channels() > raw.channels() {
                    let luminance = out.plane(0).to_vec();
                    out =
                        Image::from_vec(raw.width(), raw.height(), 1, luminance).expect("one plane of three");
                }
                if kind == SpreadKind::Least {
                    for (value, &raw) in out.data_mut().iter_mut().zip(raw.data()) {
                        *value = value.min(raw);
                    }
                }
                out
            }
            Self::Difference(difference) => {
                // With halves of n_a and n_b samples the difference has 1/n_a + 1/n_b times the variance of a sample.
                Image::from_fn(sums.width(), sums.height(), difference.channels(), |c, x, y| {
                    let (n_a, n_b) = samples.halves_at(y * sums.width() + x);
                    let (n_a, n_b) = (f64::from(n_a), f64::from(n_b));
                    let n = n_a + n_b; // at least 2, or the frame was refused
                    (f64::from(sums.get(c, x, y)).powi(2) * n_a * n_b / (n * n)) as f32
                })
            }
        }
    }
}

fn three_planes(image: &Image) -> [&[f32]; 3] {
    [0, 1, 2].map(|c| image.plane(c.min(image.channels() - 1)))
}
