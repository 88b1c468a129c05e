//! Axes: scales, their ranges and their ticks.

use noisefloor_study::format::{significant, superscript};

/// How values map to [0, 1] along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// The value itself.
    Linear,
    /// Logarithm of the value.
    Log,
    /// Logarithm with a strip for zero: the share of the axis at its start that stands for 0.
    LogWithZero(f64),
    /// For a fraction near 1: logarithm of what is missing to 1, so that 95, 99 and 99.8 % stand apart.
    Miss,
}

/// A mark on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    /// Nothing for minor ticks.
    pub label: Option<String>,
}

/// An axis with its range, ticks and title.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    pub scale: Scale,
    pub low: f64,
    pub high: f64,
    pub ticks: Vec<Tick>,
    pub title: String,
}

impl Axis {
    /// Position of a value, 0 at the low end and 1 at the high end, clamped to the axis.
    pub(crate) fn position(&self, value: f64) -> f64 {
        self.place(value).clamp(0.0, 1.0)
    }

    /// Position of a value, below 0 or above 1 where the axis does not reach it.
    pub(crate) fn place(&self, value: f64) -> f64 {
        // Ranges are positive and not empty by construction, see `log_range`.
        let log = |v: f64| (v.max(1e-300) / self.low).ln() / (self.high / self.low).ln();
        match self.scale {
            // Not empty by construction, see `scales`.
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => log(value),
            Scale::LogWithZero(strip) if value <= 0.0 => strip * 0.5,
            // Nothing falls into the strip that stands for zero.
            Scale::LogWithZero(strip) => strip + (1.0 - strip) * log(value).max(0.0),
            Scale::Miss => {
                let (from, to) = (1.0 - self.low, 1.0 - self.high);
                (from / (1.0 - value).max(1e-12)).ln() / (from / to).ln()
            }
        }
    }

    /// Whether a value has a place on the axis at all.
    pub(crate) fn holds(&self, value: f64) -> bool {
        value.is_finite() && (value > 0.0 || !matches!(self.scale, Scale::Log))
    }

    /// An axis over positive values with a margin on both sides.
    pub(crate) fn log(title: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = log_range(values, 0.06);
        Self { scale: Scale::Log, low, high, ticks: log_ticks(low, high, &plain), title: title.into() }
    }

    /// Samples per pixel: ticks at the levels themselves.
    pub(crate) fn spp(title: &str, levels: &[u32]) -> Self {
        let (low, high) = log_range(levels.iter().map(|&n| f64::from(n)), 0.07);
        // Labels need about a tenth of the axis.
        let mut ticks: Vec<Tick> = Vec::new();
        let span = (high / low).ln();
        let mut last = f64::NEG_INFINITY;
        for &n in levels {
            let at = (f64::from(n).max(1e-300) / low).ln() / span;
            let label = (at - last > 0.095).then(|| n.to_string());
            if label.is_some() {
                last = at;
            }
            ticks.push(Tick { value: f64::from(n), label });
        }
        Self { scale: Scale::Log, low, high, ticks, title: title.into() }
    }

    /// Seconds, ticks in µs, ms, s.
    pub(crate) fn seconds(title: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = log_range(values, 0.08);
        Self { scale: Scale::Log, low, high, ticks: log_ticks(low, high, &time), title: title.into() }
    }
}

/// Smallest and largest positive finite value, widened by a share of the range and to at least a factor of 4.
pub(crate) fn log_range(values: impl IntoIterator<Item = f64>, margin: f64) -> (f64, f64) {
    let mut low = f64::INFINITY;
    let mut high = 0.0f64;
    for v in values.into_iter().filter(|v| v.is_finite() && *v > 1e-290) {
        low = low.min(v);
        high = high.max(v);
    }
    if high == 0.0 {
        return (0.1, 10.0);
    }
    let widen = (high / low).powf(margin).max(if high / low < 4.0 { (4.0 * low / high).sqrt() } else { 1.0 });
    (low / widen, high * widen)
}

/// Ticks of a logarithmic axis: 1-2-5 below a decade and a half, powers of ten above.
pub(crate) fn log_ticks(low: f64, high: f64, label: &dyn Fn(f64) -> String) -> Vec<Tick> {
    let decades = (high / low).log10();
    let first = low.log10().floor() as i32;
    let last = high.log10().ceil() as i32;
    let step = ((decades / 6.0).ceil() as i32).max(1);
    let mut ticks = Vec::new();
    for exponent in first..=last {
        let ten = 10f64.powi(exponent);
        for digit in 1..=9 {
            let value = f64::from(digit) * ten;
            if value < low * 0.999_999 || value > high * 1.000_001 {
                continue;
            }
            let named = match digit {
                1 => exponent.rem_euclid(step) == 0,
                2 | 5 => decades <= 1.5,
                _ => false,
            };
            if named || step == 1 {
                ticks.push(Tick { value, label: named.then(|| label(value)) });
            }
        }
    }
    ticks
}

/// `0.001`, `20`, `10⁻⁶`.
pub(crate) fn plain(value: f64) -> String {
    let exponent = value.log10().floor() as i32;
    if (-4..5).contains(&exponent) {
        return significant(value, 1);
    }
    let digit = (value / 10f64.powi(exponent)).round() as i32;
    match digit {
        1 => format!("10{}", superscript(exponent)),
        10 => format!("10{}", superscript(exponent + 1)),
        d => format!("{d}×10{}", superscript(exponent)),
    }
}

/// `20 µs`, `5 ms`, `1 s`.
fn time(seconds: f64) -> String {
    // Ticks are 1, 2 or 5 times a power of ten; 1e-9 forgives rounding.
    match seconds * (1.0 + 1e-9) {
        s if s < 1e-3 => format!("{} µs", significant(s * 1e6, 1)),
        s if s < 1.0 => format!("{} ms", significant(s * 1e3, 1)),
        s => format!("{} s", significant(s, 1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn a_short_range_has_one_two_five_and_a_long_one_powers_of_ten() {
        assert_eq!(labels(&log_ticks(0.008, 0.11, &plain)), ["0.01", "0.02", "0.05", "0.1"]);
        assert_eq!(labels(&log_ticks(3e-5, 0.2, &plain)), ["0.0001", "0.001", "0.01", "0.1"]);
        assert_eq!(labels(&log_ticks(1e-9, 1e3, &plain)), ["10⁻⁸", "10⁻⁶", "0.0001", "0.01", "1", "100"]);
    }

    #[test]
    fn times_carry_units() {
        assert_eq!(labels(&log_ticks(4e-4, 6e-3, &time)), ["500 µs", "1 ms", "2 ms", "5 ms"]);
        assert_eq!(labels(&log_ticks(0.4, 6.0, &time)), ["500 ms", "1 s", "2 s", "5 s"]);
    }

    #[test]
    fn spp_ticks_are_the_levels_and_thin_out_when_crowded() {
        assert_eq!(labels(&Axis::spp("spp", &[4, 16, 64, 256]).ticks), ["4", "16", "64", "256"]);
        let crowded: Vec<u32> = (0..20).map(|k| 4 + k).collect();
        let axis = Axis::spp("spp", &crowded);
        assert_eq!(axis.ticks.len(), 20);
        assert!(labels(&axis.ticks).len() < 12);
    }

    #[test]
    fn ranges_are_never_empty() {
        for values in [vec![], vec![0.5], vec![0.0, -1.0, f64::NAN], vec![1e-12, 1e12]] {
            let (low, high) = log_range(values, 0.05);
            assert!(low > 0.0 && high / low >= 3.999, "{low} {high}");
        }
    }

    #[test]
    fn coverage_levels_stand_apart_and_zero_has_its_strip() {
        let axis = Axis { scale: Scale::Miss, low: 0.5, high: 0.9995, ticks: vec![], title: String::new() };
        let at = [0.5, 0.95, 0.99, 0.998, 0.9995].map(|c| axis.position(c));
        assert_eq!((at[0], at[4]), (0.0, 1.0));
        assert!(at.windows(2).all(|w| w[1] - w[0] > 0.15), "{at:?}");
        let axis = Axis { scale: Scale::LogWithZero(0.1), low: 1e-4, high: 1.0, ..axis };
        assert_eq!(axis.position(0.0), 0.05);
        assert!((axis.position(1e-4) - 0.1).abs() < 1e-12 && axis.position(1.0) == 1.0);
    }
}
