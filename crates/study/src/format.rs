//! Numbers for people: sensible digits, units, uncertainty that sets the digits of the value.

use crate::summary::{Interval, Source};

/// `v` with `digits` significant digits; powers of ten below 1e-4 and from 1e6.
pub fn significant(v: f64, digits: usize) -> String {
    if v.is_nan() {
        return "not a number".into();
    }
    if v.is_infinite() {
        return if v > 0.0 { "∞".into() } else { "−∞".into() };
    }
    if v == 0.0 {
        return "0".into();
    }
    let exponent = exponent_of(v, digits);
    if (-4..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0);
        minus(&format!("{v:.*}", decimals as usize))
    } else {
        let mantissa = v / 10f64.powi(exponent);
        format!("{}×10{}", minus(&format!("{mantissa:.*}", digits - 1)), superscript(exponent))
    }
}

/// Decimal exponent of `v` ≠ 0 after rounding to `digits` significant digits.
fn exponent_of(v: f64, digits: usize) -> i32 {
    let text = format!("{v:.*e}", digits.max(1) - 1);
    text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// An integer as superscript characters, with a true minus sign.
pub fn superscript(n: i32) -> String {
    n.to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '0' => '⁰',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            c => char::from_u32(0x2070 + c as u32 - '0' as u32).unwrap_or(c),
        })
        .collect()
}

fn minus(text: &str) -> String {
    text.replace('-', "−")
}

/// A value and its uncertainty as two texts, the digits set by the uncertainty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// `0.0123`, or `< 0.0004` when the estimate is under its floor.
    pub value: String,
    /// `± 0.0004` or `[0.011, 0.014]`; empty if unknown.
    pub spread: String,
}

impl Shown {
    /// Both in one line.
    pub fn line(&self) -> String {
        if self.spread.is_empty() { self.value.clone() } else { format!("{} {}", self.value, self.spread) }
    }
}

/// Value ± half-width for symmetric intervals, value [low, high] for others.
pub fn interval(i: &Interval) -> Shown {
    if let Some(limit) = i.below {
        return Shown { value: format!("< {}", significant(limit, 2)), spread: String::new() };
    }
    let (Some(low), Some(high), true) = (i.low, i.high, i.source != Source::None) else {
        return Shown { value: significant(i.value, 3), spread: String::new() };
    };
    let half = 0.5 * (high - low);
    let symmetric = ((high - i.value) - (i.value - low)).abs() <= 0.02 * half.abs();
    let shows = half > 0.0 && i.value.is_finite();
    if !shows {
        return Shown { value: significant(i.value, 3), spread: String::new() };
    }
    if !symmetric {
        return Shown { value: significant(i.value, 3), spread: bracket(i, |v| significant(v, 3)) };
    }
    plus_minus(i.value, half)
}

/// `[low, high]` with the caller's format; empty if an end is missing.
pub fn bracket(i: &Interval, show: impl Fn(f64) -> String) -> String {
    match (i.low, i.high) {
        (Some(low), Some(high)) => format!("[{}, {}]", show(low), show(high)),
        _ => String::new(),
    }
}

fn plus_minus(value: f64, half: f64) -> Shown {
    // Two digits of the half-width decide the last decimal of both.
    let last = exponent_of(half, 2) - 1;
    let lead = if value == 0.0 { last } else { exponent_of(value, 3) };
    if (-4..6).contains(&lead) && last > -8 {
        let decimals = (-last).max(0) as usize;
        return Shown {
            value: minus(&format!("{value:.decimals$}")),
            spread: format!("± {half:.decimals$}"),
        };
    }
    let scale = 10f64.powi(lead);
    let decimals = (lead - last).max(0) as usize;
    Shown {
        value: minus(&format!("{:.decimals$}", value / scale)),
        spread: format!("± {:.decimals$} ×10{}", half / scale, superscript(lead)),
    }
}

/// A ratio: `0.192`, `5.2`, `12`.
pub fn ratio(v: f64) -> String {
    if !v.is_finite() || v < 0.0 {
        return significant(v, 3);
    }
    match v {
        v if v < 0.9995 => significant(v, 2.max(if v >= 0.1 { 3 } else { 2 })),
        v if v < 9.95 => format!("{v:.2}"),
        v if v < 99.5 => format!("{v:.1}"),
        v => significant(v, 3),
    }
}

/// A fraction in percent, with more digits near 0 and 100.
pub fn percent(fraction: f64) -> String {
    let p = 100.0 * fraction;
    let near_end = p.min(100.0 - p).abs();
    let decimals = match near_end {
        e if e >= 10.0 => 1,
        e if e >= 0.1 || e == 0.0 => 2,
        e if e >= 0.01 => 3,
        _ => 4,
    };
    let text = format!("{p:.decimals$}");
    if p == 0.0 || p == 100.0 { format!("{p:.0} %") } else { format!("{} %", minus(&text)) }
}

/// `95 %` rather than `95.00 %`.
pub fn percent_short(fraction: f64) -> String {
    let rounded = (fraction * 1e6).round() / 1e4;
    format!("{rounded} %")
}

/// A fraction with its interval, in percent.
pub fn percent_interval(i: &Interval) -> Shown {
    let spread = match (i.low, i.high) {
        (Some(low), Some(high)) if i.source != Source::None => {
            let end = |v: f64| percent(v.clamp(0.0, 1.0)).trim_end_matches(" %").to_owned();
            format!("[{}, {}]", end(low), end(high))
        }
        _ => String::new(),
    };
    Shown { value: percent(i.value), spread }
}

/// Seconds with a unit that keeps three digits readable.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() || s < 0.0 => significant(s, 3),
        0.0 => "0 s".into(),
        s if s < 0.999_5e-3 => format!("{} µs", significant(s * 1e6, 3)),
        s if s < 0.9995 => format!("{} ms", significant(s * 1e3, 3)),
        s if s < 119.5 => format!("{} s", significant(s, 3)),
        s if s < 7200.0 => format!("{} min", significant(s / 60.0, 3)),
        s => format!("{} h", significant(s / 3600.0, 3)),
    }
}

/// Bytes in MiB or KiB.
pub fn bytes(n: u64) -> String {
    match n as f64 {
        b if b >= 1048576.0 => format!("{} MiB", significant(b / 1048576.0, 3)),
        b if b >= 1024.0 => format!("{} KiB", significant(b / 1024.0, 3)),
        b => format!("{b} B"),
    }
}

/// `a`, `a and b`, `a, b and c`.
pub fn list<S: AsRef<str>>(items: &[S]) -> String {
    match items {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [head @ .., last] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", head.join(", "), last.as_ref())
        }
    }
}

/// `1 scene`, `3 scenes`.
pub fn plural(n: usize, word: &str) -> String {
    if n == 1 { format!("1 {word}") } else { format!("{n} {word}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: f64, half: f64) -> Interval {
        Interval {
            value,
            standard_error: Some(half / 2.0),
            low: Some(value - half),
            high: Some(value + half),
            confidence: 0.95,
            n: 4,
            source: Source::Replicates,
            below: None,
        }
    }

    #[test]
    fn digits_follow_the_uncertainty() {
        assert_eq!(interval(&of(0.012_345, 0.000_41)).line(), "0.01235 ± 0.00041");
        assert_eq!(interval(&of(123.4, 11.0)).line(), "123 ± 11");
        assert_eq!(interval(&of(1.234e-6, 4.1e-8)).line(), "1.234 ± 0.041 ×10⁻⁶");
        assert_eq!(interval(&of(0.5, 0.0)).line(), "0.500");
    }

    #[test]
    fn an_estimate_below_the_floor_prints_its_limit() {
        let below = Interval { below: Some(0.000_31), ..of(-0.0001, 0.0002) };
        assert_eq!(interval(&below).line(), "< 0.00031");
    }

    #[test]
    fn lopsided_intervals_print_both_ends() {
        let lopsided = Interval { low: Some(0.1), high: Some(0.4), ..of(0.2, 0.0) };
        assert_eq!(interval(&lopsided).line(), "0.200 [0.100, 0.400]");
    }

    #[test]
    fn powers_of_ten_and_rounding_up_keep_their_digits() {
        assert_eq!(significant(9.999, 3), "10.0");
        assert_eq!(significant(-0.000_012_3, 2), "−1.2×10⁻⁵");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(significant(4096.0, 3), "4096");
        assert_eq!(significant(f64::INFINITY, 3), "∞");
    }

    #[test]
    fn durations_percentages_and_ratios_have_fitting_units() {
        assert_eq!(duration(0.0123), "12.3 ms");
        assert_eq!(duration(0.000_045), "45.0 µs");
        assert_eq!(duration(300.0), "5.00 min");
        assert_eq!(percent(0.9987), "99.87 %");
        assert_eq!(percent(0.5), "50.0 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(ratio(0.1923), "0.192");
        assert_eq!(ratio(5.234), "5.23");
        assert_eq!(ratio(123.4), "123");
    }

    #[test]
    fn lists_read_like_prose() {
        assert_eq!(list::<&str>(&[]), "");
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
        assert_eq!(plural(1, "scene"), "1 scene");
    }
}
