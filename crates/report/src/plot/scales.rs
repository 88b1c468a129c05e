//! The axis that an exhibit asks for.

use noisefloor_study::exhibit;

use super::axis::{Axis, Scale, Tick, log_range, log_ticks, plain};

/// Share of an axis that stands for zero.
const ZERO_STRIP: f64 = 0.09;

/// Nothing nearer to 1 sets the end of an axis of fractions: its logarithm has no place for 1 itself.
const HIGHEST_FRACTION: f64 = 0.9999;

impl Axis {
    /// Covers the exhibit's values, on its scale.
    pub(crate) fn of(asked: &exhibit::Axis) -> Self {
        let values = || asked.values.iter().copied();
        match asked.scale {
            exhibit::Scale::Linear => linear(&asked.title, &asked.values),
            exhibit::Scale::Log => Self::log(&asked.title, values()),
            exhibit::Scale::Seconds => Self::seconds(&asked.title, values()),
            exhibit::Scale::LogWithZero => with_zero(&asked.title, &asked.values),
            exhibit::Scale::Miss => miss(&asked.title, &asked.values),
            exhibit::Scale::Levels => {
                let whole = |v: &f64| v.is_finite() && *v >= 1.0 && *v <= f64::from(u32::MAX);
                let mut levels: Vec<u32> = values().filter(whole).map(|v| v.round() as u32).collect();
                levels.sort_unstable();
                levels.dedup();
                Self::spp(&asked.title, &levels)
            }
        }
    }
}

/// From the lowest to the highest value with a margin, ticks at 1, 2 or 5 times a power of ten.
fn linear(title: &str, values: &[f64]) -> Axis {
    // Beyond this a span could overflow.
    let finite = || values.iter().copied().filter(|v| v.abs() < 1e300);
    let (mut low, mut high) =
        finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if low > high {
        (low, high) = (0.0, 1.0);
    }
    // At least a millionth of the values, so that ticks stay apart; a single zero gets a range of its own.
    let least = (1e-6 * low.abs().max(high.abs())).max(1e-290);
    let margin = (0.05 * (high - low)).max(least);
    let (low, high) = (low - margin, high + margin);
    let step = round_step((high - low) / 5.0);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    let tick = |k: i64| {
        let value = k as f64 * step;
        let text = if k == 0 { "0".to_owned() } else { format!("{value:.decimals$}").replace('-', "−") };
        Tick { value, label: Some(text) }
    };
    Axis { scale: Scale::Linear, low, high, ticks: (first..=last).map(tick).collect(), title: title.into() }
}

/// The least of 1, 2 or 5 times a power of ten that is not below a positive span.
fn round_step(span: f64) -> f64 {
    let ten = 10f64.powf(span.log10().floor());
    let digit = [1.0, 2.0, 5.0].into_iter().find(|digit| digit * ten >= span);
    ten * digit.unwrap_or(10.0)
}

/// Rates from zero: values under one in ten million do not stretch the axis, and a rate ends at 1.
fn with_zero(title: &str, values: &[f64]) -> Axis {
    let (low, mut high) = log_range(values.iter().copied().filter(|v| *v > 1e-7), 0.08);
    if values.iter().all(|v| *v <= 1.0) && low < 1.0 {
        high = high.min(1.0);
    }
    let ticks = log_ticks(low, high, &plain);
    Axis { scale: Scale::LogWithZero(ZERO_STRIP), low, high, ticks, title: title.into() }
}

/// From just under the lowest value to a little above the highest.
fn miss(title: &str, values: &[f64]) -> Axis {
    let usable = || values.iter().copied().filter(|v| (0.0..=HIGHEST_FRACTION).contains(v));
    let lowest = usable().fold(0.95, f64::min);
    let highest = usable().fold(0.95, f64::max);
    let high = 1.0 - (1.0 - highest) / 3.0;
    let low = (1.0 - (1.0 - lowest).max(0.05) * 1.25).clamp(0.0, 0.94);
    let places = [0.0, 0.2, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995, 0.9999];
    let mut ticks: Vec<Tick> = Vec::new();
    let axis = Axis { scale: Scale::Miss, low, high, ticks: vec![], title: title.into() };
    let mut last = -1.0;
    for value in places.into_iter().filter(|v| (low..=high).contains(v)) {
        let at = axis.position(value);
        if at - last < 0.055 {
            continue;
        }
        last = at;
        let percent = 100.0 * value;
        ticks.push(Tick { value, label: Some(format!("{} %", (percent * 100.0).round() / 100.0)) });
    }
    Axis { ticks, ..axis }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(scale: exhibit::Scale, values: &[f64]) -> Axis {
        Axis::of(&exhibit::Axis { title: "t".into(), scale, values: values.to_vec() })
    }

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn an_axis_of_fractions_shows_the_nominal_levels_and_the_lowest_value() {
        let axis = axis(exhibit::Scale::Miss, &[0.62, 0.998, 1.0]);
        for expected in ["95 %", "99 %", "99.8 %"] {
            assert!(labels(&axis).contains(&expected), "{:?}", labels(&axis));
        }
        assert!(axis.low < 0.62 && axis.high > 0.998 && axis.high < 1.0);
    }

    #[test]
    fn a_rate_ends_at_one_and_zero_has_its_strip() {
        let axis = axis(exhibit::Scale::LogWithZero, &[0.0, 1e-9, 0.002, 0.9]);
        assert!(axis.high <= 1.0 && axis.low > 1e-7 && axis.low < 0.002);
        assert_eq!(axis.position(0.0), 0.5 * ZERO_STRIP);
        assert!((axis.position(1e-9) - ZERO_STRIP).abs() < 1e-12, "a small rate is not zero");
    }

    #[test]
    fn a_linear_axis_goes_through_zero_in_round_steps() {
        let axis = axis(exhibit::Scale::Linear, &[-0.05, 0.12]);
        assert_eq!(labels(&axis), ["−0.05", "0", "0.05", "0.10"]);
        let middle = axis.position(0.035);
        assert!((middle - 0.5).abs() < 1e-12 && axis.position(-0.05) > 0.0 && axis.position(0.12) < 1.0);
        assert!(axis.holds(-0.01) && axis.holds(0.0));
    }

    #[test]
    fn levels_are_named_once_and_in_order() {
        assert_eq!(
            labels(&axis(exhibit::Scale::Levels, &[64.0, 4.0, 16.0, 4.0, f64::NAN])),
            ["4", "16", "64"]
        );
    }

    #[test]
    fn every_scale_survives_having_no_values() {
        use exhibit::Scale::{Levels, Linear, Log, LogWithZero, Miss, Seconds};
        for scale in [Linear, Levels, Log, LogWithZero, Miss, Seconds] {
            for values in [vec![], vec![f64::NAN, f64::INFINITY, -1.0], vec![1.0], vec![0.0]] {
                let axis = axis(scale, &values);
                for v in [0.0, 0.5, 1.0, 7.0] {
                    assert!((0.0..=1.0).contains(&axis.position(v)), "{scale:?} {values:?} {v}");
                }
            }
        }
    }
}
