//! Plain Monte Carlo under independent sampling: the expected squared error is exactly c/n.

use serde::{Deserialize, Serialize};

use crate::{Interval, Level, Levels, ReferenceShare};

/// The constant of error = c/n.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MonteCarloFit {
    /// c with its interval.
    pub c: Interval,
    /// n·error at each level.
    pub per_level: Vec<f64>,
    /// Largest deviation of a level from the fit in standard errors, where these are known: values well above
    /// 4 say that the frames do not behave as independent samples, or that the reference is too short.
    pub worst_deviation: Option<f64>,
    /// Standard error of c over replicates, without the reference's part; absent like the interval.
    pub replicate_se: Option<f64>,
    /// What the reference contributes to c.
    pub reference: ReferenceShare,
}

/// Fits c over all levels of a squared error; `None` without levels or if the fit is not positive.
///
/// Every level estimates c by n times its mean error. Levels are averaged with weights 1/variance, where the
/// variance is that of the mean over the level's replicates, from a relative spread pooled over all levels
/// (so that no level is favoured because its few replicates happen to agree), plus the reference's
/// contribution, which n magnifies. That part of c's own standard error follows the gradient where the influences of the
/// reference's parts are known, and counts as independent between levels where they are not. The interval is Student's t
/// with the pooled degrees of freedom; without two replicates at any level there is none.
#[must_use]
pub fn monte_carlo_constant(levels: &Levels, level: Level) -> Option<MonteCarloFit> {
    let size = |l: usize| mean(&levels.present(l));
    let estimates: Vec<f64> = (0..levels.len()).map(|l| levels.spp()[l] * size(l)).collect();
    let pooled = levels.pooled_relative_variance(size);
    let counts: Vec<f64> = (0..levels.len()).map(|l| levels.present(l).len() as f64).collect();
    let reference = |l: usize| levels.spp()[l] * levels.reference_se(l);

    // Without a spread the levels count by their replicates; the unit cancels.
    let relative = pooled.map_or(1.0, |(variance, _)| variance);
    let mut c = weighted_mean(&estimates, &counts)?;
    let mut variances = Vec::new();
    // The weights need c itself; they converge at once, because they depend on it weakly.
    for _ in 0..3 {
        variances = (0..levels.len())
            .map(|l| relative * c * c / counts[l] + reference(l).powi(2))
            .map(|v: f64| v.max(f64::MIN_POSITIVE))
            .collect::<Vec<_>>();
        let weights: Vec<f64> = variances.iter().map(|v| 1.0 / v).collect();
        c = weighted_mean(&estimates, &weights).filter(|c| *c > 0.0)?;
    }
    let n = counts.iter().sum::<f64>() as u32;
    let total: f64 = variances.iter().map(|v| 1.0 / v).sum();
    let shares: Vec<f64> = variances.iter().map(|v| 1.0 / (v * total)).collect(); // positive
    let by_error: Vec<f64> = shares.iter().zip(levels.spp()).map(|(share, n)| share * n).collect();
    let reference = levels.combined(&by_error);
    let own = |l: usize| shares[l].powi(2) * relative * c * c / counts[l];
    let replicate_se = pooled.map(|_| (0..levels.len()).map(own).sum::<f64>().sqrt());
    let interval = match (pooled, replicate_se) {
        (Some((_, degrees)), Some(own)) => {
            let se =
                if levels.has_parts() { own.hypot(reference.standard_error) } else { 1.0 / total.sqrt() };
            Interval::symmetric(c, se, level, Some(degrees), n)
        }
        _ => Interval { n, ..Interval::point(c, level) },
    };
    let worst_deviation = pooled
        .map(|_| estimates.iter().zip(&variances).map(|(e, v)| (e - c).abs() / v.sqrt()).fold(0.0, f64::max));
    Some(MonteCarloFit { c: interval, per_level: estimates, worst_deviation, replicate_se, reference })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn weighted_mean(values: &[f64], weights: &[f64]) -> Option<f64> {
    let total: f64 = weights.iter().sum();
    let sum: f64 = values.iter().zip(weights).map(|(v, w)| v * w).sum();
    let mean = sum / total;
    (total > 0.0 && mean.is_finite() && mean > 0.0).then_some(mean)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    #[test]
    fn the_constant_is_found_and_its_interval_covers() {
        let mut normals = Normals::new(3);
        let (trials, mut covered, mut sum) = (1000, 0, 0.0);
        for _ in 0..trials {
            let mut levels = Levels::new();
            for (spp, replicates) in [(4.0, 8), (16.0, 8), (64.0, 4), (256.0, 4)] {
                let errors: Vec<_> =
                    (0..replicates).map(|_| Some(2.0 / spp * (1.0 + 0.05 * normals.next()))).collect();
                levels.push(spp, &errors, 0.0);
            }
            let fit = monte_carlo_constant(&levels, Level::TWO_SIDED_95).unwrap();
            covered += u64::from(!fit.c.excludes(2.0));
            sum += fit.c.value;
        }
        let rate = covered as f64 / trials as f64;
        assert!((rate - 0.95).abs() < 4.0 * crate::rate_standard_error(0.95, trials), "{rate}");
        // One fit has a standard error of 0.1/√24.
        assert!((sum / trials as f64 - 2.0).abs() < 4.0 * 0.1 / 24f64.sqrt() / (trials as f64).sqrt());
    }

    #[test]
    fn a_level_drowned_in_reference_noise_hardly_counts() {
        let mut levels = Levels::new();
        levels.push(4.0, &[Some(0.25), Some(0.26), Some(0.24)], 0.0);
        levels.push(4096.0, &[Some(0.001), Some(0.00101), Some(0.00099)], 0.01);
        let fit = monte_carlo_constant(&levels, Level::TWO_SIDED_95).unwrap();
        assert!((fit.c.value - 1.0).abs() < 0.01, "{:?}", fit.c);
        assert!((fit.per_level[1] - 4.096).abs() < 1e-9);
    }

    #[test]
    fn one_replicate_gives_no_interval() {
        let mut levels = Levels::new();
        levels.push(4.0, &[Some(0.25)], 0.0);
        levels.push(16.0, &[Some(0.0625)], 0.0);
        let fit = monte_carlo_constant(&levels, Level::TWO_SIDED_95).unwrap();
        assert!((fit.c.value - 1.0).abs() < 1e-12 && fit.c.low.is_none() && fit.worst_deviation.is_none());
        assert!(monte_carlo_constant(&Levels::new(), Level::TWO_SIDED_95).is_none());
    }
}
