//! Values that are no numbers, or that no variance can have: filled where few are unknown, dropped where many are.

mod color;
mod feature;
mod fill;
mod halves;
#[cfg(test)]
mod tests;
mod variance;

use serde::{Deserialize, Serialize};

use crate::{Finding, Flash, Frame, FrameError, Image};

/// Largest share of the values of a buffer that may be unknown: beyond it the buffer is taken for absent, and of the
/// colour the unknown pixels are no part of the image.
pub const MOST_UNKNOWN: f64 = 0.2;

/// Distance in pixels to the nearest pixel with a colour up to which a hole is filled: what lies deeper inside is no
/// part of the image.
pub(crate) const DEEPEST_FILL: u32 = 8;

/// What [`Frame::sanitize`] found and mended.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Hygiene {
    /// Pixels whose colour has a NaN or an infinity. Their mean, variance and halves were filled from the nearest
    /// pixels with a colour.
    pub invalid_pixels: usize,
    /// Of these: pixels that are no part of the image, because too many of all pixels are invalid or because they lie
    /// deep inside a hole. What was filled in there only serves methods that look across.
    #[serde(default)]
    pub absent_pixels: usize,
    /// Variances that are unknown: NaN, infinite or negative; of colour, features and flash.
    #[serde(default)]
    pub unknown_variances: usize,
    /// Of these: negative ones.
    pub negative_variances: usize,
    /// Values of half buffers that are unknown where the mean is not.
    #[serde(default)]
    pub unknown_halves: usize,
    /// Non-finite values in the means of features and flash that were replaced.
    pub invalid_feature_values: usize,
    /// Row-major flags of the invalid pixels; empty if there is none.
    #[serde(skip)]
    pub invalid: Vec<bool>,
    /// Row-major flags of the pixels that are no part of the image; empty if there is none.
    #[serde(skip)]
    pub absent: Vec<bool>,
    /// Row-major flags of the pixels with a colour whose variance is unknown in some channel; empty if there is none,
    /// or if the variance was dropped.
    #[serde(skip)]
    pub unknown: Vec<bool>,
    /// All of it in words, with kind and size.
    #[serde(skip)]
    pub findings: Vec<Finding>,
    /// Colours of the invalid pixels as they were read, in row-major order.
    #[serde(skip)]
    pub(crate) as_read: Vec<[f32; 3]>,
}

impl Hygiene {
    /// Row-major flags of the pixels whose mean or variance was made up: intervals there say nothing. Empty if there
    /// is none.
    #[must_use]
    pub fn without_statistics(&self) -> Vec<bool> {
        if self.invalid.is_empty() || self.unknown.is_empty() {
            return if self.invalid.is_empty() { self.unknown.clone() } else { self.invalid.clone() };
        }
        self.invalid.iter().zip(&self.unknown).map(|(invalid, unknown)| *invalid || *unknown).collect()
    }

    /// Puts the colours of the invalid pixels back as they were read: what plain Monte Carlo returns.
    pub fn restore(&self, image: &mut Image) {
        let invalid = self.invalid.iter().enumerate().filter(|(_, bad)| **bad);
        for ((pixel, _), color) in invalid.zip(&self.as_read) {
            for (plane, value) in image.planes_mut().zip(color) {
                if let Some(place) = plane.get_mut(pixel) {
                    *place = *value;
                }
            }
        }
    }

    /// Marks the pixels that are no part of the image with NaN.
    pub fn mark_absent(&self, image: &mut Image) {
        mark(image, &self.absent);
    }

    /// Marks all pixels without a colour of their own with NaN, filled ones included, so that no number is made from
    /// them.
    pub fn mark_invalid(&self, image: &mut Image) {
        mark(image, &self.invalid);
    }
}

fn mark(image: &mut Image, pixels: &[bool]) {
    for plane in image.planes_mut() {
        plane.iter_mut().zip(pixels).filter(|(_, flag)| **flag).for_each(|(value, _)| *value = f32::NAN);
    }
}

impl Frame {
    /// Handles values that are no numbers, so that methods see finite ones only, and tells what it did in
    /// [`Hygiene::findings`]. [`Frame::inspect`] does this and checks for contradictions before.
    ///
    /// * A pixel is invalid if its *colour* has a NaN or an infinity. Its colour, variance and halves are filled: a
    ///   pixel that touches valid ones takes their mean, one further inside the mean of those of its neighbours that
    ///   are nearer to a valid pixel. Where more than [`MOST_UNKNOWN`] of all pixels are invalid, or more than 8
    ///   pixels from a valid one, they are flagged as no part of the image.
    /// * A variance that is not finite or negative is unknown. Unknown variances are filled from known ones of their
    ///   channel in the same way; if more than [`MOST_UNKNOWN`] of all are unknown the frame is taken to have no
    ///   variance.
    /// * A value of a half buffer that is not finite is made up so that (n_A·A + n_B·B)/n is the mean: from the other
    ///   half if that is there, else both are the mean. If more than [`MOST_UNKNOWN`] are unknown the frame is taken
    ///   to have no halves.
    /// * Features and flash likewise, except that their means are not filled: infinite depth (background in many
    ///   renderers) becomes 1.1 times the largest finite depth, and other values that are not finite become 0, with
    ///   variance 0. A feature without any finite value is dropped, and so is a flash image that has such a part.
    ///
    /// # Errors
    /// [`FrameError::NoValidPixel`] if no pixel has a colour.
    pub fn sanitize(&mut self) -> Result<Hygiene, FrameError> {
        let mut report = Hygiene::default();
        color::clean(&mut self.color, &self.samples, &mut report)?;
        let samples = &self.samples;
        self.features.retain(|id, estimate| feature::clean(id.name(), estimate, samples, &mut report));
        let whole = match &mut self.flash {
            Some(Flash::Parts { base, light, covariance }) => {
                if let Some(covariance) = covariance {
                    feature::zero_non_finite(covariance, &mut report);
                }
                // Both are looked at, so that both are told.
                let [base, light] = [("flashBase", base), ("flashLight", light)]
                    .map(|(name, part)| feature::clean(name, part, samples, &mut report));
                base && light
            }
            Some(Flash::Ready(flash)) => feature::clean("flash", flash, samples, &mut report),
            None => true,
        };
        if !whole {
            self.flash = None;
        }
        report.findings = crate::sorted_findings(std::mem::take(&mut report.findings));
        Ok(report)
    }
}

/// Flags of the pixels that have a value which is not finite.
pub(crate) fn invalid_pixels(image: &Image) -> Vec<bool> {
    let mut invalid = vec![false; image.pixels()];
    for plane in image.planes() {
        invalid.iter_mut().zip(plane).for_each(|(flag, value)| *flag |= !value.is_finite());
    }
    invalid
}

/// Whether so much is unknown that nothing should be made up.
pub(crate) fn share_too_large(unknown: usize, of: usize) -> bool {
    unknown > 0 && unknown as f64 > MOST_UNKNOWN * of as f64
}
