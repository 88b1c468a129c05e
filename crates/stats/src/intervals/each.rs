//! The loop over pixels and channels that families have in common.

use super::planes::{IntervalPlanes, SamplePlanes};
use crate::ShapeError;

/// What every family has of a pixel's channel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Planar index.
    pub index: usize,
    /// x̄, finite.
    pub mean: f64,
    /// s/√n, finite, at least 0.
    pub standard_error: f64,
    /// Samples, at least 2.
    pub n: u32,
}

/// The ends that `ends` gives where there are at least 2 samples and finite numbers; `None` is no interval.
pub(super) fn each(
    planes: &SamplePlanes<'_>,
    ends: impl Fn(&Seen) -> Option<[f64; 2]>,
) -> Result<IntervalPlanes, ShapeError> {
    planes.check()?;
    let observed = &planes.observed;
    let mut out = IntervalPlanes {
        low: vec![f64::NEG_INFINITY; observed.mean.len()],
        high: vec![f64::INFINITY; observed.mean.len()],
    };
    for (index, (&mean, &variance)) in observed.mean.iter().zip(observed.variance).enumerate() {
        let n = observed.count_at(index % observed.pixels);
        if n < 2 || !mean.is_finite() || !variance.is_finite() {
            continue;
        }
        let standard_error = f64::from(variance).max(0.0).sqrt();
        let seen = Seen { index, mean: f64::from(mean), standard_error, n };
        // A comparison with NaN is false: such ends are no interval.
        if let Some([low, high]) = ends(&seen).filter(|[low, high]| low <= high) {
            (out.low[index], out.high[index]) = (low, high);
        }
    }
    Ok(out)
}
