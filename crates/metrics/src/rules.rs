//! The rules of the table's metrics that are more than a line.

use crate::MetricError;
use crate::pixels::Pixels;
use crate::ssim::ssim_map;
use crate::trimmed::{kept_positions, trimmed_mean};

/// Without the pixels of the largest uncorrected errors.
pub(crate) fn relmse_trimmed(pixels: &Pixels<'_>, members: &[usize]) -> Option<f64> {
    let mut plain: Vec<f64> = members.iter().map(|&p| pixels.relative_plain[p]).collect();
    if !pixels.corrected {
        return trimmed_mean(&mut plain);
    }
    let kept = kept_positions(&plain);
    let sum: f64 = kept.iter().map(|&at| pixels.relative[members[at]]).sum();
    (!kept.is_empty()).then(|| sum / kept.len() as f64)
}

pub(crate) fn ssim(pixels: &Pixels<'_>) -> Result<Option<Vec<f64>>, MetricError> {
    Ok(Some(ssim_map(&pixels.luma, pixels.reference_luma, &pixels.valid, pixels.test.width())))
}

pub(crate) fn energy(pixels: &Pixels<'_>, members: &[usize]) -> Option<f64> {
    let (mut value, mut truth) = (0.0, 0.0);
    for &p in members {
        value += pixels.value[p];
        truth += pixels.truth[p];
    }
    (truth > 0.0).then(|| value / truth)
}
