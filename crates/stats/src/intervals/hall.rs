use super::critical::{Critical, Tails};
use super::each::each;
use super::family::{IntervalFamily, IntervalNeed};
use super::planes::{IntervalPlanes, SamplePlanes};
use super::skewness::skewness_over_root_n;
use crate::{Level, ShapeError};

/// The t-interval of a transformed T = (x̄ − μ)·√n/s, whose distribution is less skewed (Hall 1992).
///
/// The distribution function of T begins Φ(x) + γ·(2x² + 1)·φ(x)/(6·√n). Adding γ·(2T² + 1)/(6·√n) to T takes the second
/// term away, and γ²·T³/(27·n), of the next order, makes the sum rise everywhere. With a = γ̂/√n:
///
///   g(T) = T + a·T²/3 + a²·T³/27 + a/6 = ((1 + a·T/3)³ − 1)/a + a/6,
///   g⁻¹(y) = 3·(∛(1 + x) − 1)/a  with x = a·(y − a/6).
///
/// μ is between x̄ − (s/√n)·g⁻¹(t) and x̄ − (s/√n)·g⁻¹(−t). Hall takes the normal quantile, and s and γ̂ of moments over n; the
/// quantile of t with n−1 degrees of freedom makes it the t-interval where the samples are not skewed, and the unbiased
/// moments that frames carry make γ̂ larger by √(n·(n−1))/(n−2). For many samples that is the same.
#[derive(Debug)]
pub(super) struct Hall;

/// g⁻¹(y). In terms of c = ∛(1 + x), c − 1 = x/(c² + c + 1): nothing cancels for small a, and c² + c + 1 ≥ 3/4.
fn untransformed(y: f64, a: f64) -> f64 {
    let shifted = y - a / 6.0;
    let c = (1.0 + a * shifted).cbrt();
    3.0 * shifted / (c * c + c + 1.0)
}

impl IntervalFamily for Hall {
    fn id(&self) -> &'static str {
        "hall"
    }

    fn name(&self) -> &'static str {
        "Hall's transformed t"
    }

    fn source(&self) -> &'static str {
        "Hall, On the removal of skewness by transformation, J. R. Statist. Soc. B 54(1), 1992"
    }

    fn needs(&self) -> &'static [IntervalNeed] {
        &[IntervalNeed::ThirdMoment]
    }

    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        planes.check()?;
        let Some(third_moment) = planes.third_moment else { return Ok(None) };
        let critical = Critical::new(Tails::equal(level), planes.observed.counts);
        let intervals = each(planes, |seen| {
            let a = skewness_over_root_n(third_moment[seen.index], seen)?;
            let [below, above] = critical.at(seen.n);
            let low = if below.is_finite() {
                seen.mean - seen.standard_error * untransformed(below, a)
            } else {
                f64::NEG_INFINITY
            };
            let high = if above.is_finite() {
                seen.mean - seen.standard_error * untransformed(-above, a)
            } else {
                f64::INFINITY
            };
            Some([low, high])
        })?;
        Ok(Some(intervals))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn transformed(t: f64, a: f64) -> f64 {
        t + a * t * t / 3.0 + a * a * t.powi(3) / 27.0 + a / 6.0
    }

    #[test]
    fn the_closed_form_undoes_the_cubic() {
        for a in [-1.0, -0.3, -1e-9, 0.0, 1e-12, 0.01, 0.5, 1.0] {
            for y in [-300.0, -12.7, -3.0, -0.2, 0.0, 0.1, 2.0, 9.9, 300.0] {
                let t = untransformed(y, a);
                let scale = 1.0 + t.abs().powi(3);
                assert!((transformed(t, a) - y).abs() < 1e-12 * scale, "a = {a}, y = {y}: {t}");
            }
        }
    }

    #[test]
    fn the_closed_form_rises_with_the_critical_value() {
        for a in [-1.0, -0.2, 0.0, 0.7, 1.0] {
            let values: Vec<f64> = (-2000..2000).map(|k| untransformed(f64::from(k) * 0.01, a)).collect();
            assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "a = {a}");
        }
    }
}
