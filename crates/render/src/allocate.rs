use std::ops::RangeInclusive;

use crate::RenderError;

/// Shares out `budget` samples in proportion to a density, between two limits for each pixel.
///
/// `density` has one number per pixel, finite and not negative; only ratios matter, and if all are zero the shares are
/// equal. What a limit takes from a pixel goes to the others in proportion. The sum is exactly `budget`: fractions are
/// carried on from pixel to pixel, so that every number is its real-valued share rounded down or up.
///
/// # Errors
/// [`RenderError::InvalidRequest`] for a density without meaning (the pixel is named), limits in the wrong order, or a
/// budget that the limits cannot hold.
pub fn allocate(density: &[f64], budget: u64, limits: RangeInclusive<u32>) -> Result<Vec<u32>, RenderError> {
    let wrong = |parameter, value: String, expected: String| {
        Err(RenderError::InvalidRequest { parameter, value, expected })
    };
    if let Some((pixel, bad)) = density.iter().enumerate().find(|(_, d)| !(d.is_finite() && **d >= 0.0)) {
        return wrong("density", format!("{bad} in pixel {pixel}"), "finite and not negative".into());
    }
    let (least, most) = (*limits.start(), *limits.end());
    if least > most {
        return wrong("limits", format!("{least} to {most}"), "the smaller one first".into());
    }
    let pixels = density.len() as u64;
    let (low, high) = (pixels * u64::from(least), pixels * u64::from(most));
    if !(low..=high).contains(&budget) {
        let expected = format!("{low} to {high} for {pixels} pixels of {least} to {most}");
        return wrong("budget", budget.to_string(), expected);
    }
    // Scaled to a largest value of 1. The small addition lets pixels of density zero take what the others cannot.
    let peak = density.iter().copied().fold(0.0, f64::max);
    let weight = |d: f64| if peak > 0.0 { d / peak + 1e-9 } else { 1.0 };
    let share = |scale: f64, d: f64| (scale * weight(d)).clamp(f64::from(least), f64::from(most));
    let total = |scale: f64| density.iter().map(|d| share(scale, *d)).sum::<f64>();
    // The total grows with the scale, from all `least` at 0 to all `most` at the upper end.
    let (mut below, mut above) = (0.0, f64::from(most) * 1e9 + 1.0);
    for _ in 0..128 {
        let middle = 0.5 * (below + above);
        if total(middle) < budget as f64 { below = middle } else { above = middle }
    }
    let mut sum = 0.0;
    let mut given = 0u64;
    let counts = density.iter().map(|d| {
        sum += share(above, *d);
        // Monotone, and the last value is the budget up to rounding far below one half.
        let upto = (sum + 0.5).floor() as u64;
        let count = upto - given;
        given = upto;
        count as u32
    });
    Ok(counts.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_proportional_and_add_up() {
        let density = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(allocate(&density, 100, 0..=1000).unwrap(), [10, 20, 30, 40]);
        let ramp: Vec<f64> = (0..1000).map(|i| (f64::from(i) * 0.37).sin().abs() * 1e-12).collect();
        for budget in [0, 1, 999, 16_000, 64_000] {
            let counts = allocate(&ramp, budget, 0..=64).unwrap();
            assert_eq!(counts.iter().map(|n| u64::from(*n)).sum::<u64>(), budget);
            assert!(counts.iter().all(|n| *n <= 64));
        }
    }

    #[test]
    fn what_a_limit_takes_goes_to_the_others() {
        let counts = allocate(&[0.0, 1.0, 1.0, 100.0], 40, 2..=20).unwrap();
        assert_eq!(counts[0], 2);
        assert_eq!(counts[3], 20);
        assert_eq!((counts[1], counts[2]), (9, 9));
        assert_eq!(allocate(&[0.0, 5.0], 30, 0..=20).unwrap(), [10, 20], "zero density takes the rest");
    }

    #[test]
    fn no_density_means_equal_shares() {
        assert_eq!(allocate(&[0.0; 4], 16, 0..=8).unwrap(), [4; 4]);
        assert_eq!(allocate(&[], 0, 0..=8).unwrap(), [] as [u32; 0]);
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let told = |r: Result<Vec<u32>, RenderError>| r.unwrap_err().to_string();
        assert!(told(allocate(&[1.0, f64::NAN], 4, 0..=8)).contains("NaN in pixel 1"));
        assert!(told(allocate(&[-1.0], 4, 0..=8)).contains("-1 in pixel 0"));
        assert!(told(allocate(&[1.0; 2], 17, 0..=8)).contains("0 to 16"));
        #[expect(clippy::reversed_empty_ranges, reason = "that is the mistake")]
        let reversed = allocate(&[1.0], 1, 8..=0);
        assert!(told(reversed).contains("8 to 0"));
    }
}
