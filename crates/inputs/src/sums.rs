//! The one pass over a frame beside its reference: sums per block, of which all statistics are made.

use noisefloor_frame::{Frame, Variance};
use noisefloor_stats::instrument::{PixelPair, ResidualSums};

use crate::against::Against;

/// One [`ResidualSums`] per block; `invalid` flags pixels to leave out (empty: none).
pub(crate) fn sums(against: &Against<'_>, frame: &Frame, invalid: &[bool]) -> Vec<ResidualSums> {
    let (x, r) = (&frame.color.mean, against.reference.mean());
    let v = frame.color.variance.as_ref().map(Variance::mean_variance);
    let v_r = against.reference.frame.color.variance.as_ref().map(Variance::mean_variance);
    let scale = against.spp.zip(frame.samples.total().uniform()).map(|(long, n)| long / f64::from(n));
    let mut out = vec![ResidualSums::default(); against.blocks.count()];
    for pixel in 0..x.pixels() {
        if !against.usable(pixel, invalid) {
            continue;
        }
        let block = against.blocks.of(pixel);
        let at = |image: &noisefloor_frame::Image| [0, 1, 2].map(|c| f64::from(image.plane(c)[pixel]));
        let unknown = |image: &noisefloor_frame::Image| at(image).iter().any(|value| !value.is_finite());
        if unknown(x) || v.is_some_and(unknown) || v_r.is_some_and(unknown) {
            continue;
        }
        out[block].add_pixel(&PixelPair {
            weight: against.weights[block],
            seen: at(x),
            truth: at(r),
            variance: v.map(at),
            truth_variance: v_r.map(at),
            scale,
            exact: against.exact,
        });
    }
    out
}
