//! How many times more samples plain Monte Carlo needs for the same error.

use serde::{Deserialize, Serialize};

use crate::{Interval, Level, MonteCarloFit, ReferenceShare, replicate_interval};

/// An equal-error multiplier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Multiplier {
    /// c/(n·error) with its interval.
    pub interval: Interval,
    /// Whether n times the multiplier exceeds the largest rendered sample count, so that it rests on error =
    /// c/n alone.
    pub extrapolated: bool,
    /// The error is not above zero, so the multiplier has no upper limit and the value is a lower one:
    /// c/(n·upper end of the error).
    pub at_least: bool,
}

/// c/(n·error) from Monte Carlo's constant and a method's squared errors at `spp` samples, one per replicate.
///
/// The interval is that of the logarithm, by the delta method: squared relative standard errors of c and of the mean error
/// over replicates add up, as if independent. Both come from the same inputs: that is too much where they move together, as
/// the error of a filter mostly does with its input's, and too little where they move against each other. What the
/// reference contributes is the share in ln c − ln error, exact where the influences of its parts are known. Student's t
/// with the smaller number of degrees of freedom, that of the replicates. `None` without errors, or if no positive limit
/// exists.
#[must_use]
pub fn equal_error_multiplier(
    fit: &MonteCarloFit,
    spp: f64,
    errors: &[f64],
    reference: &ReferenceShare,
    largest_spp: f64,
    level: Level,
) -> Option<Multiplier> {
    let reference_se = reference.standard_error;
    let error = replicate_interval(errors, reference_se, level)?;
    let spread = replicate_interval(errors, 0.0, level)?;
    let c = fit.c.value;
    if !(c > 0.0 && spp > 0.0) {
        return None;
    }
    if error.value <= 0.0 {
        let limit = c / (spp * error.below(reference_se)?); // `below` is positive
        let interval = Interval { low: Some(limit), n: error.n, ..Interval::point(limit, level) };
        return Some(Multiplier { interval, extrapolated: spp * limit > largest_spp, at_least: true });
    }
    let value = c / (spp * error.value);
    let interval = match (spread.standard_error, fit.replicate_se, fit.c.standard_error) {
        (Some(own), Some(own_of_c), Some(of_c)) => {
            let relative = if reference.has_parts() && fit.reference.has_parts() {
                let shared =
                    ReferenceShare::combined(&[(1.0 / c, &fit.reference), (-1.0 / error.value, reference)]);
                (own / error.value).hypot(own_of_c / c).hypot(shared.standard_error)
            } else {
                (own.hypot(reference_se) / error.value).hypot(of_c / c)
            };
            let degrees = Some(u64::from(error.n.max(2)) - 1); // a standard error needs two replicates
            Interval::symmetric(value.ln(), relative, level, degrees, error.n).exp()
        }
        _ => Interval { n: error.n, ..Interval::point(value, level) },
    };
    Some(Multiplier { interval, extrapolated: spp * value > largest_spp, at_least: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Levels, monte_carlo_constant};

    const LEVEL: Level = Level::TWO_SIDED_95;
    const NONE: ReferenceShare = ReferenceShare { standard_error: 0.0, parts: Vec::new(), product: 0.0 };

    fn fit() -> MonteCarloFit {
        let mut levels = Levels::new();
        for spp in [4.0, 16.0, 64.0] {
            levels.push(spp, &[Some(1.02 / spp), Some(0.98 / spp), Some(1.0 / spp)], 0.0);
        }
        monte_carlo_constant(&levels, LEVEL).unwrap()
    }

    #[test]
    fn monte_carlo_itself_has_multiplier_one() {
        let m =
            equal_error_multiplier(&fit(), 16.0, &[1.02 / 16.0, 0.98 / 16.0, 1.0 / 16.0], &NONE, 64.0, LEVEL);
        let m = m.unwrap();
        assert!((m.interval.value - 1.0).abs() < 1e-9 && !m.extrapolated && !m.interval.excludes(1.0));
    }

    #[test]
    fn beyond_the_rendered_levels_it_is_marked() {
        let m = equal_error_multiplier(&fit(), 16.0, &[0.011, 0.009], &NONE, 64.0, LEVEL).unwrap();
        assert!((m.interval.value - 6.25).abs() < 0.01 && m.extrapolated && !m.at_least);
        assert!(m.interval.low.unwrap() > 0.0);
        let m = equal_error_multiplier(&fit(), 16.0, &[0.1, 0.1], &NONE, 64.0, LEVEL).unwrap();
        assert!((m.interval.value - 0.625).abs() < 1e-3 && !m.extrapolated);
    }

    #[test]
    fn an_error_below_zero_gives_a_lower_limit() {
        let m =
            equal_error_multiplier(&fit(), 4.0, &[-0.01, -0.02, -0.01], &0.005.into(), 64.0, LEVEL).unwrap();
        assert!(m.at_least && m.interval.high.is_none());
        assert!(m.interval.low.unwrap() <= 1.0 / (4.0 * 0.005) + 1e-9);
    }
}
