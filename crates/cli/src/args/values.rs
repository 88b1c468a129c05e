//! Values of arguments, and what is refused.

use std::str::FromStr;

/// An exposure in stops.
pub(super) fn stops(text: &str) -> Result<f32, String> {
    let value = text.parse().ok().filter(|v: &f32| (-64.0..=64.0).contains(v));
    value.ok_or_else(|| format!("`{text}` is not a number of stops from -64 to 64"))
}

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f32, String> {
    let value = text.parse().ok().filter(|v: &f32| v.is_finite() && *v > 0.0);
    value.ok_or_else(|| format!("`{text}` is not a finite number above 0"))
}

/// A number strictly between two others, by name.
fn between(text: &str, what: &str, low: f64, high: f64) -> Result<f64, String> {
    let value = text.parse().ok().filter(|v: &f64| *v > low && *v < high);
    value.ok_or_else(|| format!("`{text}` is not {what}, above {low} and below {high}"))
}

/// A ratio of errors to be told from 1.
pub(super) fn ratio(text: &str) -> Result<f64, String> {
    let value = between(text, "a ratio of two errors", 0.0, 1e6)?;
    if value == 1.0 { Err("a ratio of 1 cannot be told from 1".into()) } else { Ok(value) }
}

/// A share of studies.
pub(super) fn power(text: &str) -> Result<f64, String> {
    between(text, "a share of studies", 0.0, 1.0)
}

/// A chance of a false answer.
pub(super) fn probability(text: &str) -> Result<f64, String> {
    between(text, "a probability", 0.0, 1.0)
}

/// A relative change, 0 included.
pub(super) fn margin(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|v: &f64| (0.0..1.0).contains(v));
    value.ok_or_else(|| format!("`{text}` is not a relative change from 0 and below 1"))
}

/// `WxH` in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is not a size such as 640x480, each side from 1 to 16384");
        let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
        let side = |s: &str| s.parse::<usize>().ok().filter(|v| (1..=16384).contains(v));
        match (side(width), side(height)) {
            (Some(width), Some(height)) => Ok(Self { width, height }),
            _ => Err(wrong()),
        }
    }
}

/// `X,Y` in pixels from the upper left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pixel {
    /// Column.
    pub x: usize,
    /// Row.
    pub y: usize,
}

impl FromStr for Pixel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text.split_once(',').map(|(x, y)| (x.trim().parse(), y.trim().parse()));
        match parsed {
            Some((Ok(x), Ok(y))) => Ok(Self { x, y }),
            _ => Err(format!("`{text}` is not a pixel such as 120,80")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_pixels_are_parsed_or_refused() {
        assert_eq!("640x480".parse(), Ok(Size { width: 640, height: 480 }));
        for bad in ["640", "0x5", "640x", "ax3", "99999x2", "-1x2"] {
            assert!(bad.parse::<Size>().unwrap_err().contains(bad));
        }
        assert_eq!("3,4".parse(), Ok(Pixel { x: 3, y: 4 }));
        assert!("3;4".parse::<Pixel>().is_err());
        assert_eq!((stops("-2.5"), positive("0.5")), (Ok(-2.5), Ok(0.5)));
        for bad in ["nan", "65", "inf", "a"] {
            assert!(stops(bad).unwrap_err().contains(bad));
        }
        assert_eq!(
            (ratio("0.95"), margin("0"), probability("0.05"), power("0.8")),
            (Ok(0.95), Ok(0.0), Ok(0.05), Ok(0.8))
        );
        assert!(ratio("1").is_err() && ratio("-2").is_err() && margin("1").unwrap_err().contains('1'));
        assert!(["0", "1", "nan"].iter().all(|bad| probability(bad).is_err() && power(bad).is_err()));
        assert!(["0", "-1", "nan", "inf"].iter().all(|bad| positive(bad).is_err()));
    }
}
