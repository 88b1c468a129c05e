//! Variance over the frames of each pixel's and channel's error, frame by frame.
//!
//! With d_t the error of the output against the truth and ρ_t that of the reference, of variance v, the measured error
//! is d_t − ρ_t. Its unbiased variance over T frames has the expectation S² + v, S² that of d_t, and given d_t the
//! references spread it, for normal noise, by (4·S²·v + 2·v²)/(T−1); the mean square by (4·D²·v + 2·v²)/T, D² the mean
//! of d_t². Both are estimated without bias by putting the measured number less v in the place of S² and D².
//!
//! Two outputs a and b against the same references share their noise: its parts in the two variances have the covariance
//! (4·S_ab·v + 2·v²)/(T−1), S_ab the covariance of d_t^a and d_t^b over the frames, estimated in the same way.

use noisefloor_frame::{Image, Reference, Variance};
use noisefloor_study::{Corrected, OverTime};

/// References of all frames.
pub(super) struct Truth {
    means: Vec<Image>,
    /// Mean over the frames of the references' variance, planar like an image; absent if one of them states none.
    noise: Option<Vec<f64>>,
    /// Pixels that are finite in all references.
    valid: Vec<bool>,
}

impl Truth {
    /// From the references in the order of the frames, which are of one size.
    pub(super) fn new<E>(references: impl Iterator<Item = Result<Reference, E>>) -> Result<Self, E> {
        let mut out = Self { means: Vec::new(), noise: Some(Vec::new()), valid: Vec::new() };
        for reference in references {
            out.add(reference?);
        }
        let frames = out.means.len().max(1) as f64;
        out.noise.iter_mut().flatten().for_each(|v| *v /= frames);
        Ok(out)
    }

    fn add(&mut self, reference: Reference) {
        let samples = &reference.frame.samples;
        let color = reference.frame.color;
        let from_halves = || Variance::from_halves(color.halves.as_ref()?, samples).ok();
        let variance = color.variance.clone().or_else(from_halves);
        if self.means.is_empty() {
            self.valid = vec![true; color.mean.pixels()];
            self.noise = Some(vec![0.0; color.mean.data().len()]);
        }
        exclude(&mut self.valid, &color.mean);
        match (&mut self.noise, &variance) {
            (Some(noise), Some(variance)) => {
                let variance = variance.mean_variance();
                exclude(&mut self.valid, variance);
                noise.iter_mut().zip(variance.data()).for_each(|(sum, &v)| *sum += f64::from(v));
            }
            (noise, _) => *noise = None,
        }
        self.means.push(color.mean);
    }

    /// Compares one output per frame with the references. `None` if no pixel is finite in all of them, if their sizes
    /// differ, or with fewer than 2 frames.
    ///
    /// With each output comes that of another row for the same frame, or `None`.
    pub(super) fn over_time<E>(
        &self,
        outputs: impl Iterator<Item = Result<(Image, Option<Image>), E>>,
    ) -> Result<Option<OverTime>, E> {
        let size = self.means.first().map_or(0, |mean| mean.data().len());
        let mut valid = self.valid.clone();
        // Welford's update: mean and centred squares of each pixel's and channel's error.
        let (mut mean, mut centred) = (vec![0.0f64; size], vec![0.0f64; size]);
        // The same for the other row, with the product of both.
        let mut other = Some((vec![0.0f64; size], vec![0.0f64; size]));
        let mut frames = 0.0f64;
        for (output, reference) in outputs.zip(&self.means) {
            let (output, beside) = output?;
            if !output.same_shape(reference) || reference.data().len() != size {
                return Ok(None);
            }
            frames += 1.0;
            exclude(&mut valid, &output);
            let beside = beside.filter(|beside| beside.same_shape(reference));
            other = other.filter(|_| beside.is_some());
            for (i, (&x, &r)) in output.data().iter().zip(reference.data()).enumerate() {
                let error = f64::from(x) - f64::from(r);
                let step = error - mean[i];
                mean[i] += step / frames; // at least 1
                centred[i] += step * (error - mean[i]);
                if let (Some((mean_beside, product)), Some(beside)) = (&mut other, &beside) {
                    let off = f64::from(beside.data()[i]) - f64::from(r);
                    product[i] += step * (off - mean_beside[i]) * (frames - 1.0) / frames;
                    mean_beside[i] += (off - mean_beside[i]) / frames;
                }
            }
        }
        if frames < 2.0 || !valid.contains(&true) {
            return Ok(None);
        }
        let (mut variance, mut squared) = (Sums::over(frames - 1.0), Sums::over(frames));
        let (mut noise, mut common) = (0.0, 0.0);
        let pixels = valid.len(); // not 0, or no pixel were valid
        for i in (0..size).filter(|i| valid[i % pixels]) {
            let v = self.noise.as_ref().map_or(0.0, |noise| noise[i]);
            variance.add(centred[i] / (frames - 1.0), v);
            squared.add(centred[i] / frames + mean[i] * mean[i], v);
            noise += v;
            if let Some((_, product)) = &other {
                // A pixel that is not finite in the other row takes part in no product.
                let covariance = product[i] / (frames - 1.0) - v;
                let term = (4.0 * covariance * v + 2.0 * v * v) / (frames - 1.0);
                common += if term.is_finite() { term } else { 0.0 };
            }
        }
        Ok(Some(OverTime {
            reference_variance: self.noise.as_ref().map(|_| noise / variance.count),
            // Channels that err alike, as for the standard errors.
            covariance: other.map(|_| 3.0 * common / variance.count.powi(2)),
            variance: variance.mean(),
            squared_error: squared.mean(),
        }))
    }
}

/// Sums over pixels and channels of a number that the references' variance is taken out of.
struct Sums {
    /// Frames, or frames less 1, that each number is a mean over.
    degrees: f64,
    count: f64,
    value: f64,
    shared: f64,
    least: f64,
}

impl Sums {
    /// `degrees` is at least 1.
    fn over(degrees: f64) -> Self {
        Self { degrees, count: 0.0, value: 0.0, shared: 0.0, least: 0.0 }
    }

    fn add(&mut self, measured: f64, v: f64) {
        self.count += 1.0;
        self.value += measured - v;
        self.shared += (4.0 * (measured - v) * v + 2.0 * v * v) / self.degrees;
        self.least += 2.0 * v * v / self.degrees;
    }

    /// At least one number was added.
    fn mean(&self) -> Corrected {
        // The channels of a pixel may err alike: three times the sum over them, an upper limit.
        let se = |sum: f64| (3.0 * sum).sqrt() / self.count;
        Corrected {
            value: self.value / self.count,
            reference_se: se(self.shared.max(self.least)),
            floor: se(self.least),
        }
    }
}

/// Leaves out the pixels where an image is not finite.
fn exclude(valid: &mut [bool], image: &Image) {
    for plane in image.planes() {
        valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use noisefloor_frame::{Estimate, Frame, Samples, Sampling};

    use super::*;

    const FRAMES: usize = 4;
    const SIZE: (usize, usize) = (24, 16);
    const PIXELS: f64 = (SIZE.0 * SIZE.1) as f64;

    /// Standard normal numbers from a hash of the key, by Box and Muller.
    fn normal(key: [u64; 4]) -> f64 {
        let bytes: Vec<u8> = key.iter().flat_map(|k| k.to_le_bytes()).collect();
        let hash = *blake3::hash(&bytes).as_bytes();
        let uniform = |at: usize| {
            let word = hash[at..at + 6].iter().fold(0u64, |word, byte| word << 8 | u64::from(*byte));
            (word as f64 + 0.5) / (1u64 << 48) as f64
        };
        (-2.0 * uniform(0).ln()).sqrt() * (std::f64::consts::TAU * uniform(8)).cos()
    }

    /// An image around `level` with noise per pixel, and per channel if `apart`.
    fn noisy(level: f64, sd: f64, key: [u64; 3], apart: bool) -> Image {
        Image::from_fn(SIZE.0, SIZE.1, 3, |c, x, y| {
            let place = 3 * (y * SIZE.0 + x) + if apart { c } else { 0 };
            (level + sd * normal([key[0], key[1], key[2], place as u64])) as f32
        })
    }

    /// The picture gets brighter from frame to frame: that is no error.
    fn references(sd: f64, draw: u64, apart: bool, stated: bool) -> Truth {
        let all = (0..FRAMES as u64).map(|frame| {
            let variance = Variance::of_mean(Image::filled(SIZE.0, SIZE.1, 3, (sd * sd) as f32));
            let mean = noisy(frame as f64, sd, [1, draw, frame], apart);
            let color = Estimate { mean, variance: stated.then_some(variance), halves: None };
            let frame = Frame::from_color(color, Samples::uniform(64), Sampling::Independent);
            Ok::<_, Infallible>(Reference { frame, parts: Vec::new() })
        });
        Truth::new(all).unwrap()
    }

    fn outputs(bias: f64, sd: f64) -> Vec<Image> {
        (0..FRAMES as u64).map(|frame| noisy(frame as f64 + bias, sd, [2, 0, frame], true)).collect()
    }

    fn over_time(truth: &Truth, outputs: &[Image]) -> Option<OverTime> {
        truth.over_time(outputs.iter().cloned().map(|image| Ok::<_, Infallible>((image, None)))).unwrap()
    }

    fn beside(truth: &Truth, outputs: &[Image], others: &[Image]) -> OverTime {
        let pairs = outputs.iter().cloned().zip(others.iter().cloned().map(Some));
        truth.over_time(pairs.map(Ok::<_, Infallible>)).unwrap().unwrap()
    }

    #[test]
    fn what_the_references_contribute_to_two_rows_is_common_as_predicted() {
        // One row errs by the negative of the other: what the references add moves them against each other.
        let row = |sign: f32| -> Vec<Image> {
            let of = |f: u64| {
                let error = noisy(0.0, 0.3, [2, 0, f], false);
                error.map(|e| f as f32 + sign * e)
            };
            (0..FRAMES as u64).map(of).collect()
        };
        let (a, b) = (row(1.0), row(-1.0));
        let (mut pairs, mut told) = (Vec::new(), 0.0);
        let draws = 300;
        for draw in 0..draws {
            let truth = references(0.2, draw, false, true);
            let (one, other) = (beside(&truth, &a, &b), over_time(&truth, &b).unwrap());
            told += one.covariance.unwrap() / draws as f64;
            pairs.push((one.variance.value, other.variance.value));
            let itself = beside(&truth, &a, &a);
            let se = itself.variance.reference_se;
            assert!((itself.covariance.unwrap() / (se * se) - 1.0).abs() < 1e-9);
        }
        let n = draws as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / n;
        let (ma, mb) = (mean(&|p| p.0), mean(&|p| p.1));
        let found = mean(&|p| (p.0 - ma) * (p.1 - mb)) * n / (n - 1.0);
        let (va, vb) = (mean(&|p| (p.0 - ma).powi(2)), mean(&|p| (p.1 - mb).powi(2)));
        // A covariance over n draws is good to √((va·vb + cov²)/n).
        let spread = ((va * vb + found * found) / n).sqrt();
        assert!((told - found).abs() < 4.0 * spread, "{told} told, {found} found, good to {spread}");
        assert!(told < -4.0 * spread, "the two move against each other: {told}");
    }

    #[test]
    fn noise_flickers_a_constant_bias_does_not_and_the_references_noise_is_taken_out() {
        let (sd, noise) = (0.3, 0.2);
        let truth = references(noise, 0, true, true);
        let plain = over_time(&truth, &outputs(0.0, sd)).unwrap();
        // Normal errors of variance sd² + noise² with 3 degrees of freedom per pixel and channel.
        let total = sd * sd + noise * noise;
        let spread = total * (2.0 / (3.0 * PIXELS * (FRAMES - 1) as f64)).sqrt();
        let off = plain.variance.value - sd * sd;
        assert!(off.abs() < 5.0 * spread, "{off} with {spread}");
        assert!(noise * noise > 10.0 * spread, "a missing correction is seen");
        assert!((plain.reference_variance.unwrap() - noise * noise).abs() < 1e-6);
        let off = plain.squared_error.value - sd * sd;
        assert!(off.abs() < 5.0 * spread, "{off} with {spread}");
        let biased = over_time(&truth, &outputs(0.5, sd)).unwrap();
        // The same noise, but pixels are rounded to single precision.
        assert!((biased.variance.value - plain.variance.value).abs() < 1e-5);
        let linear = 2.0 * 0.5 * (total / (3.0 * PIXELS * FRAMES as f64)).sqrt();
        let off = biased.squared_error.value - sd * sd - 0.25;
        assert!(off.abs() < 5.0 * spread.hypot(linear), "{off} with {spread} and {linear}");
    }

    #[test]
    fn what_the_references_contribute_is_predicted() {
        // The output's error is the same in all channels and so is the references': the prediction is then no upper
        // limit.
        let (v, s, bias) = (0.04, 0.09, 0.5);
        let outputs: Vec<Image> =
            (0..FRAMES as u64).map(|f| noisy(f as f64 + bias, 0.3, [2, 0, f], false)).collect();
        let draws: Vec<OverTime> =
            (0..200).filter_map(|draw| over_time(&references(0.2, draw, false, true), &outputs)).collect();
        let n = draws.len() as f64;
        for (name, of, own, degrees) in [
            ("variance", (|d| d.variance) as fn(&OverTime) -> Corrected, s, FRAMES as f64 - 1.0),
            ("squared error", |d| d.squared_error, s + bias * bias, FRAMES as f64),
        ] {
            let mean = draws.iter().map(|d| of(d).value).sum::<f64>() / n;
            let spread = (draws.iter().map(|d| (of(d).value - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
            let told = (draws.iter().map(|d| of(d).reference_se.powi(2)).sum::<f64>() / n).sqrt();
            // A standard deviation from n draws is good to 1/√(2n).
            let off = told / spread - 1.0;
            assert!(off.abs() < 5.0 / (2.0 * n).sqrt(), "{name}: {told} told, {spread} found");
            let expected = ((4.0 * own * v + 2.0 * v * v) / (degrees * PIXELS)).sqrt();
            // The output's own variance is that of one draw, good to √(2/(degrees·pixels)) = 4 %.
            assert!((told / expected - 1.0).abs() < 0.1, "{name}: {told} against {expected}");
            let floor = (2.0 * v * v / (degrees * PIXELS)).sqrt();
            assert!((of(&draws[0]).floor / floor - 1.0).abs() < 1e-5, "{name}: {}", of(&draws[0]).floor);
        }
    }

    #[test]
    fn pixels_that_are_not_finite_somewhere_are_left_out_everywhere() {
        let truth = references(0.0, 0, true, true);
        let mut images = outputs(0.0, 0.3);
        let before = over_time(&truth, &images).unwrap();
        images[2].set(1, 5, 7, f32::NAN);
        images[0].set(0, 0, 0, f32::INFINITY);
        let after = over_time(&truth, &images).unwrap();
        // Without 2 of 384 pixels, each of which has up to a few times the mean.
        let off = after.variance.value / before.variance.value - 1.0;
        assert!(off != 0.0 && off.abs() < 0.05, "{off}");
        images[1] = images[1].map(|_| f32::NAN);
        assert_eq!(over_time(&truth, &images), None);
        assert_eq!(over_time(&truth, &[Image::new(2, 2, 3), Image::new(2, 2, 3)]), None);
        assert_eq!(over_time(&truth, &images[2..3]), None);
    }

    #[test]
    fn a_reference_that_states_no_noise_leaves_it_in_and_says_so() {
        let outputs = outputs(0.0, 0.3);
        let bare = over_time(&references(0.2, 0, true, false), &outputs).unwrap();
        let told = over_time(&references(0.2, 0, true, true), &outputs).unwrap();
        assert_eq!((bare.reference_variance, bare.variance.reference_se), (None, 0.0));
        assert!((bare.variance.value - told.variance.value - 0.04).abs() < 1e-6);
    }
}
