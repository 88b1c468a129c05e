//! The certain half of the theorem: an average over the homogeneous set stays in the interval of the input
//! mean.

use serde::{Deserialize, Serialize};

use crate::observed::expect;
use crate::{Observed, ShapeError};

/// How close an output came to leaving its intervals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Enclosure {
    /// Largest |D−x̄|/(half-width·(1+1e-6) + 8·eps·|x̄|) over all pixel-channels; 0/0 counts as 0, a positive
    /// distance over zero and a D that is not finite as the largest finite number.
    pub worst_ratio: f64,
    /// Planar index of the worst pixel-channel.
    pub worst_index: usize,
    /// Whether the ratio is at most 1.
    pub held: bool,
}

/// Checks |D−x̄| ≤ half-width everywhere, up to the rounding of f32 values. Pixels without an interval
/// (infinite half-width) pass.
///
/// # Errors
/// [`ShapeError`] if the slices do not belong together.
pub fn enclosure(
    denoised: &[f32],
    half_width: &[f64],
    observed: &Observed<'_>,
) -> Result<Enclosure, ShapeError> {
    observed.check()?;
    expect("denoised image", denoised.len(), observed.mean.len())?;
    expect("half-widths", half_width.len(), observed.mean.len())?;
    let mut worst = (0.0, 0);
    for (i, ((&d, &mean), &width)) in denoised.iter().zip(observed.mean).zip(half_width).enumerate() {
        if !observed.takes_part(i % observed.pixels) || width == f64::INFINITY {
            continue;
        }
        let distance = (f64::from(d) - f64::from(mean)).abs();
        let allowed = width * (1.0 + 1e-6) + 8.0 * f64::from(f32::EPSILON) * f64::from(mean).abs();
        let ratio = if distance == 0.0 {
            0.0
        } else if allowed > 0.0 && distance.is_finite() {
            distance / allowed
        } else {
            f64::MAX
        };
        if ratio > worst.0 {
            worst = (ratio, i);
        }
    }
    Ok(Enclosure { worst_ratio: worst.0, worst_index: worst.1, held: worst.0 <= 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SampleCounts;

    fn check(denoised: &[f32], width: &[f64]) -> Enclosure {
        let mean = vec![1.0f32; denoised.len()];
        let observed = Observed {
            mean: &mean,
            variance: &vec![1.0; denoised.len()],
            counts: SampleCounts::Uniform(4),
            pixels: denoised.len(),
            valid: None,
        };
        enclosure(denoised, width, &observed).unwrap()
    }

    #[test]
    fn the_worst_pixel_decides() {
        let held = check(&[1.0, 1.5, 0.75], &[0.0, 0.5, 0.5]);
        assert!(held.held && held.worst_index == 1);
        assert!((held.worst_ratio - 1.0).abs() < 1e-5);
        let left = check(&[1.0, 1.501, 0.75], &[0.0, 0.5, 0.5]);
        assert!(!left.held && left.worst_ratio > 1.001);
    }

    #[test]
    fn points_and_broken_values_are_judged() {
        assert!(check(&[1.0 + 8e-7], &[0.0]).held, "rounding of the mean is allowed");
        assert!(!check(&[1.0 + 2e-6], &[0.0]).held);
        assert_eq!(check(&[f32::NAN], &[0.5]).worst_ratio, f64::MAX);
        assert_eq!(check(&[f32::INFINITY], &[f64::INFINITY]).worst_ratio, 0.0, "no interval, no claim");
    }
}
