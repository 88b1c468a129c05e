use super::critical::{Critical, Tails, reach};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use super::window::window;
use crate::{Level, ShapeError};

/// The t-interval with an allowance for light that no sample of the pixel met.
///
/// Let m be the pixel's greatest sample and B a bound of its samples. Then E X ≤ E min(X, m) + (B − m)·P(X > m), and of n
/// independent samples the probability mass beyond the greatest exceeds 1 − β^(1/n) with probability at most β: a mass q is
/// missed by all with probability (1−q)^n. So with half of each tail for t and half for what was not seen, β each,
///
///   high = x̄ + t(β)·s/√n + (B − m)·(1 − β^(1/n)),
///
/// and below likewise with the least samples. The second step is exact for any law; that t covers the mean of what was
/// seen is not, and no more is the bound: B is the greatest sample of the 7×7 pixels around, cut at the borders, light that a
/// neighbour met and the pixel may have missed. No theorem holds for a bound that is taken from the data. Where all samples
/// are dark the upper end is the exact limit of a proportion, times B (Clopper, Pearson 1934), 0.89·B at 2 samples and
/// 0.066·B at 64 for 95 %.
#[derive(Debug)]
pub(super) struct RareEventT;

/// 1 − β^(1/n) of a tail halved, with the halved tail: mass that n samples may have missed.
fn unseen(tail: f64, n: u32) -> f64 {
    -((0.5 * tail).ln() / f64::from(n)).exp_m1()
}

impl IntervalFamily for RareEventT {
    fn id(&self) -> &'static str {
        "rare-event-t"
    }

    fn name(&self) -> &'static str {
        "t with an allowance for unseen light"
    }

    fn source(&self) -> &'static str {
        "none: its bound of the samples is taken from the data"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[IntervalNeed::Extremes, IntervalNeed::Neighbours]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        planes.check()?;
        let (Some(least), Some(greatest)) = (planes.least, planes.greatest) else { return Ok(None) };
        let tails = Tails::equal(level);
        let halved = Tails { below: tails.below.map(|p| 0.5 * p), above: tails.above.map(|p| 0.5 * p) };
        let critical = Critical::new(halved, planes.observed.counts);
        let allowance = |tail: Option<f64>, n, range: f64| tail.map_or(0.0, |tail| unseen(tail, n) * range);
        let intervals = each(planes, |seen| {
            let around = window(planes, seen.index);
            // The pixel itself is in its window, so neither range is negative.
            let (darkest, brightest) = around
                .fold((least[seen.index], greatest[seen.index]), |(low, high), i| {
                    (low.min(least[i]), high.max(greatest[i]))
                });
            let darker = f64::from(least[seen.index]) - f64::from(darkest);
            let brighter = f64::from(brightest) - f64::from(greatest[seen.index]);
            if !darker.is_finite() || !brighter.is_finite() {
                return None;
            }
            let [below, above] = critical.at(seen.n).map(|t| reach(t, seen.standard_error));
            Some([
                seen.mean - below - allowance(tails.below, seen.n, darker),
                seen.mean + above + allowance(tails.above, seen.n, brighter),
            ])
        })?;
        Ok(Some(intervals))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mass_that_may_be_missed_is_missed_with_that_probability() {
        for (tail, n) in [(0.025, 2u32), (0.025, 64), (0.001, 16)] {
            let q = unseen(tail, n);
            assert!(((1.0 - q).powi(n as i32) - 0.5 * tail).abs() < 1e-12);
        }
        assert!((unseen(0.025, 64) - 0.0662).abs() < 5e-5 && (unseen(0.025, 2) - 0.8882).abs() < 5e-5);
    }
}
