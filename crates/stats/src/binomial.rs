//! Exact inference on a rate from independent trials.
//!
//! Tails are sums of probabilities from the count outwards, each term by its ratio to the one before: all terms are
//! positive and nothing cancels, at 10⁸ trials as at 10. (A continued fraction of the incomplete beta function takes about
//! √n terms near the mean; the library's stops after 140.)

use thiserror::Error;

use crate::pmf::binomial;
use crate::{Interval, Level};

/// Counts or rates that are none.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum BinomialError {
    /// No trials, more than [`MOST_TRIALS`], or more hits than trials.
    #[error("{hits} hits of {trials} trials: expected 1 to 100000000 trials and no more hits than trials")]
    Counts {
        /// Hits given.
        hits: u64,
        /// Trials given.
        trials: u64,
    },
    /// A rate outside [0, 1], or an interval of rates whose ends are not in order.
    #[error("rates are {low} to {high}, expected two numbers in order between 0 and 1")]
    Rate {
        /// Lower end given; the rate where there is one only.
        low: f64,
        /// Upper end given.
        high: f64,
    },
}

/// Most trials that are taken.
pub const MOST_TRIALS: u64 = 100_000_000;

fn check(hits: u64, trials: u64) -> Result<(), BinomialError> {
    if (1..=MOST_TRIALS).contains(&trials) && hits <= trials {
        Ok(())
    } else {
        Err(BinomialError::Counts { hits, trials })
    }
}

/// P(X ≥ k), where k is at least the mean up to one, so that terms fall.
fn sum_upwards(k: u64, n: u64, p: f64, q: f64) -> f64 {
    let odds = p / q; // q > 0
    let (mut term, mut sum) = (1.0, 1.0);
    for j in k..n {
        term *= (n - j) as f64 / (j + 1) as f64 * odds;
        sum += term;
        if term < f64::EPSILON * 0.01 * sum {
            break;
        }
    }
    binomial(k, n, p, q) * sum
}

/// P(X ≥ k) for X binomial, p and q = 1 − p above 0.
fn upper_tail(k: u64, n: u64, p: f64, q: f64) -> f64 {
    if k == 0 {
        1.0
    } else if k as f64 >= n as f64 * p {
        sum_upwards(k, n, p, q)
    } else {
        // Below the mean: what is left out has at most about half of the probability.
        1.0 - sum_upwards(n - (k - 1), n, q, p)
    }
}

/// P(X ≤ k), as P(n − X ≥ n − k).
fn lower_tail(k: u64, n: u64, p: f64, q: f64) -> f64 {
    upper_tail(n - k, n, q, p)
}

/// The rate in (low, high) up to which `below` is true; relative accuracy 1e-14.
fn solve(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..1100 {
        let middle = 0.5 * (low + high);
        if high - low <= 1e-14 * high || middle <= low || middle >= high {
            break;
        }
        if below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Interval of a rate from `hits` of `trials` independent trials (Clopper, Pearson 1934): the rates under which neither
/// so many nor so few hits have a probability below α/2 (α above and no lower limit for an upper level). Its coverage is
/// never below the level. The standard error is absent: the interval is not made of one.
///
/// # Errors
/// [`BinomialError::Counts`].
pub fn clopper_pearson(hits: u64, trials: u64, level: Level) -> Result<Interval, BinomialError> {
    check(hits, trials)?;
    let value = hits as f64 / trials as f64; // trials ≥ 1
    let tail = level.upper_tail();
    let low = match level.sides() {
        crate::Sides::Two if hits > 0 => solve(0.0, value, |p| upper_tail(hits, trials, p, 1.0 - p) < tail),
        _ => 0.0,
    };
    let high =
        if hits < trials { solve(value, 1.0, |p| lower_tail(hits, trials, p, 1.0 - p) > tail) } else { 1.0 };
    let n = u32::try_from(trials).unwrap_or(u32::MAX);
    Ok(Interval { low: Some(low), high: Some(high), n, ..Interval::point(value, level) })
}

/// Two-sided p-value of `hits` of `trials` independent trials under a rate: twice the smaller tail, at most 1. (Of the
/// two-sided rules this one inverts to Clopper and Pearson's interval.)
///
/// # Errors
/// [`BinomialError`] if counts or rate are none.
pub fn binomial_two_sided_p(hits: u64, trials: u64, rate: f64) -> Result<f64, BinomialError> {
    check(hits, trials)?;
    if !(0.0..=1.0).contains(&rate) {
        return Err(BinomialError::Rate { low: rate, high: rate });
    }
    if rate <= 0.0 || rate >= 1.0 {
        let certain = hits == if rate <= 0.0 { 0 } else { trials };
        return Ok(f64::from(u8::from(certain)));
    }
    let tail = lower_tail(hits, trials, rate, 1.0 - rate).min(upper_tail(hits, trials, rate, 1.0 - rate));
    Ok((2.0 * tail).clamp(0.0, 1.0))
}

/// The largest p-value of [`binomial_two_sided_p`] over the rates from `low` to `high`: 1 where the share of hits is among
/// them, else that of the nearest end. (For k < n·low the median is at least k, so twice the lower tail is the p-value, and
/// that falls with the rate; likewise above.)
///
/// # Errors
/// [`BinomialError`] if counts or rates are none, or the ends are not in order.
pub fn binomial_p_against(hits: u64, trials: u64, low: f64, high: f64) -> Result<f64, BinomialError> {
    check(hits, trials)?;
    if !(0.0..=1.0).contains(&low) || !(low..=1.0).contains(&high) {
        return Err(BinomialError::Rate { low, high });
    }
    let share = hits as f64 / trials as f64; // trials ≥ 1
    if (low..=high).contains(&share) {
        return Ok(1.0);
    }
    binomial_two_sided_p(hits, trials, if share < low { low } else { high })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(hits: u64, trials: u64, level: Level) -> (f64, f64) {
        let i = clopper_pearson(hits, trials, level).unwrap();
        (i.low.unwrap(), i.high.unwrap())
    }

    #[test]
    fn tails_are_sums_of_probabilities() {
        for (n, p) in [(1u64, 0.5), (9, 0.02), (30, 0.4), (60, 0.9)] {
            for k in 0..=n {
                let slow: f64 = (k..=n).map(|j| binomial(j, n, p, 1.0 - p)).sum();
                assert!((upper_tail(k, n, p, 1.0 - p) / slow - 1.0).abs() < 1e-12, "{k} of {n} at {p}");
                let slow: f64 = (0..=k).map(|j| binomial(j, n, p, 1.0 - p)).sum();
                assert!((lower_tail(k, n, p, 1.0 - p) / slow - 1.0).abs() < 1e-12, "{k} of {n} at {p}");
            }
        }
    }

    #[test]
    fn tails_of_many_trials_agree_with_edgeworths_series() {
        // P(X ≥ k) with the correction for continuity, h = (k − ½ − np)/σ: sf(h) + φ(h)·γ(h² − 1)/6, γ = (1−2p)/σ; what is
        // left out is of the order γ²h⁶/72.
        use statrs::distribution::{Continuous, ContinuousCDF, Normal};
        let (n, p) = (100_000_000u64, 0.05);
        let (mean, sigma) = (n as f64 * p, (n as f64 * p * (1.0 - p)).sqrt());
        let normal = Normal::standard();
        for standard_errors in [-6.0, -2.0, -0.1, 0.0, 0.1, 2.0, 6.0] {
            let k = (mean + standard_errors * sigma).round();
            let h = (k - 0.5 - mean) / sigma;
            let series = normal.sf(h) + normal.pdf(h) * (1.0 - 2.0 * p) / sigma * (h * h - 1.0) / 6.0;
            let ratio = upper_tail(k as u64, n, p, 1.0 - p) / series;
            assert!((ratio - 1.0).abs() < 1e-6 + 1e-8 * h.powi(6), "{standard_errors}: {ratio}");
        }
    }

    #[test]
    fn intervals_agree_with_printed_and_closed_ones() {
        // Clopper, Pearson 1934: 10 of 100 at 95 %; R's binom.test prints 0.04900469 to 0.17622260.
        let (low, high) = ends(10, 100, Level::TWO_SIDED_95);
        assert!((low - 0.049_004_69).abs() < 5e-9 && (high - 0.176_222_60).abs() < 5e-9, "{low} {high}");
        // No hit: 1 − (α/2)^(1/n), at 10⁸ trials too.
        for trials in [1u64, 30, MOST_TRIALS] {
            let (low, high) = ends(0, trials, Level::TWO_SIDED_95);
            let exact = -(0.025f64.ln() / trials as f64).exp_m1();
            assert!(low == 0.0 && (high - exact).abs() < 1e-15 + 1e-9 * exact, "{high} {exact}");
            let (low, high) = ends(trials, trials, Level::TWO_SIDED_95);
            assert!(high == 1.0 && (low - (1.0 - exact)).abs() < 1e-13, "{low}");
        }
        // One-sided: the whole of α is above.
        let (low, high) = ends(0, 59, Level::upper(0.95).unwrap());
        assert!(low == 0.0 && (high - (1.0 - 0.05f64.powf(1.0 / 59.0))).abs() < 1e-13);
    }

    #[test]
    fn an_interval_ends_where_the_p_value_is_alpha() {
        for (hits, trials) in [(3u64, 17u64), (950, 1000), (94_990_000, MOST_TRIALS)] {
            let (low, high) = ends(hits, trials, Level::TWO_SIDED_99);
            for end in [low, high] {
                let p = binomial_two_sided_p(hits, trials, end).unwrap();
                // The rate is known to 1e-16; at 10⁸ trials that moves the p-value by 1e-11 relative.
                assert!((p / 0.01 - 1.0).abs() < 1e-8, "{hits} of {trials}: {p} at {end}");
            }
        }
    }

    #[test]
    fn intervals_cover_at_least_as_often_as_stated() {
        let n = 40u64;
        for p in [0.013, 0.2, 0.5, 0.77] {
            let covered: f64 = (0..=n)
                .filter(|&k| {
                    let (low, high) = ends(k, n, Level::TWO_SIDED_95);
                    (low..=high).contains(&p)
                })
                .map(|k| binomial(k, n, p, 1.0 - p))
                .sum();
            assert!(covered >= 0.95, "{p}: {covered}");
        }
    }

    #[test]
    fn p_values_are_against_the_nearest_rate() {
        // 2·(1 + 10 + 45)/1024.
        assert!((binomial_two_sided_p(2, 10, 0.5).unwrap() - 0.109_375).abs() < 1e-14);
        assert_eq!(binomial_two_sided_p(5, 10, 0.5), Ok(1.0));
        assert_eq!(binomial_two_sided_p(1, 10, 0.0), Ok(0.0));
        assert_eq!(binomial_two_sided_p(10, 10, 1.0), Ok(1.0));
        assert_eq!(binomial_p_against(945, 1000, 0.94, 0.96), Ok(1.0));
        let below = binomial_p_against(900, 1000, 0.94, 0.96).unwrap();
        assert_eq!(Ok(below), binomial_two_sided_p(900, 1000, 0.94));
        for step in 0..=20 {
            let rate = 0.94 + 0.001 * f64::from(step);
            assert!(
                binomial_two_sided_p(900, 1000, rate).unwrap() <= below,
                "the nearest end is the largest"
            );
        }
    }

    #[test]
    fn what_is_no_count_or_rate_is_refused() {
        assert!(clopper_pearson(0, 0, Level::TWO_SIDED_95).is_err());
        assert!(clopper_pearson(1, MOST_TRIALS + 1, Level::TWO_SIDED_95).is_err());
        let error = clopper_pearson(3, 2, Level::TWO_SIDED_95).unwrap_err();
        assert!(error.to_string().starts_with("3 hits of 2 trials"), "{error}");
        assert!(binomial_two_sided_p(1, 2, f64::NAN).is_err() && binomial_two_sided_p(1, 2, 1.5).is_err());
        assert!(binomial_p_against(1, 2, 0.6, 0.5).is_err());
    }
}
