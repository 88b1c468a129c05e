use std::fmt;

use noisefloor_frame::{Frame, Image, Moments, Sampling, Variance};

/// Pixels below which the comparison says nothing.
const LEAST_PIXELS: u64 = 64;
/// Standard errors by which the mean ratio must differ from 1.
const LEAST_ERRORS: f64 = 4.0;

/// The stored variance and the half buffers of a frame disagree by about its number of samples.
///
/// `Display` is a sentence for the user.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VarianceScaleWarning {
    /// Stored variance over what the half buffers show; 1 if all is well.
    pub ratio: f64,
    /// Mean samples per pixel, n.
    pub samples: f64,
    /// What looks lost.
    pub factor: LostFactor,
}

/// Which factor a stored variance lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LostFactor {
    /// About n times too large: probably the variance of one sample, to be divided by n.
    DivideBySamples,
    /// About n times too small: probably divided by n twice.
    MultiplyBySamples,
}

impl fmt::Display for VarianceScaleWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (ratio, n) = (self.ratio, self.samples);
        let guess = match self.factor {
            LostFactor::DivideBySamples => "it may be the variance of one sample, not of the mean",
            LostFactor::MultiplyBySamples => "it may have been divided by the sample count twice",
        };
        let times =
            if ratio >= 1.0 { format!("{ratio:.2} times") } else { format!("1/{:.2} of", 1.0 / ratio) };
        write!(
            f,
            "the stored variance is {times} what the half buffers show, at {n} samples per pixel: {guess}"
        )
    }
}

/// Compares the colour variance that a file states with what its half buffers show.
///
/// Programs write sample variance, variance of the mean or sums of squares under one name; the half buffers have no such
/// ambiguity. The statistic is the mean over pixels of (two-buffer variance / stored variance), both summed over the
/// channels. For independent samples the order within a pixel is arbitrary, and over all orders the two-buffer variance
/// (A−B)²·n_A·n_B/n² averages to s²/n exactly, which does not depend on the order: so the expected ratio is 1 for
/// every pixel and every distribution, and a firefly counts no more than any other pixel. A mean nearer to n or 1/n than to
/// 1, and more than 4 of its standard errors away from 1, is reported.
///
/// `None` also if there is nothing to compare: no variance, no halves, fewer than 64 pixels with finite values and
/// positive variance, fewer than 2 samples, or sampling that is not independent (s²/n is not the variance of the mean there).
#[must_use]
pub fn check_variance_scale(frame: &Frame) -> Option<VarianceScaleWarning> {
    if frame.sampling != Sampling::Independent {
        return None;
    }
    let color = &frame.color;
    let (stored, halves) = (color.variance.as_ref()?.mean_variance(), color.halves.as_ref()?);
    let from_halves = Variance::from_halves(halves, &frame.samples).ok()?.into_mean_variance();
    let sum = |image: &Image, pixel: usize| -> f64 { image.planes().map(|p| f64::from(p[pixel])).sum() };
    let mut ratios = Moments::<1>::default();
    for pixel in 0..frame.pixels() {
        let (stored, two_buffer) = (sum(stored, pixel), sum(&from_halves, pixel));
        if stored > 0.0 && (two_buffer / stored).is_finite() {
            ratios.push([two_buffer / stored]);
        }
    }
    let [spread] = ratios.sample_variance().filter(|_| ratios.count() >= LEAST_PIXELS)?;
    let ([mean], samples) = (ratios.mean(), frame.samples.total().mean());
    let error = (spread / ratios.count() as f64).sqrt(); // at least LEAST_PIXELS
    // A mean of zero is a frame without noise in its halves: nothing to compare.
    if samples < 2.0 || mean <= 0.0 || (mean - 1.0).abs() <= LEAST_ERRORS * error {
        return None;
    }
    let factor = match mean.ln() / samples.ln() {
        power if power < -0.5 => LostFactor::DivideBySamples,
        power if power > 0.5 => LostFactor::MultiplyBySamples,
        _ => return None,
    };
    Some(VarianceScaleWarning { ratio: 1.0 / mean, samples, factor })
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefloor_frame::{Estimate, Samples};

    /// Independent samples of a skewed law (u⁴, now and then a thousand times as bright), scaled by `scale`.
    fn frame(n: u32, scale: f64) -> Frame {
        let (width, height) = (24, 16);
        let mut state = u64::from(n);
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        let blank = Image::new(width, height, 3);
        let (mut mean, mut variance, mut a, mut b) = (blank.clone(), blank.clone(), blank.clone(), blank);
        for pixel in 0..width * height {
            let mut both = [Moments::<3>::default(); 2];
            for k in 0..n {
                let fire = if uniform() < 1e-3 { 1000.0 } else { 1.0 };
                both[(k % 2) as usize].push([(); 3].map(|()| uniform().powi(4) * fire));
            }
            let mut all = both[0];
            all.merge(&both[1]);
            for c in 0..3 {
                mean.plane_mut(c)[pixel] = all.mean()[c] as f32;
                let v = all.mean_variance().map_or(0.0, |v| v[c]);
                variance.plane_mut(c)[pixel] = (v * scale) as f32;
                a.plane_mut(c)[pixel] = both[0].mean()[c] as f32;
                b.plane_mut(c)[pixel] = both[1].mean()[c] as f32;
            }
        }
        let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: Some([a, b]) };
        Frame::from_color(color, Samples::uniform(n), Sampling::Independent)
    }

    #[test]
    fn a_variance_of_the_mean_passes_at_every_sample_count() {
        for n in [1, 2, 3, 4, 16, 64, 101] {
            assert_eq!(check_variance_scale(&frame(n, 1.0)), None, "{n}");
        }
    }

    #[test]
    fn a_lost_factor_of_n_is_noticed_both_ways() {
        for n in [4, 16, 64] {
            let found = check_variance_scale(&frame(n, f64::from(n))).expect("the variance of one sample");
            assert_eq!(found.factor, LostFactor::DivideBySamples);
            // The variance of χ² with one degree of freedom is 2, over 384 pixels, 4 standard errors.
            let tolerance = 4.0 * (2.0f64 / 384.0).sqrt();
            assert!((f64::from(n) / found.ratio - 1.0).abs() < tolerance, "{found}");
            let found = check_variance_scale(&frame(n, 1.0 / f64::from(n))).expect("divided twice");
            assert_eq!((found.factor, found.samples), (LostFactor::MultiplyBySamples, f64::from(n)));
            assert!(found.to_string().contains("divided by the sample count twice"), "{found}");
        }
    }

    #[test]
    fn nothing_to_compare_is_no_warning() {
        let wrong = || frame(16, 16.0);
        let mut f = wrong();
        f.sampling = Sampling::LowDiscrepancy;
        assert_eq!(check_variance_scale(&f), None);
        let mut f = wrong();
        f.color.halves = None;
        assert_eq!(check_variance_scale(&f), None);
        let mut f = wrong();
        f.color.variance = None;
        assert_eq!(check_variance_scale(&f), None);
        assert_eq!(check_variance_scale(&wrong().crop(0, 0, 7, 9)), None, "63 pixels");
        let mut f = wrong();
        f.color.halves = Some([f.color.mean.clone(), f.color.mean.clone()]);
        assert_eq!(check_variance_scale(&f), None, "no noise at all");
        let mut f = wrong();
        f.color.mean.data_mut().fill(f32::NAN);
        assert!(check_variance_scale(&f).is_some(), "the mean plays no part");
        f.color.halves.as_mut().unwrap()[0].data_mut().fill(f32::NAN);
        assert_eq!(check_variance_scale(&f), None, "nothing finite is left");
    }
}
