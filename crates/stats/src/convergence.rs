//! A verdict in words: consistent, plateaus at a bias, or undecided.

use serde::{Deserialize, Serialize};

use crate::slope::slope_between;
use crate::{Interval, Level, Levels, Plateau, Slope, plateau, replicate_interval, slope};

/// What a series of errors over sample counts shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trend {
    /// Still falling at the top of the range, and no sign of a floor.
    Consistent,
    /// Flat at the top of the range, at a bias that is significantly above zero and above what the reference
    /// can show.
    Plateaus,
    /// Neither can be said.
    Undecided,
}

impl Trend {
    /// Word in summaries.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Plateaus => "plateaus",
            Self::Undecided => "undecided",
        }
    }
}

/// Convergence of one method on one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Slope over the whole range, in the metric's own power.
    pub slope: Option<Slope>,
    /// Slope over the last factor of four in samples.
    pub tail: Option<Interval>,
    /// Tail slope minus the slope over the first factor of four: above 0 where the curve flattens.
    pub flattening: Option<Interval>,
    /// Floor b of error(n) = b + c/n, in the unit of the metric.
    pub bias: Option<Interval>,
    /// The verdict.
    pub verdict: Trend,
    /// The verdict in a sentence with its numbers.
    pub sentence: String,
}

/// Tail slopes above −0.25 count as flat (squared errors; half of it for their roots): four times the samples
/// take less than a third off the error, where plain Monte Carlo takes three quarters.
const FLAT: f64 = 0.25;
/// Tail slopes below −0.5 count as falling (squared errors).
const FALLING: f64 = 0.5;
/// Head and tail are the first and the last factor of this in samples.
const RANGE: f64 = 4.0;

/// Judges the convergence of a metric of `order` 2 (squared errors) or 1 (their roots) at a two-sided
/// `level`.
///
/// The slope is that of [`slope`]; the floor b is that of [`plateau`], fitted to squared errors. All
/// intervals are at `level`:
///
/// * **plateaus** if the interval of the tail slope lies above −0.25, that of b lies above 0, and b is above
///   the standard error that the reference contributes at the top level;
/// * **consistent** if the interval of the tail slope lies below −0.5, and not both b and the flattening lie
///   above 0 with their intervals: a curve that falls ever more slowly towards a visible floor is not called
///   consistent, while a steady power law slower than 1/n is;
/// * **undecided** otherwise, and always with fewer than three levels or two replicates.
///
/// A finite range never proves consistency: the word says that what was rendered shows no floor. On simulated
/// series (4 to 1024 spp, four replicates, 400 series each) with 3 % noise per frame, 1/n and n^−0.7 are
/// called consistent in at least 99 %, a floor of 20 times the rest at the top is named in all, and neither a
/// steady power law nor noise of the reference is ever called a plateau; with 10 % noise a floor as large as
/// the rest passes for consistent in 6 %.
#[must_use]
pub fn convergence(levels: &Levels, order: u32, level: Level) -> Convergence {
    let power = if order == 1 { 0.5 } else { 1.0 };
    let squared = if order == 1 { levels.squared() } else { levels.clone() };
    let whole = slope(levels, level);
    let fit = plateau(&squared, level);
    let (tail, flattening) = ends(levels, whole.as_ref(), level);
    let floor = levels.len().checked_sub(1).map_or(0.0, |top| squared.reference_se(top));
    let above_zero = |i: Option<Interval>| i.and_then(|i| i.low).is_some_and(|low| low > 0.0);
    let b = fit.map(|fit| fit.b);
    let biased = above_zero(b) && b.is_some_and(|b| b.value > floor);
    let flat = tail.and_then(|t| t.low).is_some_and(|low| low > -FLAT * power);
    let falling = tail.and_then(|t| t.high).is_some_and(|high| high < -FALLING * power);
    let flattens = above_zero(flattening);
    let verdict = if levels.len() < 3 {
        Trend::Undecided
    } else if flat && biased {
        Trend::Plateaus
    } else if falling && !(biased && flattens) {
        Trend::Consistent
    } else {
        Trend::Undecided
    };
    let bias = fit.map(|fit| in_unit(&fit, order));
    let sentence = sentence(levels, verdict, whole.as_ref(), tail, bias, (falling, biased, flattens));
    Convergence { slope: whole, tail, flattening, bias, verdict, sentence }
}

/// Tail slope and flattening over replicates, from the levels that the whole slope uses.
fn ends(levels: &Levels, whole: Option<&Slope>, level: Level) -> (Option<Interval>, Option<Interval>) {
    let Some([first, .., last]) = whole.map(|s| s.spp.as_slice()) else { return (None, None) };
    // A hair of slack, so that levels exactly a factor of four apart belong together.
    let tail = slope_between(levels, level, last / (RANGE * 1.001), f64::INFINITY);
    let head = slope_between(levels, level, 0.0, first * RANGE * 1.001);
    let flattening = tail.as_ref().zip(head).and_then(|(tail, head)| {
        let differences: Vec<f64> =
            tail.slope.per_replicate.iter().zip(&head.slope.per_replicate).map(|(t, h)| t - h).collect();
        let gradient: Vec<f64> = tail.gradient.iter().zip(&head.gradient).map(|(t, h)| t - h).collect();
        replicate_interval(&differences, levels.combined(&gradient).standard_error, level)
    });
    (tail.map(|t| t.slope.interval), flattening)
}

/// b in the unit of the metric.
fn in_unit(fit: &Plateau, order: u32) -> Interval {
    let b = fit.b;
    if order != 1 {
        return b;
    }
    let root = b.value.sqrt(); // b is at least 0, like its ends
    Interval {
        value: root,
        // How far the root moves with the squared value.
        standard_error: b.standard_error.map(|se| (b.value + se).sqrt() - root),
        low: b.low.map(f64::sqrt),
        high: b.high.map(f64::sqrt),
        ..b
    }
}

fn sentence(
    levels: &Levels,
    verdict: Trend,
    whole: Option<&Slope>,
    tail: Option<Interval>,
    bias: Option<Interval>,
    (falling, biased, flattens): (bool, bool, bool),
) -> String {
    let ends = |i: &Interval, digits: usize| match (i.low, i.high) {
        (Some(low), Some(high)) if digits == 0 => format!(" ({low:.2e} to {high:.2e})"),
        (Some(low), Some(high)) => format!(" ({low:.digits$} to {high:.digits$})"),
        _ => String::new(),
    };
    let Some(whole) = whole else {
        return "undecided: no slope without two levels of positive error".into();
    };
    let range = match whole.spp.as_slice() {
        [first, .., last] => format!("{first} to {last} spp"),
        _ => String::new(),
    };
    let fall = format!("slope {:.2}{} over {range}", whole.interval.value, ends(&whole.interval, 2));
    let tail = tail.map_or(String::new(), |t| format!(", {:.2}{} at its end", t.value, ends(&t, 2)));
    let floor = bias.map_or(String::new(), |b| format!("{:.2e}{}", b.value, ends(&b, 0)));
    match verdict {
        Trend::Consistent => format!("consistent: {fall}{tail}, no floor shows"),
        Trend::Plateaus => format!("plateaus at bias {floor}: {fall}{tail}"),
        Trend::Undecided => {
            let why = if levels.len() < 3 {
                "fewer than three levels".to_owned()
            } else if whole.interval.low.is_none() {
                "fewer than two replicates with every level".to_owned()
            } else if biased && flattens {
                format!("flattening towards {floor}, but not flat yet")
            } else if falling {
                "falling, with an unclear floor".to_owned()
            } else {
                "neither clearly flat nor clearly falling at the end".to_owned()
            };
            format!("undecided: {why}; {fall}{tail}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    const TRIALS: u64 = 400;

    /// Shares of the verdicts [consistent, plateaus, undecided] over series with `noise` relative standard
    /// deviation per frame.
    fn shares(order: u32, noise: f64, reference_se: f64, error: impl Fn(f64) -> f64) -> [f64; 3] {
        let mut normals = Normals::new(17);
        let mut counts = [0u32; 3];
        for _ in 0..TRIALS {
            let mut levels = Levels::new();
            let shift = reference_se * normals.next();
            for spp in [4.0, 16.0, 64.0, 256.0, 1024.0] {
                let e: Vec<_> = (0..4)
                    .map(|_| {
                        let squared = error(spp) * (1.0 + noise * normals.next()) + shift;
                        Some(if order == 1 { squared.max(0.0).sqrt() } else { squared })
                    })
                    .collect();
                levels.push(spp, &e, reference_se);
            }
            counts[convergence(&levels, order, Level::TWO_SIDED_95).verdict as usize] += 1;
        }
        counts.map(|c| f64::from(c) / TRIALS as f64)
    }

    /// `rate` lies below `limit` by at least nothing and above it by at most four standard errors.
    fn at_most(rate: f64, limit: f64) -> bool {
        rate <= limit + 4.0 * crate::rate_standard_error(limit, TRIALS)
    }

    #[test]
    fn plain_monte_carlo_is_consistent() {
        for order in [1, 2] {
            let [consistent, plateaus, _] = shares(order, 0.03, 0.0, |n| 1.0 / n);
            assert!(at_most(1.0 - consistent, 0.05) && plateaus == 0.0, "{consistent} {plateaus}");
        }
    }

    #[test]
    fn a_slow_power_law_never_plateaus() {
        for exponent in [-0.5f64, -0.7] {
            let [_, plateaus, _] = shares(2, 0.03, 0.0, |n| n.powf(exponent));
            assert!(at_most(plateaus, 0.01), "{exponent}: {plateaus}");
        }
        let [consistent, ..] = shares(2, 0.03, 0.0, |n| n.powf(-0.7));
        assert!(at_most(1.0 - consistent, 0.05), "{consistent}");
    }

    #[test]
    fn a_bias_that_dominates_is_named() {
        for order in [1, 2] {
            // At 1024 samples the floor is 20 times what falls.
            let [consistent, plateaus, _] = shares(order, 0.03, 0.0, |n| 0.02 + 1.0 / n);
            assert!(at_most(1.0 - plateaus, 0.05) && consistent == 0.0, "{consistent} {plateaus}");
        }
    }

    #[test]
    fn a_bias_as_large_as_the_rest_is_not_called_consistent() {
        let [consistent, ..] = shares(2, 0.03, 0.0, |n| 1.0 / 1024.0 + 1.0 / n);
        assert!(at_most(consistent, 0.05), "{consistent}");
    }

    #[test]
    fn noise_of_the_reference_is_no_bias() {
        // The reference shifts every level by the same amount, as large as the error at the top.
        let [_, plateaus, _] = shares(2, 0.03, 1e-3, |n| 1.0 / n);
        assert!(at_most(plateaus, 0.05), "{plateaus}");
    }

    #[test]
    fn noisy_or_short_series_stay_undecided() {
        let [consistent, plateaus, _] = shares(2, 1.0, 0.0, |n| 0.02 + 1.0 / n);
        assert!(at_most(consistent, 0.05) && at_most(plateaus, 0.5), "{consistent} {plateaus}");
        let mut levels = Levels::new();
        levels.push(4.0, &[Some(1.0), Some(1.1)], 0.0);
        levels.push(16.0, &[Some(0.25), Some(0.27)], 0.0);
        assert_eq!(convergence(&levels, 2, Level::TWO_SIDED_95).verdict, Trend::Undecided);
        let empty = convergence(&Levels::new(), 2, Level::TWO_SIDED_95);
        assert_eq!((empty.verdict, empty.slope), (Trend::Undecided, None));
    }

    #[test]
    fn the_bias_of_a_root_is_in_its_unit() {
        let mut levels = Levels::new();
        for spp in [4.0f64, 16.0, 64.0, 256.0, 1024.0] {
            let e = (0.04 + 0.01 / spp).sqrt();
            levels.push(spp, &[Some(e), Some(e * 1.0001)], 0.0);
        }
        let c = convergence(&levels, 1, Level::TWO_SIDED_95);
        assert_eq!(c.verdict, Trend::Plateaus);
        assert!((c.bias.unwrap().value - 0.2).abs() < 1e-3, "{}", c.sentence);
        assert!(c.sentence.starts_with("plateaus at bias 2.00e-1"), "{}", c.sentence);
    }
}
