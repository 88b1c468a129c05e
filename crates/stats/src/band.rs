//! Simultaneous limits of an empirical distribution function of uniform numbers (Säilynoja, Bürkner, Vehtari 2022, Stat.
//! Comput. 32:32, section 2.2).
//!
//! At the K points z_i = i/K the count of N uniform numbers up to z_i is binomial. Its quantiles at γ/2 and 1 − γ/2 limit one
//! point; γ is chosen so that all counts stay inside their limits together with the wanted probability. That probability
//! follows from a recursion over the points: the counts are a Markov chain. It is carried here by Poisson increments of
//! mean N/K, given that they add up to N, which have the same law as the binomial ones; every step is then the same
//! convolution.

use thiserror::Error;

use crate::pmf::{binomial, poisson};

/// Numbers of values or points that no band is made for.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BandError {
    /// No values, or more than [`EcdfBand::MOST_VALUES`].
    #[error("{got} values, expected 1 to {most}", most = EcdfBand::MOST_VALUES)]
    Values {
        /// Values given.
        got: usize,
    },
    /// Fewer than 2 points, or more than [`EcdfBand::MOST_POINTS`].
    #[error("{got} points of evaluation, expected 2 to {most}", most = EcdfBand::MOST_POINTS)]
    Points {
        /// Points given.
        got: usize,
    },
    /// A probability outside (0, 1).
    #[error("simultaneous probability is {got}, it must lie strictly between 0 and 1")]
    Probability {
        /// The value given.
        got: f64,
    },
}

/// Limits between which an empirical distribution function of uniform numbers stays at all points together.
#[derive(Debug, Clone, PartialEq)]
pub struct EcdfBand {
    /// γ: the two-sided level of each point, between (1−p)/K and 1−p for the simultaneous probability p, up to the steps of
    /// the counts.
    pub gamma: f64,
    /// Simultaneous probability of the limits: at least the wanted one, above it by what the steps of counts leave.
    pub probability: f64,
    /// Lower limit of F̂ at i/K, i = 1…K.
    pub low: Vec<f64>,
    /// Upper limit there; staying inside includes the limits.
    pub high: Vec<f64>,
}

impl EcdfBand {
    /// Most values. The work grows with values times points; that of 1000 values at 100 points is below a second.
    pub const MOST_VALUES: usize = 10_000;
    /// Most points.
    pub const MOST_POINTS: usize = 500;

    /// The band of `values` uniform numbers at `points` equally spaced points with the simultaneous `probability`: that of
    /// the largest γ, within 1e-4 of itself, at which it is reached.
    ///
    /// # Errors
    /// [`BandError`] if there are too few or too many of something.
    pub fn new(values: usize, points: usize, probability: f64) -> Result<Self, BandError> {
        if !(1..=Self::MOST_VALUES).contains(&values) {
            return Err(BandError::Values { got: values });
        }
        if !(2..=Self::MOST_POINTS).contains(&points) {
            return Err(BandError::Points { got: points });
        }
        if !(probability > 0.0 && probability < 1.0) {
            return Err(BandError::Probability { got: probability });
        }
        let chain = Chain::new(values, points);
        // Bonferroni's γ is small enough; one point alone needs no more than 1 − p.
        let mut least = (1.0 - probability) / points as f64;
        let mut most = 1.0 - probability;
        if chain.inside(&chain.limits(most)) >= probability {
            least = most;
        }
        while most - least > 1e-4 * most {
            let middle = 0.5 * (least + most);
            let reached = chain.inside(&chain.limits(middle)) >= probability;
            (least, most) = if reached { (middle, most) } else { (least, middle) };
        }
        let limits = chain.limits(least);
        let share = |count: usize| count as f64 / values as f64; // at least one value
        Ok(Self {
            gamma: least,
            probability: chain.inside(&limits),
            low: limits.iter().map(|l| share(l.0)).collect(),
            high: limits.iter().map(|l| share(l.1)).collect(),
        })
    }

    /// Whether an empirical distribution function, evaluated at the same points, stays inside. False for another number of
    /// points.
    #[must_use]
    pub fn contains(&self, ecdf: &[f64]) -> bool {
        let ends = self.low.iter().zip(&self.high);
        ecdf.len() == self.low.len() && ecdf.iter().zip(ends).all(|(f, (low, high))| f >= low && f <= high)
    }
}

/// F̂(i/K) for i = 1…K: the share of the `values` that are at most i/K. Empty for no values or no points.
#[must_use]
pub fn ecdf(values: &[f64], points: usize) -> Vec<f64> {
    if values.is_empty() {
        return Vec::new();
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |i: usize| {
        let z = i as f64 / points as f64; // i ≥ 1, so points ≥ 1
        sorted.partition_point(|u| *u <= z) as f64 / sorted.len() as f64
    };
    (1..=points).map(at).collect()
}

/// The counts of uniform numbers at the points, from left to right.
struct Chain {
    values: usize,
    points: usize,
    /// P(increment = j), Poisson with mean N/K.
    increment: Vec<f64>,
}

impl Chain {
    fn new(values: usize, points: usize) -> Self {
        let mean = values as f64 / points as f64;
        let increment = (0..=values as u64).map(|j| poisson(j, mean)).collect();
        Self { values, points, increment }
    }

    /// Least and greatest count inside at each point: quantiles at γ/2 and 1 − γ/2 of binomials, which mirror each other.
    fn limits(&self, gamma: f64) -> Vec<(usize, usize)> {
        let n = self.values as u64;
        let quantile = |i: usize| {
            let (p, q) = (i as f64 / self.points as f64, (self.points - i) as f64 / self.points as f64);
            let mut below = 0.0;
            let reaches = |k: &u64| {
                below += binomial(*k, n, p, q);
                below >= 0.5 * gamma
            };
            (0..=n).find(reaches).unwrap_or(n) as usize
        };
        let low: Vec<usize> = (0..=self.points).map(quantile).collect();
        (1..=self.points).map(|i| (low[i], self.values - low[self.points - i])).collect()
    }

    /// Probability that the counts stay inside `limits` at all points.
    fn inside(&self, limits: &[(usize, usize)]) -> f64 {
        // chances[j] is that of the count first + j.
        let (mut first, mut chances) = (0, vec![1.0]);
        for &(low, high) in limits {
            let next: Vec<f64> = (low..=high)
                .map(|count| {
                    let from = chances.iter().enumerate().take((count + 1).saturating_sub(first));
                    from.map(|(j, chance)| chance * self.increment[count - first - j]).sum()
                })
                .collect();
            (first, chances) = (low, next);
        }
        // At 1 the count is N, whose probability is about 1/√(2πN) and never 0.
        let total = poisson(self.values as u64, self.values as f64);
        chances.get(self.values - first).map_or(0.0, |chance| chance / total)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;
    use crate::rate_standard_error;

    #[test]
    fn the_recursion_is_the_sum_over_all_ways_to_fall_into_bins() {
        // Six values in three bins: 3⁶ equally likely ways.
        let chain = Chain::new(6, 3);
        let limits = [(1, 3), (2, 5), (6, 6)];
        let ways = (0..729u32).filter(|way| {
            let bins = (0..6).map(|k| way / 3u32.pow(k) % 3);
            let (mut first, mut second) = (0, 0);
            bins.for_each(|b| {
                first += usize::from(b == 0);
                second += usize::from(b <= 1);
            });
            (1..=3).contains(&first) && (2..=5).contains(&second)
        });
        let exact = ways.count() as f64 / 729.0;
        assert!((chain.inside(&limits) - exact).abs() < 1e-14);
        assert!((chain.inside(&[(0, 6), (0, 6), (6, 6)]) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn levels_of_single_points_are_those_of_the_recursion_elsewhere() {
        for (values, points, gamma) in
            [(50, 50, 0.0064), (100, 100, 0.0041), (250, 100, 0.0033), (1000, 100, 0.0027)]
        {
            let band = EcdfBand::new(values, points, 0.95).unwrap();
            assert!((band.gamma - gamma).abs() < 5e-5, "{values}, {points}: {}", band.gamma);
            assert!(band.probability >= 0.95 && band.probability < 0.96, "{}", band.probability);
            assert_eq!((band.low[points - 1], band.high[points - 1]), (1.0, 1.0));
        }
    }

    #[test]
    fn uniform_numbers_stay_inside_as_often_as_stated() {
        let mut normals = Normals::new(3);
        for (values, points) in [(50, 50), (250, 100)] {
            let band = EcdfBand::new(values, points, 0.95).unwrap();
            let draws = 4000;
            let inside = (0..draws).filter(|_| {
                let values: Vec<f64> = (0..values).map(|_| normals.uniform()).collect();
                band.contains(&ecdf(&values, points))
            });
            let rate = inside.count() as f64 / f64::from(draws);
            let mcse = rate_standard_error(band.probability, u64::from(draws as u32));
            assert!((rate - band.probability).abs() < 4.0 * mcse, "{rate} {}", band.probability);
        }
    }

    #[test]
    fn an_empirical_distribution_function_counts_what_is_at_most_a_point() {
        assert_eq!(ecdf(&[0.5, 0.1, 0.75, 1.0], 4), [0.25, 0.5, 0.75, 1.0]);
        assert!(ecdf(&[], 4).is_empty() && ecdf(&[0.5], 0).is_empty());
        let band = EcdfBand::new(4, 4, 0.95).unwrap();
        assert!(band.contains(&ecdf(&[0.1, 0.3, 0.6, 0.9], 4)) && !band.contains(&[0.5, 1.0]));
        assert!(!band.contains(&ecdf(&[0.01; 4], 4)));
    }

    #[test]
    fn sizes_out_of_range_are_refused() {
        assert_eq!(EcdfBand::new(0, 5, 0.95), Err(BandError::Values { got: 0 }));
        assert_eq!(EcdfBand::new(5, 1, 0.95), Err(BandError::Points { got: 1 }));
        assert!(EcdfBand::new(5, 5, f64::NAN).is_err());
        let told = EcdfBand::new(10_001, 5, 0.95).unwrap_err().to_string();
        assert_eq!(told, "10001 values, expected 1 to 10000");
    }
}
