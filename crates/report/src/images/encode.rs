//! Linear pixel values to compact text that the page's viewer decodes.
//!
//! Two formats, both deflated (zlib) and written in base64:
//!
//! * `rgb9e5`, for three channels without negative or non-finite values: a shared exponent of 5 bits and mantissas of 9
//!   bits, relative to a power of two that puts the image's largest value at the top of the range. Five byte planes:
//!   exponents, upper 8 bits of each mantissa, and the three lowest bits together.
//! * `f16`, for anything else: IEEE half floats relative to a power of two, per channel a plane of upper and a plane of
//!   lower bytes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use noisefloor_frame::Image;
use serde::Serialize;

/// Steps of the 9-bit mantissa.
const MANTISSA: f64 = 512.0;
/// Exponents span 0..=31.
const TOP_EXPONENT: i32 = 31;
/// Deflate effort, 0 to 10.
const EFFORT: u8 = 9;

/// An image as the page carries it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Encoded {
    pub width: usize,
    pub height: usize,
    pub channels: usize,
    pub format: &'static str,
    /// Decoded values are multiplied by this power of two.
    pub scale: f64,
    /// Base64 of the deflated planes; written beside the description, not into it.
    #[serde(skip)]
    pub text: String,
}

/// Encodes an image of 1 to 4 channels (further channels are dropped: a screen has no place for them).
pub(crate) fn encode(image: &Image) -> Encoded {
    let channels = if image.channels() >= 3 { 3 } else { 1 };
    let values = &image.data()[..channels * image.pixels()];
    let plain = channels == 3 && values.iter().all(|v| v.is_finite() && *v >= 0.0);
    let (format, scale, planes) = if plain {
        let (scale, planes) = rgb9e5(values, image.pixels());
        ("rgb9e5", scale, planes)
    } else {
        let (scale, planes) = half(values, image.pixels());
        ("f16", scale, planes)
    };
    let text = STANDARD.encode(miniz_oxide::deflate::compress_to_vec_zlib(&planes, EFFORT));
    Encoded { width: image.width(), height: image.height(), channels, format, scale, text }
}

/// Smallest power of two above `v`, within what f32 values can need; 1 for zero.
fn power_above(v: f32) -> i32 {
    if v > 0.0 { (f64::from(v).log2().floor() as i32 + 1).clamp(-140, 128) } else { 0 }
}

fn largest(values: &[f32]) -> f32 {
    values.iter().filter(|v| v.is_finite()).fold(0.0, |m, v| m.max(v.abs()))
}

fn rgb9e5(values: &[f32], pixels: usize) -> (f64, Vec<u8>) {
    let top = power_above(largest(values));
    let mut planes = vec![0u8; 5 * pixels];
    for p in 0..pixels {
        let rgb = [0, 1, 2].map(|c| values[c * pixels + p]);
        let brightest = rgb[0].max(rgb[1]).max(rgb[2]);
        // Exponent 31 holds values up to 2^top; every step below halves the range.
        let mut exponent = (power_above(brightest) - top + TOP_EXPONENT).clamp(0, TOP_EXPONENT);
        if brightest == 0.0 {
            exponent = 0;
        }
        let mut step = step(exponent, top);
        if (f64::from(brightest) / step).round() >= MANTISSA && exponent < TOP_EXPONENT {
            exponent += 1;
            step *= 2.0;
        }
        let mantissa = rgb.map(|v| (f64::from(v) / step).round().min(MANTISSA - 1.0) as u16);
        planes[p] = exponent as u8;
        for c in 0..3 {
            planes[(1 + c) * pixels + p] = (mantissa[c] >> 1) as u8;
            planes[4 * pixels + p] |= ((mantissa[c] & 1) as u8) << c;
        }
    }
    // The reader multiplies mantissa · 2^(exponent − 31) by the scale.
    (2f64.powi(top) / MANTISSA, planes)
}

/// Value of one mantissa step at this exponent.
fn step(exponent: i32, top: i32) -> f64 {
    2f64.powi(top + exponent - TOP_EXPONENT) / MANTISSA
}

fn half(values: &[f32], pixels: usize) -> (f64, Vec<u8>) {
    let top = power_above(largest(values));
    // Largest magnitude lands in (16384, 32768], clear of the half format's limit of 65504.
    let scale = 2f64.powi(top - 15);
    let channels = values.len() / pixels;
    let mut planes = vec![0u8; 2 * values.len()];
    for c in 0..channels {
        for p in 0..pixels {
            let bits = to_half(f64::from(values[c * pixels + p]) / scale);
            planes[2 * c * pixels + p] = (bits >> 8) as u8;
            planes[(2 * c + 1) * pixels + p] = bits as u8;
        }
    }
    (scale, planes)
}

/// Nearest half float of a value below 65504, ties to even; non-finite values keep their kind.
fn to_half(v: f64) -> u16 {
    let sign = if v.is_sign_negative() { 0x8000 } else { 0 };
    let v = v.abs();
    if v.is_nan() {
        return 0x7e00;
    }
    if v.is_infinite() {
        return sign | 0x7c00;
    }
    let exponent = if v > 0.0 { (v.log2().floor() as i32).max(-14) } else { -14 };
    // A subnormal or normal half is an integer multiple of 2^(exponent − 10); carries run into the exponent bits.
    let steps = (v / 2f64.powi(exponent - 10)).round_ties_even() as u16;
    sign | (((exponent + 14) as u16) << 10).wrapping_add(steps)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// What the page's decoder does.
    pub(crate) fn decode(e: &Encoded) -> Vec<f32> {
        let packed = STANDARD.decode(&e.text).unwrap();
        let planes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap();
        let n = e.width * e.height;
        let at = |plane: usize, p: usize| u32::from(planes[plane * n + p]);
        let value = |c: usize, p: usize| match e.format {
            "rgb9e5" => {
                let mantissa = at(1 + c, p) << 1 | at(4, p) >> c & 1;
                f64::from(mantissa) * 2f64.powi(at(0, p) as i32 - 31)
            }
            _ => {
                let bits = at(2 * c, p) << 8 | at(2 * c + 1, p);
                let (sign, exponent, fraction) = (bits >> 15, bits >> 10 & 31, f64::from(bits & 1023));
                let magnitude = match exponent {
                    0 => fraction * 2f64.powi(-24),
                    31 if fraction > 0.0 => f64::NAN,
                    31 => f64::INFINITY,
                    e => (1024.0 + fraction) * 2f64.powi(e as i32 - 25),
                };
                if sign == 1 { -magnitude } else { magnitude }
            }
        };
        (0..e.channels)
            .flat_map(|c| (0..n).map(move |p| (c, p)))
            .map(|(c, p)| (value(c, p) * e.scale) as f32)
            .collect()
    }

    #[test]
    fn radiance_survives_within_a_step_of_the_brightest_channel() {
        let image = Image::from_fn(16, 8, 3, |c, x, y| {
            (1.0 + c as f32) * 10f32.powi(x as i32 / 2 - 4) * (1.0 + y as f32 / 9.0)
        });
        let encoded = encode(&image);
        assert_eq!(encoded.format, "rgb9e5");
        let decoded = decode(&encoded);
        let n = image.pixels();
        for p in 0..n {
            let brightest = (0..3).map(|c| image.data()[c * n + p]).fold(0.0, f32::max);
            for c in 0..3 {
                let (a, b) = (image.data()[c * n + p], decoded[c * n + p]);
                // 9 bits: half a step of at most brightest/256.
                assert!((a - b).abs() <= brightest / 511.0, "{a} became {b} beside {brightest}");
            }
        }
    }

    #[test]
    fn negative_and_non_finite_values_take_half_floats() {
        let values =
            vec![-3.5, 0.0, 1e-3, f32::NAN, f32::INFINITY, 123.456, -1e6, 7e5, 0.1, 0.2, -0.3, 1e-12];
        let image = Image::from_vec(4, 1, 3, values.clone()).unwrap();
        let encoded = encode(&image);
        assert_eq!(encoded.format, "f16");
        for (a, b) in values.iter().zip(decode(&encoded)) {
            let close = (a - b).abs() <= a.abs() / 2048.0 + 1e6 * 2f32.powi(-39);
            assert!(close || (a.is_nan() && b.is_nan()) || *a == b, "{a} became {b}");
        }
    }

    #[test]
    fn extremes_and_black_have_a_place() {
        for v in [0.0, f32::MIN_POSITIVE, 1e-30, 65504.0, 1e30, f32::MAX] {
            let decoded = decode(&encode(&Image::filled(2, 2, 3, v)));
            assert!((decoded[0] - v).abs() <= v / 500.0, "{v} became {}", decoded[0]);
        }
        let counts = Image::from_fn(4, 4, 1, |_, x, y| (x * y * 37) as f32);
        let encoded = encode(&counts);
        assert_eq!((encoded.channels, encoded.format), (1, "f16"));
        assert_eq!(decode(&encoded), counts.data(), "integers up to 2048 are exact");
    }
}
