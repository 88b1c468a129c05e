use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{Estimate, FeatureId, FrameError, Image, Provenance, Samples, Variance};

/// What the sample variance means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sampling {
    /// Independent identically distributed samples: s²/n estimates the variance of the mean.
    Independent,
    /// Low-discrepancy, stratified or otherwise dependent samples: s²/n is *not* the variance of the mean;
    /// only differences between separately randomised halves or parts are.
    LowDiscrepancy,
}

impl Sampling {
    /// Name on disk and in records.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Independent => "independent",
            Self::LowDiscrepancy => "low-discrepancy",
        }
    }
}

/// The virtual flash image (Moon et al. 2013, Sec. 3.1).
#[derive(Debug, Clone, PartialEq)]
// A frame has at most one of these beside megabytes of pixels: a box would save nothing.
#[expect(clippy::large_enum_variant)]
pub enum Flash {
    /// Reused light F0 and the eye light S at unit intensity, kept apart because the intensity I of
    /// F = F0 + I·S is chosen after rendering.
    Parts {
        /// F0: the original lights over the reused part of the paths, 3 channels.
        base: Estimate,
        /// S: shading by a point light of intensity 1 at the eye, 3 channels.
        light: Estimate,
        /// Covariance of the two means per pixel and channel; absent if unknown.
        covariance: Option<Image>,
    },
    /// A finished flash image F.
    Ready(Estimate),
}

/// Everything known about one noisy image: what a denoiser gets.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Linear scene-referred radiance, 3 channels (R, G, B).
    pub color: Estimate,
    /// Auxiliary features by kind.
    pub features: BTreeMap<FeatureId, Estimate>,
    /// Virtual flash image.
    pub flash: Option<Flash>,
    /// Samples per pixel.
    pub samples: Samples,
    /// Kind of sampling.
    pub sampling: Sampling,
    /// Origin.
    pub provenance: Provenance,
}

/// What [`Frame::sanitize`] found and mended.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hygiene {
    /// Pixels with a NaN or infinity in colour, its variance or its halves; their mean was replaced by the mean of the
    /// valid neighbours and their variance by that of the neighbours.
    pub invalid_pixels: usize,
    /// Negative variances set to zero.
    pub negative_variances: usize,
    /// Non-finite values in feature, flash or their variances that were replaced.
    pub invalid_feature_values: usize,
    /// Row-major flags of the invalid pixels; empty if there is none.
    #[serde(skip)]
    pub invalid: Vec<bool>,
}

impl Frame {
    /// A frame that has a colour mean and nothing else.
    #[must_use]
    pub fn from_color(color: Estimate, samples: Samples, sampling: Sampling) -> Self {
        Self {
            color,
            features: BTreeMap::new(),
            flash: None,
            samples,
            sampling,
            provenance: Provenance::default(),
        }
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.color.mean.width()
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.color.mean.height()
    }

    /// Pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.color.mean.pixels()
    }

    /// A feature, if the frame has it.
    #[must_use]
    pub fn feature(&self, id: &FeatureId) -> Option<&Estimate> {
        self.features.get(id)
    }

    /// Checks that all buffers fit together.
    ///
    /// # Errors
    /// [`FrameError::Mismatch`] naming the first buffer that does not.
    pub fn check(&self) -> Result<(), FrameError> {
        let (w, h) = (self.width(), self.height());
        self.color.mean.expect_shape("color", w, h, 3)?;
        self.color.check("color")?;
        for (id, estimate) in &self.features {
            let channels = id.channel_names().map_or(estimate.mean.channels(), <[_]>::len);
            estimate.mean.expect_shape(id.name(), w, h, channels)?;
            estimate.check(id.name())?;
        }
        match &self.flash {
            Some(Flash::Parts { base, light, covariance }) => {
                base.mean.expect_shape("flashBase", w, h, 3)?;
                base.check("flashBase")?;
                light.mean.expect_shape("flashLight", w, h, 3)?;
                light.check("flashLight")?;
                if let Some(covariance) = covariance {
                    covariance.expect_shape("flashCov", w, h, 3)?;
                }
            }
            Some(Flash::Ready(flash)) => {
                flash.mean.expect_shape("flash", w, h, 3)?;
                flash.check("flash")?;
            }
            None => {}
        }
        for (what, counts) in [("samples", self.samples.total()), ("samples.halfA", self.samples.half_a())] {
            if let crate::Counts::PerPixel(map) = counts
                && map.len() != w * h
            {
                return Err(FrameError::CountMap { what: what.into(), pixels: w * h, got: map.len() });
            }
        }
        Ok(())
    }

    /// The one place where non-finite input is handled: fills invalid pixels from valid neighbours,
    /// clamps negative variances to zero, and counts both.
    ///
    /// A pixel is invalid if its colour mean, variance or halves hold a NaN or an infinity. It takes the mean over the
    /// valid pixels of the smallest square ring neighbourhood that has any, and zero if the whole image is
    /// invalid. Infinite depth (background in many renderers) becomes 1.1 times the largest finite depth, with variance 0.
    /// Other non-finite feature and flash values become 0.
    pub fn sanitize(&mut self) -> Hygiene {
        crate::frame::sanitize::run(self)
    }

    /// The rectangle that starts at `(x, y)`, of every buffer. Panics like [`Image::crop`].
    #[must_use]
    pub fn crop(&self, x: usize, y: usize, width: usize, height: usize) -> Self {
        let cut_counts = |counts: &crate::Counts| match counts {
            crate::Counts::Uniform(n) => crate::Counts::Uniform(*n),
            crate::Counts::PerPixel(map) => crate::Counts::PerPixel(
                (y..y + height)
                    .flat_map(|row| map[row * self.width() + x..][..width].iter().copied())
                    .collect(),
            ),
        };
        let cut = |estimate: &Estimate| estimate.crop(x, y, width, height);
        let samples = match cut_counts(self.samples.total()) {
            crate::Counts::Uniform(n) => Samples::uniform(n),
            crate::Counts::PerPixel(map) => Samples::per_pixel(map),
        }
        .with_half_a(cut_counts(self.samples.half_a()));
        Self {
            color: cut(&self.color),
            features: self.features.iter().map(|(id, e)| (id.clone(), cut(e))).collect(),
            flash: self.flash.as_ref().map(|flash| match flash {
                Flash::Parts { base, light, covariance } => Flash::Parts {
                    base: cut(base),
                    light: cut(light),
                    covariance: covariance.as_ref().map(|c| c.crop(x, y, width, height)),
                },
                Flash::Ready(flash) => Flash::Ready(cut(flash)),
            }),
            samples,
            sampling: self.sampling,
            provenance: self.provenance.clone(),
        }
    }
}

mod sanitize {
    use super::{Estimate, FeatureId, Flash, Frame, Hygiene, Image, Variance};

    pub(super) fn run(frame: &mut Frame) -> Hygiene {
        let mut report = Hygiene::default();
        let invalid = invalid_pixels(&frame.color);
        report.invalid_pixels = invalid.iter().filter(|&&bad| bad).count();
        if report.invalid_pixels > 0 {
            let color = &mut frame.color;
            fill(&mut color.mean, &invalid);
            if let Some(variance) = color.variance.take() {
                let mut image = variance.into_mean_variance();
                fill(&mut image, &invalid);
                color.variance = Some(Variance::of_mean(image));
            }
            for half in color.halves.iter_mut().flatten() {
                fill(half, &invalid);
            }
            report.invalid = invalid;
        }
        clamp_variance(&mut frame.color, &mut report);
        for (id, estimate) in &mut frame.features {
            if *id == FeatureId::Depth {
                replace_infinite_depth(estimate, &mut report);
            }
            clean_feature(estimate, &mut report);
        }
        match &mut frame.flash {
            Some(Flash::Parts { base, light, covariance }) => {
                clean_feature(base, &mut report);
                clean_feature(light, &mut report);
                if let Some(covariance) = covariance {
                    zero_non_finite(covariance, &mut report);
                }
            }
            Some(Flash::Ready(flash)) => clean_feature(flash, &mut report),
            None => {}
        }
        report
    }

    fn invalid_pixels(color: &Estimate) -> Vec<bool> {
        let mut invalid = vec![false; color.mean.pixels()];
        let variance = color.variance.as_ref().map(Variance::mean_variance);
        let halves = color.halves.iter().flatten();
        for image in std::iter::once(&color.mean).chain(variance).chain(halves) {
            for plane in image.planes() {
                for (flag, value) in invalid.iter_mut().zip(plane) {
                    *flag |= !value.is_finite();
                }
            }
        }
        invalid
    }

    /// Replaces flagged pixels by the mean over the valid ones of the nearest ring that has any.
    fn fill(image: &mut Image, invalid: &[bool]) {
        if invalid.iter().all(|&bad| bad) {
            image.data_mut().fill(0.0);
            return;
        }
        let (width, height) = (image.width(), image.height());
        let source = image.clone();
        for pixel in (0..invalid.len()).filter(|&p| invalid[p]) {
            let (x, y) = ((pixel % width) as isize, (pixel / width) as isize);
            let ring = (1..width.max(height) as isize).find_map(|radius| {
                let inside = |v: isize, limit: usize| v >= 0 && v < limit as isize;
                let members: Vec<usize> = (-radius..=radius)
                    .flat_map(|dy| (-radius..=radius).map(move |dx| (dx, dy)))
                    .filter(|(dx, dy)| dx.abs().max(dy.abs()) == radius)
                    .filter(|(dx, dy)| inside(x + dx, width) && inside(y + dy, height))
                    .map(|(dx, dy)| (y + dy) as usize * width + (x + dx) as usize)
                    .filter(|&q| !invalid[q])
                    .collect();
                (!members.is_empty()).then_some(members)
            });
            for c in 0..source.channels() {
                let plane = source.plane(c);
                let value = ring.as_ref().map_or(0.0, |members| {
                    let sum: f64 = members.iter().map(|&q| f64::from(plane[q])).sum();
                    (sum / members.len() as f64) as f32 // members is never empty
                });
                image.plane_mut(c)[pixel] = value;
            }
        }
    }

    fn clamp_variance(estimate: &mut Estimate, report: &mut Hygiene) {
        if let Some(variance) = estimate.variance.take() {
            let mut image = variance.into_mean_variance();
            for value in image.data_mut() {
                if *value < 0.0 {
                    *value = 0.0;
                    report.negative_variances += 1;
                }
            }
            estimate.variance = Some(Variance::of_mean(image));
        }
    }

    fn replace_infinite_depth(estimate: &mut Estimate, report: &mut Hygiene) {
        let largest = estimate.mean.data().iter().copied().filter(|v| v.is_finite()).fold(0.0f32, f32::max);
        let background: Vec<bool> = estimate.mean.data().iter().map(|v| v.is_infinite()).collect();
        let mut replace = |image: &mut Image, with: f32| {
            for (value, &far) in image.data_mut().iter_mut().zip(&background) {
                if far {
                    *value = with;
                    report.invalid_feature_values += 1;
                }
            }
        };
        let far = (largest * 1.1).min(f32::MAX);
        replace(&mut estimate.mean, far);
        for half in estimate.halves.iter_mut().flatten() {
            replace(half, far);
        }
        if let Some(variance) = estimate.variance.take() {
            let mut image = variance.into_mean_variance();
            replace(&mut image, 0.0);
            estimate.variance = Some(Variance::of_mean(image));
        }
    }

    fn clean_feature(estimate: &mut Estimate, report: &mut Hygiene) {
        zero_non_finite(&mut estimate.mean, report);
        for half in estimate.halves.iter_mut().flatten() {
            zero_non_finite(half, report);
        }
        if let Some(variance) = estimate.variance.take() {
            let mut image = variance.into_mean_variance();
            zero_non_finite(&mut image, report);
            estimate.variance = Some(Variance::of_mean(image));
        }
        clamp_variance(estimate, report);
    }

    fn zero_non_finite(image: &mut Image, report: &mut Hygiene) {
        for value in image.data_mut() {
            if !value.is_finite() {
                *value = 0.0;
                report.invalid_feature_values += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: usize, height: usize) -> Frame {
        let mean = Image::from_fn(width, height, 3, |c, x, y| (c * 100 + y * 10 + x) as f32);
        let variance = Some(Variance::of_mean(Image::filled(width, height, 3, 0.5)));
        Frame::from_color(
            Estimate { mean, variance, halves: None },
            Samples::uniform(4),
            Sampling::Independent,
        )
    }

    #[test]
    fn invalid_pixels_are_counted_and_filled_from_their_ring() {
        let mut f = frame(3, 3);
        f.color.mean.set(1, 1, 1, f32::NAN);
        let report = f.sanitize();
        assert_eq!(report.invalid_pixels, 1);
        // The ring around the centre of a linear ramp has the centre's value as its mean.
        assert_eq!(f.color.mean.get(1, 1, 1), 111.0);
        assert_eq!(f.color.mean.get(0, 1, 1), 11.0, "all channels of an invalid pixel are refilled");
    }

    #[test]
    fn a_wholly_invalid_frame_becomes_zero() {
        let mut f = frame(2, 2);
        f.color.mean.data_mut().fill(f32::INFINITY);
        assert_eq!(f.sanitize().invalid_pixels, 4);
        assert!(f.color.mean.data().iter().all(|&v| v == 0.0));
    }

    #[test]
    fn negative_variance_and_infinite_depth_are_mended() {
        let mut f = frame(2, 1);
        f.color.variance = Some(Variance::of_mean(Image::filled(2, 1, 3, -1.0)));
        let depth = Image::from_vec(2, 1, 1, vec![10.0, f32::INFINITY]).unwrap();
        f.features.insert(FeatureId::Depth, Estimate::from_mean(depth));
        let report = f.sanitize();
        assert_eq!(report.negative_variances, 6);
        assert_eq!(report.invalid_feature_values, 1);
        assert_eq!(f.features[&FeatureId::Depth].mean.data(), [10.0, 11.0]);
    }

    #[test]
    fn check_names_the_buffer_that_does_not_fit() {
        let mut f = frame(3, 2);
        f.features.insert(FeatureId::Albedo, Estimate::from_mean(Image::new(3, 1, 3)));
        let error = f.check().unwrap_err().to_string();
        assert!(error.starts_with("albedo is 3×1×3, expected 3×2×3"), "{error}");
    }
}
