//! The same for what stands for the truth.

use crate::hygiene::share_too_large;
use crate::{
    Counts, Estimate, Fidelity, Finding, FindingKind, FrameError, Image, Reference, Samples, Variance,
};

use super::average::{self, Film};

impl Reference {
    /// Checks a reference that came from outside: its halves and parts must average to its mean, as those of a frame
    /// in [`Frame::inspect`](crate::Frame::inspect). Nothing is filled: a pixel without a number stays without one,
    /// and metrics leave it out; they also refuse a reference without any number. Negative variances are unknown;
    /// where more than [`MOST_UNKNOWN`](crate::MOST_UNKNOWN) of all variances, or of the values of the halves, are
    /// unknown the reference is taken to have none.
    ///
    /// # Errors
    /// [`FrameError::Contradiction`], and those of [`Frame::check`](crate::Frame::check).
    pub fn inspect(&mut self, fidelity: Fidelity) -> Result<Vec<Finding>, FrameError> {
        self.frame.check()?;
        let color = &self.frame.color;
        let invalid: Vec<bool> = crate::hygiene::invalid_pixels(&color.mean);
        if !invalid.contains(&false) {
            return Ok(Vec::new());
        }
        // A reference whose length nobody knows counts as one sample: its halves are taken for equal.
        let samples = match self.frame.samples.total() {
            Counts::Uniform(1) => Samples::uniform(2),
            _ => self.frame.samples.clone(),
        };
        let film = if self.frame.provenance.filter.is_some() { Film::Unweighted } else { Film::Unknown };
        average::check("color", color, &samples, film, fidelity)?;
        if !self.parts.is_empty() && fidelity == Fidelity::Rounded {
            let (mean, w, h) = (&color.mean, color.mean.width(), color.mean.height());
            for (k, part) in self.parts.iter().enumerate() {
                part.expect_shape(&format!("part{k}"), w, h, 3)?;
            }
            average::check_parts(mean, &self.parts)?;
        }
        let mut found = Vec::new();
        let count = invalid.iter().filter(|&&bad| bad).count();
        if count > 0 {
            let text = format!("{count} of {} pixels are not finite and are left out", invalid.len());
            found.push(Finding::new(FindingKind::InvalidPixels, "", text).with_value(count as f64));
        }
        let color = &mut self.frame.color;
        variance(color, &invalid, &mut found);
        halves(color, &invalid, &mut found);
        Ok(found)
    }
}

fn variance(color: &mut Estimate, invalid: &[bool], found: &mut Vec<Finding>) {
    let Some(variance) = color.variance.take() else { return };
    let mut image = variance.into_mean_variance();
    for value in image.data_mut().iter_mut().filter(|v| **v < 0.0) {
        *value = f32::NAN;
    }
    let (pixels, values, of) = unknown(&[&image], invalid);
    if share_too_large(values, of) {
        let text = format!("{values} of {of} variances are unknown: they are taken for absent");
        found.push(Finding::new(FindingKind::VarianceDropped, "", text).with_value(pixels as f64));
        return;
    }
    if values > 0 {
        let text = format!("{values} of {of} variances are unknown; their {pixels} pixels are left out");
        found.push(Finding::new(FindingKind::UnknownVariance, "", text).with_value(pixels as f64));
    }
    color.variance = Some(Variance::of_mean(image));
}

fn halves(color: &mut Estimate, invalid: &[bool], found: &mut Vec<Finding>) {
    let Some([a, b]) = &color.halves else { return };
    let (pixels, values, of) = unknown(&[a, b], invalid);
    if share_too_large(values, of) {
        let text = format!("{values} of {of} values of its halves are unknown: they are taken for absent");
        found.push(Finding::new(FindingKind::HalvesDropped, "", text).with_value(pixels as f64));
        color.halves = None;
    } else if values > 0 {
        let text =
            format!("{values} of {of} values of its halves are unknown; their {pixels} pixels are left out");
        found.push(Finding::new(FindingKind::UnknownHalves, "", text).with_value(pixels as f64));
    }
}

/// Pixels and values without a number among those that have a mean, and how many these are.
fn unknown(images: &[&Image], invalid: &[bool]) -> (usize, usize, usize) {
    let (mut pixels, mut values, mut of) = (0, 0, 0);
    for p in (0..invalid.len()).filter(|&p| !invalid[p]) {
        let planes = images.iter().flat_map(|image| image.planes());
        let (all, bad) =
            planes.fold((0, 0), |(all, bad), plane| (all + 1, bad + usize::from(!plane[p].is_finite())));
        (pixels, values, of) = (pixels + usize::from(bad > 0), values + bad, of + all);
    }
    (pixels, values, of)
}
