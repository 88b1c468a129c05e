//! Step 3: the candidate that is less wrong in each pixel, as a smooth share.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;

use super::candidates::{Candidate, Color, Errors, filter_maps};
use super::params::Params;

/// What came of the choice.
#[derive(Debug, Clone)]
pub(super) struct Selection {
    /// t, the share of the wider candidate.
    pub wide: Image,
    /// R_A, R_B.
    pub halves: [Image; 2],
    /// Estimate of the squared error of their mean.
    pub error: Image,
}

/// t and R_A, R_B from both candidates, the narrower first, and their filtered errors.
pub(super) fn select(
    color: &Color<'_>,
    candidates: &[Candidate; 2],
    errors: &Errors,
    params: &Params,
) -> Result<Selection, DenoiseError> {
    let [narrow, wide] = &errors.compared;
    let choice = narrow.zip_map(wide, |narrow, wide| if narrow < wide { 0.0 } else { 1.0 });
    let [wide] = filter_maps(color, [&choice], params)?;
    // A mean of zeros and ones but for rounding.
    let wide = wide.map(|t| t.clamp(0.0, 1.0));
    let [narrow, other] = candidates;
    let halves = [0, 1].map(|half| mixed(&narrow.halves[half], &other.halves[half], &wide));
    let error = mixed(&errors.estimates[0], &errors.estimates[1], &wide);
    Ok(Selection { wide, halves, error })
}

/// (1 − t)·a + t·b.
fn mixed(a: &Image, b: &Image, share: &Image) -> Image {
    let mut out = a.clone();
    for c in 0..a.channels() {
        let values = out.plane_mut(c).iter_mut().zip(b.plane(c)).zip(share.plane(c));
        for ((value, b), t) in values {
            let t = f64::from(*t);
            *value = ((1.0 - t) * f64::from(*value) + t * f64::from(*b)) as f32;
        }
    }
    out
}
