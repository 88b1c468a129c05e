use crate::{Interval, Level, normal_quantile, normal_two_sided_p, t_quantile, t_two_sided_p};

/// An effect as it was measured, on the scale of its claim's region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// The estimate; two numbers where it depends on something that the data do not decide, such as an allowance for the
    /// reference's noise, the smaller first.
    pub estimate: [f64; 2],
    /// Ends of its interval, over both estimates; none without one.
    pub ends: Option<[f64; 2]>,
    /// Standard error, common part included.
    pub standard_error: f64,
    /// Part of the standard error that more replicates do not take away, such as the reference's.
    pub common: f64,
    /// Replicates; below 2 the standard error is from within one image, and nothing is judged by it.
    pub replicates: u32,
    /// Independent trials, for a rate: they say something where all replicates show the same rate of 0 or 1.
    pub trials: Option<u64>,
    /// Level of the interval.
    pub level: Level,
}

impl Evidence {
    /// An effect whose interval is symmetric or of a rate. `common` as in [`Evidence::common`].
    #[must_use]
    pub fn of(interval: &Interval, common: f64) -> Self {
        Self {
            estimate: [interval.value; 2],
            ends: interval.low.zip(interval.high).map(|(low, high)| [low, high]),
            standard_error: interval.standard_error.unwrap_or(0.0),
            common,
            replicates: interval.n,
            trials: None,
            level: interval.level,
        }
    }

    /// The logarithm of a positive ratio, whose interval is symmetric on that scale; `common` is on it, too. `None` where
    /// the ratio or an end is not positive.
    #[must_use]
    pub fn of_log_ratio(interval: &Interval, common: f64) -> Option<Self> {
        let positive = |v: f64| v > 0.0 && v.is_finite();
        let ends = interval.low.zip(interval.high).map(|(low, high)| [low, high]);
        if !positive(interval.value) || ends.is_some_and(|ends| !ends.into_iter().all(positive)) {
            return None;
        }
        let ends = ends.map(|ends| ends.map(f64::ln));
        let mut out = Self {
            estimate: [interval.value.ln(); 2],
            ends,
            standard_error: 0.0,
            common,
            replicates: interval.n,
            trials: None,
            level: interval.level,
        };
        // The half-width is the critical value, which is positive, times the standard error.
        out.standard_error =
            ends.map_or(0.0, |[low, high]| 0.5 * (high - low) / out.critical(out.replicates));
        Some(out)
    }

    /// The same with the trials of a rate behind it.
    #[must_use]
    pub fn with_trials(self, trials: u64) -> Self {
        Self { trials: Some(trials), ..self }
    }

    /// This estimate or that one: everything between is possible.
    #[must_use]
    pub fn or(self, other: &Self) -> Self {
        let span = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self {
            estimate: span(self.estimate, other.estimate),
            ends: self.ends.zip(other.ends).map(|(a, b)| span(a, b)),
            standard_error: self.standard_error.max(other.standard_error),
            common: self.common.max(other.common),
            ..self
        }
    }

    /// Critical value over so many replicates; that of the normal distribution within one image.
    pub(super) fn critical(&self, replicates: u32) -> f64 {
        if replicates < 2 {
            normal_quantile(self.level)
        } else {
            t_quantile(self.level, u64::from(replicates) - 1)
        }
    }

    /// Two-sided p-value of a distance from the effect, consistent with its interval.
    pub(super) fn p_of(&self, distance: f64) -> f64 {
        if distance <= 0.0 {
            return 1.0;
        }
        if self.standard_error > 0.0 {
            let statistic = distance / self.standard_error;
            return match self.replicates {
                0 | 1 => normal_two_sided_p(statistic),
                n => t_two_sided_p(statistic, u64::from(n) - 1),
            };
        }
        // All replicates agree. A rate of 0 or 1 over so many independent trials has the exact limit d at the two-sided
        // level α = 2·(1−d)^trials; anything else that does not vary is what it is.
        match self.trials {
            Some(trials) if distance < 1.0 => (2.0 * ((-distance).ln_1p() * trials as f64).exp()).min(1.0),
            _ => 0.0,
        }
    }
}
