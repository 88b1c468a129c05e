use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{Estimate, FeatureId, FrameError, Image, Optional, Provenance, Samples};

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
    /// Further statistics of the colour's samples, only where they were asked for.
    pub optional: Optional,
    /// Samples per pixel.
    pub samples: Samples,
    /// Kind of sampling.
    pub sampling: Sampling,
    /// Origin.
    pub provenance: Provenance,
}

impl Frame {
    /// A frame that has a colour mean and nothing else.
    #[must_use]
    pub fn from_color(color: Estimate, samples: Samples, sampling: Sampling) -> Self {
        Self {
            color,
            features: BTreeMap::new(),
            flash: None,
            optional: Optional::default(),
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
        self.optional.check(w, h)?;
        for (what, counts) in [("samples", self.samples.total()), ("samples.halfA", self.samples.half_a())] {
            if let crate::Counts::PerPixel(map) = counts
                && map.len() != w * h
            {
                return Err(FrameError::CountMap { what: what.into(), pixels: w * h, got: map.len() });
            }
        }
        Ok(())
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
            optional: self.optional.crop([x, y], [width, height], cut_counts),
            samples,
            sampling: self.sampling,
            provenance: self.provenance.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Variance;

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
    fn check_names_the_buffer_that_does_not_fit() {
        let mut f = frame(3, 2);
        f.features.insert(FeatureId::Albedo, Estimate::from_mean(Image::new(3, 1, 3)));
        let error = f.check().unwrap_err().to_string();
        assert!(error.starts_with("albedo is 3×1×3, expected 3×2×3"), "{error}");
    }
}
