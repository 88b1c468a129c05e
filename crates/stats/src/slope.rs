//! Slopes of log error against log samples.

use serde::{Deserialize, Serialize};

use crate::{Interval, Level, Levels, replicate_interval};

/// A slope, fitted per replicate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    /// Mean over replicates with its interval; −1 for the squared error of plain Monte Carlo, −½ for its
    /// root.
    pub interval: Interval,
    /// Least-squares slope of each replicate that has every level.
    pub per_replicate: Vec<f64>,
    /// Part of the interval's standard error that comes from the reference and is common to all replicates.
    pub common: f64,
    /// Sample counts that took part.
    pub spp: Vec<f64>,
}

/// Least-squares slope of ln error against ln spp per replicate, and the interval over replicates at `level`.
///
/// Only replicates with every level take part, so that all are fitted over the same range; a level where one
/// of them has an error ≤ 0 (below the reference's noise) is left out for all, because dropping single values
/// would favour large errors. What the reference contributes is carried along its gradient, h/error with h the weight of
/// a level in the fit. `None` with fewer than two levels or without such a replicate.
#[must_use]
pub fn slope(levels: &Levels, level: Level) -> Option<Slope> {
    Some(slope_between(levels, level, 0.0, f64::INFINITY)?.slope)
}

/// A slope with its derivative by the mean error of each level.
pub(crate) struct Fit {
    pub(crate) slope: Slope,
    pub(crate) gradient: Vec<f64>,
}

/// [`slope`] over the levels with `low` ≤ spp ≤ `high`.
pub(crate) fn slope_between(levels: &Levels, level: Level, low: f64, high: f64) -> Option<Fit> {
    let replicates = levels.complete_replicates();
    let used: Vec<usize> = usable_levels(levels, &replicates)
        .into_iter()
        .filter(|&l| levels.spp()[l] >= low && levels.spp()[l] <= high)
        .collect();
    let x: Vec<f64> = used.iter().map(|&l| levels.spp()[l].ln()).collect();
    let per_replicate: Vec<f64> = replicates
        .iter()
        .filter_map(|&r| {
            let y: Option<Vec<f64>> = used.iter().map(|&l| levels.at(l, r).map(f64::ln)).collect();
            least_squares_slope(&x, &y?)
        })
        .collect();
    let (mx, n) = (x.iter().sum::<f64>() / x.len() as f64, replicates.len() as f64);
    let sxx: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
    let mut gradient = vec![0.0; levels.len()];
    for (&l, x) in used.iter().zip(&x) {
        let error = replicates.iter().filter_map(|&r| levels.at(l, r)).sum::<f64>() / n;
        gradient[l] = (x - mx) / (sxx * error); // both positive, or there is no slope
    }
    let common = levels.combined(&gradient).standard_error;
    let interval = replicate_interval(&per_replicate, common, level)?;
    let slope =
        Slope { interval, per_replicate, common, spp: used.iter().map(|&l| levels.spp()[l]).collect() };
    Some(Fit { slope, gradient })
}

/// Levels where every one of these replicates has a positive error.
pub(crate) fn usable_levels(levels: &Levels, replicates: &[usize]) -> Vec<usize> {
    (0..levels.len())
        .filter(|&l| replicates.iter().all(|&r| levels.at(l, r).is_some_and(|v| v > 0.0)))
        .collect()
}

fn least_squares_slope(x: &[f64], y: &[f64]) -> Option<f64> {
    let n = x.len() as f64;
    if x.len() < 2 {
        return None;
    }
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxx: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
    let sxy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    (sxx > 0.0).then(|| sxy / sxx)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_laws_have_their_exponent() {
        let mut levels = Levels::new();
        for spp in [16.0, 4.0, 64.0f64] {
            levels.push(spp, &[Some(3.0 / spp), Some(2.0 * spp.powf(-0.5)), None], 0.0);
        }
        let s = slope(&levels, Level::TWO_SIDED_95).unwrap();
        assert_eq!(s.spp, [4.0, 16.0, 64.0]);
        assert!((s.per_replicate[0] + 1.0).abs() < 1e-12 && (s.per_replicate[1] + 0.5).abs() < 1e-12);
        assert!((s.interval.value + 0.75).abs() < 1e-12);
        assert_eq!(s.interval.n, 2);
    }

    #[test]
    fn a_level_below_the_noise_is_left_out_for_all() {
        let mut levels = Levels::new();
        for spp in [4.0, 16.0, 64.0f64] {
            let second = if spp == 64.0 { -1e-9 } else { 1.0 / spp };
            levels.push(spp, &[Some(1.0 / spp), Some(second)], 0.0);
        }
        let s = slope(&levels, Level::TWO_SIDED_95).unwrap();
        assert_eq!((s.spp, s.per_replicate.len()), (vec![4.0, 16.0], 2));
    }

    #[test]
    fn one_level_has_no_slope() {
        let mut levels = Levels::new();
        levels.push(4.0, &[Some(1.0)], 0.0);
        assert!(slope(&levels, Level::TWO_SIDED_95).is_none());
        assert!(slope(&Levels::new(), Level::TWO_SIDED_95).is_none());
    }
}
