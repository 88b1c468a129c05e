//! The floor b of error(n) = b + c/n.

use serde::{Deserialize, Serialize};

use crate::{Interval, Level, Levels, t_quantile};

/// A fit of error(n) = b + c/n with b, c ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Plateau {
    /// b with its interval; value and ends are cut at 0, so the interval excludes 0 exactly if its lower end
    /// is positive.
    pub b: Interval,
    /// c.
    pub c: f64,
}

/// Fits a squared error by weighted least squares over at least three levels; `None` with fewer.
///
/// The variance of a level is the squared fit times a relative spread over replicates pooled over all levels,
/// over the level's replicates, plus the squared standard error from the reference; the weights are its
/// inverse, iterated with the fit. Where the unconstrained fit has b or c below 0, that one is 0 and the
/// other fitted alone. The interval of b is that of the unconstrained fit: the spread over replicates carried
/// through the fit, Student's t with the pooled degrees of freedom, and what the reference contributes in quadrature: along
/// the fit's gradient where the influences of its parts are known, else its standard error at the top level, as if what it
/// adds were the same at all levels.
#[must_use]
pub fn plateau(levels: &Levels, level: Level) -> Option<Plateau> {
    if levels.len() < 3 {
        return None;
    }
    let y: Vec<f64> = (0..levels.len())
        .map(|l| {
            let values = levels.present(l);
            values.iter().sum::<f64>() / values.len() as f64 // a level has at least one value
        })
        .collect();
    let u: Vec<f64> = levels.spp().iter().map(|n| 1.0 / n).collect(); // positive by construction
    let counts: Vec<f64> = (0..levels.len()).map(|l| levels.present(l).len() as f64).collect();
    let scale = y.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    if scale <= 0.0 {
        return None;
    }
    // Keeps weights finite; far below any error that matters.
    let floor = 1e-12 * scale;
    let mut fitted: Vec<f64> = y.iter().map(|v| v.max(floor)).collect();
    let mut fit = Line::default();
    for _ in 0..8 {
        // Without any spread over replicates only the proportion to the reference's part matters: 5 % is
        // typical of a frame.
        let relative = levels.pooled_relative_variance(|l| fitted[l]).map_or(0.0025, |(v, _)| v);
        let variance = |l: usize| relative * fitted[l].powi(2) / counts[l] + levels.reference_se(l).powi(2);
        let weights: Vec<f64> = (0..levels.len()).map(|l| 1.0 / variance(l).max(floor * floor)).collect();
        fit = Line::new(&u, &y, &weights)?;
        let (b, c) = fit.constrained();
        fitted = u.iter().map(|u| (b + c * u).max(floor)).collect();
    }
    let (b, c) = fit.constrained();
    let top = levels.len() - 1;
    let n = counts.iter().sum::<f64>() as u32;
    let pooled = levels.pooled_relative_variance(|l| fitted[l]);
    let b = match pooled {
        Some((relative, degrees)) => {
            let spread =
                fit.b_weights.iter().zip(&fitted).zip(&counts).map(|((h, f), r)| (h * f).powi(2) / r);
            let reference = if levels.has_parts() {
                levels.combined(&fit.b_weights).standard_error
            } else {
                levels.reference_se(top)
            };
            let se = (relative * spread.sum::<f64>()).sqrt().hypot(reference);
            let half = t_quantile(level, degrees) * se;
            Interval {
                value: b,
                standard_error: Some(se),
                low: Some((fit.b - half).max(0.0)),
                high: Some((fit.b + half).max(0.0)),
                level,
                n,
            }
        }
        None => Interval { n, ..Interval::point(b, level) },
    };
    Some(Plateau { b, c })
}

/// Weighted least squares of y = b + c·u.
#[derive(Default)]
struct Line {
    b: f64,
    c: f64,
    /// b = Σ weight·y.
    b_weights: Vec<f64>,
    /// c if b is 0, and b if c is 0.
    alone: (f64, f64),
}

impl Line {
    fn new(u: &[f64], y: &[f64], w: &[f64]) -> Option<Self> {
        let sum = |f: &dyn Fn(usize) -> f64| (0..u.len()).map(|i| w[i] * f(i)).sum::<f64>();
        let total = sum(&|_| 1.0);
        let (mu, my) = (sum(&|i| u[i]) / total, sum(&|i| y[i]) / total);
        let suu = sum(&|i| (u[i] - mu).powi(2));
        let suy = sum(&|i| (u[i] - mu) * (y[i] - my));
        if !(total > 0.0 && total.is_finite() && suu > 0.0) {
            return None;
        }
        let c = suy / suu;
        let b_weights = (0..u.len()).map(|i| w[i] * (1.0 / total - mu * (u[i] - mu) / suu)).collect();
        let alone = (sum(&|i| u[i] * y[i]) / sum(&|i| u[i] * u[i]), my); // u > 0
        Some(Self { b: my - c * mu, c, b_weights, alone })
    }

    fn constrained(&self) -> (f64, f64) {
        match (self.b >= 0.0, self.c >= 0.0) {
            (true, true) => (self.b, self.c),
            (false, _) => (0.0, self.alone.0.max(0.0)),
            (true, false) => (self.alone.1.max(0.0), 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    #[test]
    fn exact_series_give_their_parameters() {
        for (b, c) in [(0.01, 1.0), (0.0, 2.0), (0.5, 0.0)] {
            let mut levels = Levels::new();
            for spp in [4.0, 16.0, 64.0, 256.0] {
                levels.push(spp, &[Some(b + c / spp)], 0.0);
            }
            let fit = plateau(&levels, Level::TWO_SIDED_95).unwrap();
            assert!((fit.b.value - b).abs() < 1e-9 && (fit.c - c).abs() < 1e-9, "{fit:?}");
        }
    }

    #[test]
    fn the_interval_of_the_floor_covers_it() {
        let mut normals = Normals::new(8);
        for b in [0.0, 0.004, 0.05] {
            let (trials, mut covered) = (1000, 0);
            for _ in 0..trials {
                let mut levels = Levels::new();
                for spp in [4.0, 16.0, 64.0, 256.0] {
                    let e: Vec<_> =
                        (0..4).map(|_| Some((b + 1.0 / spp) * (1.0 + 0.04 * normals.next()))).collect();
                    levels.push(spp, &e, 0.0);
                }
                let fit = plateau(&levels, Level::TWO_SIDED_95).unwrap();
                covered += u64::from(!fit.b.excludes(b));
            }
            let rate = covered as f64 / trials as f64;
            // Cutting at 0 counts values below it as covered where b = 0: at least nominal there.
            let slack = 4.0 * crate::rate_standard_error(0.95, trials);
            assert!(rate > 0.95 - slack && (b == 0.0 || rate < 0.95 + slack), "b = {b}: {rate}");
        }
    }

    #[test]
    fn negative_corrected_errors_pull_the_floor_to_zero() {
        let mut levels = Levels::new();
        for (spp, e) in [(4.0, 0.25), (16.0, 0.06), (64.0, -0.001)] {
            levels.push(spp, &[Some(e), Some(e * 1.01)], 0.02);
        }
        let fit = plateau(&levels, Level::TWO_SIDED_95).unwrap();
        assert_eq!((fit.b.value, fit.b.low), (0.0, Some(0.0)));
        assert!((fit.c - 1.0).abs() < 0.1, "{}", fit.c);
    }
}
