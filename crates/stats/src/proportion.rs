//! Rates with their Monte Carlo standard errors (Morris, White, Crowther 2019, Table 6).

use serde::{Deserialize, Serialize};

use crate::interval::mean_and_variance;
use crate::{Interval, Level, replicate_interval};

/// A rate within one image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// Share of hits.
    pub rate: f64,
    /// Standard error over clusters.
    pub standard_error: f64,
    /// Clusters.
    pub clusters: usize,
}

/// √(p(1−p)/n): standard error of a rate over `n` independent trials, 0 for none.
#[must_use]
pub fn rate_standard_error(rate: f64, n: u64) -> f64 {
    (rate * (1.0 - rate)).max(0.0).sqrt() / (n.max(1) as f64).sqrt()
}

/// Rate of hits in planar data whose channels of one pixel count as one cluster; pixels count as independent
/// of each other, so this suits inputs and not denoised images. `None` for fewer than 2 pixels.
#[must_use]
pub fn clustered_rate(hits: &[bool], pixels: usize) -> Option<Rate> {
    if pixels < 2 || hits.is_empty() {
        return None;
    }
    let channels = (hits.len() / pixels).max(1) as f64;
    let per_pixel: Vec<f64> = (0..pixels)
        .map(|p| hits.iter().skip(p).step_by(pixels).filter(|&&h| h).count() as f64 / channels)
        .collect();
    let (rate, variance) = mean_and_variance(&per_pixel)?;
    Some(Rate { rate, standard_error: (variance / pixels as f64).sqrt(), clusters: pixels })
}

/// Mean of per-replicate rates with its t-interval, cut to [0, 1]; `None` without replicates, no interval for
/// one.
///
/// `trials` is the number of pixels behind all replicates together. Where every replicate shows the same rate
/// of 0 or 1 their spread says nothing; the interval then ends at the exact limit of that many independent
/// trials, 1 − (α/2)^(1/trials) from the rate (Clopper, Pearson 1934).
#[must_use]
pub fn proportion_interval(rates: &[f64], trials: u64, level: Level) -> Option<Interval> {
    let mut interval = replicate_interval(rates, 0.0, level)?;
    if let (Some(low), Some(high)) = (interval.low, interval.high) {
        let finite = || rates.iter().filter(|r| r.is_finite());
        let extreme = finite().all(|&r| r == 0.0) || finite().all(|&r| r == 1.0);
        let slack =
            if extreme && trials > 0 { -(level.upper_tail().ln() / trials as f64).exp_m1() } else { 0.0 };
        interval.low = Some((low - slack).clamp(0.0, 1.0));
        interval.high = Some((high + slack).clamp(0.0, 1.0));
    }
    Some(interval)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_of_a_pixel_are_one_cluster() {
        // Three identical channels carry the information of one.
        let plane: Vec<bool> = (0..100).map(|i| i % 5 == 0).collect();
        let all: Vec<bool> = plane.iter().chain(&plane).chain(&plane).copied().collect();
        let rate = clustered_rate(&all, 100).unwrap();
        assert!((rate.rate - 0.2).abs() < 1e-12);
        // n−1 in place of n makes the difference to √(p(1−p)/n).
        let independent = rate_standard_error(0.2, 100);
        assert!((rate.standard_error / independent - (100f64 / 99.0).sqrt()).abs() < 1e-9);
        assert!(clustered_rate(&[true], 1).is_none());
    }

    #[test]
    fn rates_stay_between_zero_and_one() {
        let i = proportion_interval(&[0.001, 0.0, 0.004], 3000, Level::TWO_SIDED_95).unwrap();
        assert_eq!(i.low, Some(0.0));
        assert!(i.high.unwrap() < 0.01);
    }

    #[test]
    fn no_event_at_all_still_has_an_upper_limit() {
        // Rule of three, two-sided: −ln(0.025)/n = 3.689/n.
        let i = proportion_interval(&[0.0; 4], 10_000, Level::TWO_SIDED_95).unwrap();
        assert!((i.high.unwrap() - 3.689e-4).abs() < 1e-6, "{:?}", i.high);
        let i = proportion_interval(&[1.0; 4], 10_000, Level::TWO_SIDED_95).unwrap();
        assert!((1.0 - i.low.unwrap() - 3.689e-4).abs() < 1e-6);
        assert_eq!(proportion_interval(&[0.0], 10, Level::TWO_SIDED_95).unwrap().high, None);
    }
}
