//! Do the halves make up the mean?

use crate::{Estimate, FrameError, Image, Samples};

use super::fidelity::Fidelity;
use super::precision::Precision;

/// What is known about how samples were weighted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Film {
    /// All samples of a pixel count alike.
    Unweighted,
    /// Nothing is known; a filter may weight them.
    Unknown,
    /// A feature: samples that hit nothing may not count, or count with another weight.
    OfFeature,
    /// A quotient of two sums over samples, such as rays that reached a light over rays traced: whatever there is of them in
    /// either half, the quotient of both together lies between those of the halves.
    Quotient,
}

/// How halves relate to their mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Halves {
    /// (n_A·A + n_B·B)/n is the mean, or there are no halves.
    Exact,
    /// The mean is an average of them with other weights, or it was not compared.
    Weighted,
}

/// Share of the disagreeing values whose mean must lie between their halves, for a weighted film.
const BETWEEN: f64 = 0.99;
/// How far the median share of half A may be from n_A/n in a weighted film.
const SHARE: f64 = 0.1;
/// Standard errors by which the signed disagreements of a weighted film may differ from balance; the channels of a pixel
/// share their weights, hence more than the five of independent values.
const BALANCE: f64 = 9.0;
/// Share of the values of a feature that must disagree before it counts as a contradiction.
const FEATURE: f64 = 0.5;
/// Disagreement relative to the values, and share of values that have it, that no lossy compression explains.
const GROSS: (f64, f64) = (0.2, 0.5);

/// Compares all values of an estimate.
pub(super) fn check(
    layer: &str,
    estimate: &Estimate,
    samples: &Samples,
    film: Film,
    fidelity: Fidelity,
) -> Result<Halves, FrameError> {
    let Some([a, b]) = &estimate.halves else { return Ok(Halves::Exact) };
    if film == Film::OfFeature && normalised(&estimate.mean) {
        return Ok(Halves::Weighted);
    }
    let precision = [&estimate.mean, a, b].map(|image| Precision::of(image.data()));
    let precision = precision[0].coarser(precision[1]).coarser(precision[2]);
    // Programs that accumulate floats lose up to a bit per doubling; halves and mean are sums of their own.
    let accumulated = 0.5f64.powi(24) * (0.25 * samples.total().mean()).clamp(16.0, 16384.0);
    let relative = 2.0 * precision.relative() + accumulated;
    let absolute = 4.0 * precision.absolute() + 1e-37;
    let mut tally = Tally::default();
    for (c, ((mean, a), b)) in estimate.mean.planes().zip(a.planes()).zip(b.planes()).enumerate() {
        for pixel in 0..mean.len() {
            let value = Value::new(samples, pixel, mean[pixel], a[pixel], b[pixel]);
            let Some(value) = value.filter(|v| !saturated(precision, v)) else { continue };
            let tolerance = value.scale * relative + absolute;
            tally.add(&value, tolerance, (c, pixel));
        }
    }
    let contradiction = |tally: &Tally| tally.error(layer, estimate);
    if tally.disagreeing.is_empty() {
        return Ok(Halves::Exact);
    }
    let share = tally.disagreeing.len() as f64 / tally.lit.max(1) as f64; // at least 1
    let sound = match (fidelity, film) {
        (Fidelity::Lossy, _) => {
            let gross = tally.disagreeing.iter().filter(|v| v.residual.abs() > GROSS.0 * v.scale).count();
            gross as f64 <= GROSS.1 * tally.lit as f64
        }
        (Fidelity::Rounded, Film::Unweighted) => false,
        (Fidelity::Rounded, Film::Unknown) => tally.weighted_film(),
        (Fidelity::Rounded, Film::Quotient) => tally.lie_between(),
        (Fidelity::Rounded, Film::OfFeature) => share <= FEATURE || tally.weighted_film() || tally.gaps(),
    };
    if sound { Ok(Halves::Weighted) } else { Err(contradiction(&tally)) }
}

/// The same for parts of equal sample counts, which average to the mean without weights.
pub(super) fn check_parts(mean: &Image, parts: &[Image]) -> Result<(), FrameError> {
    let precision =
        parts.iter().map(|p| Precision::of(p.data())).fold(Precision::of(mean.data()), Precision::coarser);
    let relative = 2.0 * precision.relative() + 0.5f64.powi(20);
    let absolute = 4.0 * precision.absolute() + 1e-37;
    let (mut tally, pixels) = (Tally::default(), mean.pixels());
    for i in 0..mean.data().len() {
        let of_parts = parts.iter().map(|part| f64::from(part.data()[i]));
        let (mut sum, mut size) = (0.0, 0.0);
        for value in of_parts {
            sum += value;
            size += value.abs();
        }
        let mean = f64::from(mean.data()[i]);
        let average = sum / parts.len() as f64; // called with parts
        let scale = size / parts.len() as f64 + mean.abs();
        if average.is_finite() && mean.is_finite() {
            let value = Value {
                mean,
                average,
                residual: mean - average,
                scale,
                halves: [average; 2],
                share: 0.5,
                one: 1.0,
            };
            tally.add(&value, scale * relative + absolute, (i / pixels, i % pixels));
        }
    }
    match tally.disagreeing.is_empty() {
        true => Ok(()),
        false => Err(tally.describe("color", "parts", mean.width())),
    }
}

/// Whether all vectors of an image are of length 1 or 0: averages of unit vectors are shorter, so these were normalised.
fn normalised(image: &Image) -> bool {
    image.channels() == 3
        && (0..image.pixels()).all(|p| {
            let square: f32 = image.planes().map(|plane| plane[p] * plane[p]).sum();
            !square.is_finite() || square == 0.0 || (square - 1.0).abs() < 4e-3
        })
}

/// The largest half float stands for everything beyond.
fn saturated(precision: Precision, value: &Value) -> bool {
    precision.is_half() && value.halves.iter().chain([&value.mean]).any(|v| v.abs() >= 65504.0)
}

/// A value with its halves, all finite.
#[derive(Debug, Clone, Copy)]
struct Value {
    mean: f64,
    average: f64,
    /// Mean less average.
    residual: f64,
    /// Sum of the magnitudes that rounding errors are relative to.
    scale: f64,
    halves: [f64; 2],
    /// n_A/n.
    share: f64,
    /// What one sample has of the pixel, 1/n.
    one: f64,
}

impl Value {
    fn new(samples: &Samples, pixel: usize, mean: f32, a: f32, b: f32) -> Option<Self> {
        let (in_a, in_b) = samples.halves_at(pixel);
        let n = f64::from(in_a) + f64::from(in_b);
        let share = f64::from(in_a) / n;
        // An empty half says nothing, whatever it holds.
        let of = |share: f64, v: f32| if share > 0.0 { share * f64::from(v) } else { 0.0 };
        let (of_a, of_b, mean) = (of(share, a), of(1.0 - share, b), f64::from(mean));
        let average = of_a + of_b;
        let scale = of_a.abs() + of_b.abs() + mean.abs();
        let halves = [f64::from(a), f64::from(b)];
        let value = Self { mean, average, residual: mean - average, scale, halves, share, one: 1.0 / n };
        (n > 0.0 && value.residual.is_finite()).then_some(value)
    }
}

#[derive(Debug, Default)]
struct Tally {
    compared: usize,
    /// Values that are not zero all through.
    lit: usize,
    disagreeing: Vec<Value>,
    /// Disagreement over tolerance, channel and pixel of the worst value, and the value.
    worst: Option<(f64, (usize, usize), Value)>,
    /// Whether the mean of a disagreeing value lies between its halves.
    between: usize,
}

impl Tally {
    fn add(&mut self, value: &Value, tolerance: f64, at: (usize, usize)) {
        self.compared += 1;
        self.lit += usize::from(value.scale > 0.0);
        let excess = value.residual.abs() / tolerance; // the tolerance is positive
        if excess <= 1.0 {
            return;
        }
        let [a, b] = value.halves;
        let inside = a.min(b) - tolerance <= value.mean && value.mean <= a.max(b) + tolerance;
        self.between += usize::from(inside);
        self.disagreeing.push(*value);
        if self.worst.is_none_or(|(worst, ..)| excess > worst) {
            self.worst = Some((excess, at, *value));
        }
    }

    /// Whether the means lie between their halves.
    fn lie_between(&self) -> bool {
        self.between as f64 >= BETWEEN * self.disagreeing.len() as f64
    }

    /// Whether weights that differ from sample to sample explain the disagreement: a mean between its halves, whose
    /// shares are right on the middle and err to both sides alike.
    fn weighted_film(&self) -> bool {
        if !self.lie_between() {
            return false;
        }
        let mut off: Vec<f64> = self
            .disagreeing
            .iter()
            .filter(|v| v.halves[0] != v.halves[1])
            .map(|v| (v.mean - v.halves[1]) / (v.halves[0] - v.halves[1]) - v.share)
            .collect();
        off.sort_unstable_by(f64::total_cmp);
        let median = off.get(off.len() / 2).copied().unwrap_or(f64::INFINITY);
        let signed = self.disagreeing.iter().map(|v| v.residual / v.scale); // what disagrees is not zero all through
        let (sum, squares) = signed.fold((0.0, 0.0), |(s, q), r| (s + r, q + r * r));
        median.abs() <= SHARE && sum.abs() <= BALANCE * f64::sqrt(squares)
    }

    /// Whether samples that do not count explain the disagreement: a mean between its halves, and no nearer to one of
    /// them than to the other on the whole, even where it is one of them because the other has no sample that counts.
    fn gaps(&self) -> bool {
        let nearer = |v: &Value| {
            let off = (v.mean - v.halves[1]) / (v.halves[0] - v.halves[1]) - v.share;
            // The odd sample of a pixel, which is half A's, tips no scale.
            if off.abs() < v.one { 0.0 } else { off.signum() }
        };
        let sides: f64 = self.disagreeing.iter().map(nearer).sum();
        let count = self.disagreeing.len() as f64;
        self.lie_between() && sides.abs() <= BALANCE * count.sqrt()
    }

    fn error(&self, layer: &str, estimate: &Estimate) -> FrameError {
        self.describe(layer, "halves", estimate.mean.width())
    }

    fn describe(&self, layer: &str, made_of: &'static str, width: usize) -> FrameError {
        let (channel, pixel, mean, average) = match self.worst {
            Some((_, (channel, pixel), value)) => (channel, pixel, value.mean, value.average),
            None => (0, 0, 0.0, 0.0),
        };
        FrameError::Contradiction {
            layer: layer.to_owned(),
            made_of,
            x: pixel % width,
            y: pixel / width,
            channel,
            mean,
            average,
            values: self.disagreeing.len(),
            of: self.compared,
        }
    }
}
