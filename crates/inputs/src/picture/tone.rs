//! Exposure, a constant factor, and the sRGB curve.

use std::fmt;

use noisefloor_frame::Image;

use super::fit::{correlation, position};
use crate::against::Against;
use crate::median::median;
use crate::number::number;

/// A change of tone that makes frame and reference fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tone {
    /// Whose sRGB curve is to be undone.
    curve: Curve,
    /// Factor on the reference after that.
    gain: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Curve {
    None,
    /// The frame is encoded.
    Frame,
    /// The reference is encoded.
    Reference,
}

/// How well a change must fit.
pub(super) struct Demand {
    /// Most that may be left of the relative distance.
    left: f64,
    /// Most relative distance that may be left.
    most: f64,
    /// Least correlation of the block means: a flat image fits any flat picture.
    alike: f64,
}

/// For frames with noise, whose brightness differs significantly.
pub(super) const NOISY: Demand = Demand { left: 0.5, most: 0.5, alike: 0.3 };

/// For images of which nothing is known.
pub(super) const CLEAN: Demand = Demand { left: 0.3, most: 0.1, alike: 0.9 };

/// Middle relative distance below which pictures are the same.
const LEAST_DISTANCE: f64 = 0.05;

/// Position from which on a frame lies nearer to the changed reference, and its least size in standard errors.
const LEAN: f64 = 0.1;
const LEAST_ERRORS: f64 = 6.0;

/// Factors nearer to one are no other picture.
const LEAST_GAIN: f64 = 1.25;

/// How much better a change with a factor must fit than one without.
const FOR_A_FACTOR: f64 = 0.6;

impl fmt::Display for Tone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let stops = self.gain.log2();
        let whole = stops.round();
        let gain = match (self.gain - 1.0).abs() < 1e-12 {
            true => None,
            false if (stops - whole).abs() <= 0.05 && whole != 0.0 => Some(format!(
                "exposure {}{} {} of the reference",
                if whole > 0.0 { "+" } else { "−" },
                whole.abs(),
                if whole.abs() == 1.0 { "stop" } else { "stops" }
            )),
            false => Some(format!("a factor of {} on the reference", number(self.gain))),
        };
        let curve = match self.curve {
            Curve::None => None,
            Curve::Frame => Some("undoing the sRGB curve of the frame"),
            Curve::Reference => Some("undoing the sRGB curve of the reference"),
        };
        match (curve, gain) {
            (Some(curve), Some(gain)) => write!(f, "{curve} and {gain}"),
            (Some(curve), None) => f.write_str(curve),
            (None, gain) => f.write_str(&gain.unwrap_or_default()),
        }
    }
}

/// Linear radiance of an sRGB-encoded value.
fn linear(v: f64) -> f64 {
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// The inverse of [`linear`].
fn encoded(v: f64) -> f64 {
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

/// Whether the frame significantly lies nearer to the reference with the curve applied or undone than to the reference,
/// by the same statistic as for moves: a curve may leave the mean as it is.
pub(super) fn leans(against: &Against<'_>, x: &Image, invalid: &[bool]) -> bool {
    let r = against.reference.mean();
    [encoded, linear].into_iter().any(|curve| {
        let mut rows = vec![[0.0f64; 2]; r.height()];
        for pixel in (0..r.pixels()).filter(|&p| against.usable(p, invalid)) {
            let at = |image: &Image, c: usize| f64::from(image.plane(c)[pixel]);
            let mean = |value: &dyn Fn(usize) -> f64| (value(0) + value(1) + value(2)) / 3.0;
            let (a, b) = (mean(&|c| at(x, c)), mean(&|c| at(r, c)));
            let t = mean(&|c| curve(at(r, c)));
            if a.is_finite() && t.is_finite() {
                let w = against.weights[against.blocks.of(pixel)].powi(2);
                let row = &mut rows[pixel / r.width()];
                *row = [row[0] + w * (t - b) * (2.0 * a - b - t), row[1] + w * (t - b) * (t - b)];
            }
        }
        position(&rows).is_some_and(|(l, error)| l >= LEAN && l >= LEAST_ERRORS * error)
    })
}

/// Means of blocks of both pictures.
fn means(against: &Against<'_>, x: &Image, invalid: &[bool], curve: Curve) -> Vec<(f64, f64)> {
    let r = against.reference.mean();
    let mut sums = vec![(0.0, 0.0, 0.0); against.blocks.count()];
    for pixel in (0..x.pixels()).filter(|&p| against.usable(p, invalid)) {
        let of = |image: &Image, decode: bool| -> f64 {
            let one = |c: usize| {
                let v = f64::from(image.plane(c)[pixel]);
                if decode { linear(v) } else { v }
            };
            (one(0) + one(1) + one(2)) / 3.0
        };
        let (a, b) = (of(x, curve == Curve::Frame), of(r, curve == Curve::Reference));
        if a.is_finite() && b.is_finite() {
            let s = &mut sums[against.blocks.of(pixel)];
            *s = (s.0 + a, s.1 + b, s.2 + 1.0);
        }
    }
    sums.into_iter().filter(|s| s.2 > 0.0).map(|(a, b, n)| (a / n, b / n)).collect()
}

/// The middle relative distance of block means with this factor on the reference.
fn distance(means: &[(f64, f64)], gain: f64) -> Option<f64> {
    let mut all: Vec<f64> = means
        .iter()
        .filter(|(a, b)| a + gain * b > 0.0)
        .map(|(a, b)| (a - gain * b).abs() / (a + gain * b))
        .collect();
    median(&mut all)
}

/// The factor by which the reference fits: ratio of means, each block in units of its own brightness.
fn factor(means: &[(f64, f64)]) -> Option<f64> {
    let floor = 0.1 * means.iter().map(|m| m.1).sum::<f64>() / means.len().max(1) as f64;
    let (a, b) = means.iter().fold((0.0, 0.0), |(a, b), m| {
        let w = 1.0 / m.1.hypot(floor).max(f64::MIN_POSITIVE);
        (a + w * m.0, b + w * m.1)
    });
    (a > 0.0 && b > 0.0).then(|| a / b)
}

pub(super) fn find(
    against: &Against<'_>,
    x: &Image,
    invalid: &[bool],
    ratio: f64,
    demand: &Demand,
) -> Option<Tone> {
    if !ratio.is_finite() || ratio <= 0.0 {
        return None;
    }
    let plain = means(against, x, invalid, Curve::None);
    if plain.len() < 16 {
        return None;
    }
    let before = distance(&plain, 1.0).filter(|before| *before >= LEAST_DISTANCE)?;
    let mut best: Option<(Tone, f64)> = None;
    let mut consider = |tone: Tone, left: f64, handicap: f64| {
        if best.is_none_or(|(_, other)| left < handicap * other) {
            best = Some((tone, left));
        }
    };
    for curve in [Curve::Frame, Curve::Reference] {
        let decoded = means(against, x, invalid, curve);
        if let Some(left) = distance(&decoded, 1.0) {
            consider(Tone { curve, gain: 1.0 }, left, 1.0);
        }
    }
    if let Some(gain) = factor(&plain)
        && !(1.0 / LEAST_GAIN..=LEAST_GAIN).contains(&gain)
        && let Some(left) = distance(&plain, gain)
    {
        consider(Tone { curve: Curve::None, gain }, left, 1.0);
    }
    for curve in [Curve::Frame, Curve::Reference] {
        let decoded = means(against, x, invalid, curve);
        if let Some(gain) = factor(&decoded)
            && !(1.0 / LEAST_GAIN..=LEAST_GAIN).contains(&gain)
            && let Some(left) = distance(&decoded, gain)
        {
            consider(Tone { curve, gain }, left, FOR_A_FACTOR);
        }
    }
    let (tone, left) = best?;
    let changed = match tone.curve {
        Curve::None => factor(&plain),
        curve => factor(&means(against, x, invalid, curve)),
    };
    // Blocks without rare light are darker than the picture; the mean knows of it.
    let even = match (factor(&plain), changed) {
        (Some(before), Some(after)) => (after / tone.gain).ln().abs() <= (0.5 * before.ln().abs()).max(0.1),
        _ => false,
    };
    let fits = even && left <= demand.left * before && left <= demand.most;
    // A curve changes little about the order of bright and dark.
    (fits && correlation(&plain) >= demand.alike).then_some(tone)
}
