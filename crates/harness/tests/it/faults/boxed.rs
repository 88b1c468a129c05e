//! A method with an estimate of its own error that is right, or lacks a term.

use std::sync::Arc;

use noisefloor_denoiser::{
    Citation, DenoiseError, Denoiser, Factory, Input, MethodCard, Need, NoParams, Output, method,
};
use noisefloor_frame::Image;

/// Stein's unbiased risk estimate of a linear filter y = Σ h·x, (y − x)² − v + 2·h_ii·v (Stein 1981, Theorem 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sure {
    /// All of it.
    Whole,
    /// Without the last term, that of the derivative.
    WithoutDerivative,
}

/// Three quarters of the pixel and a quarter of the mean of 3×3 pixels, at a border of those that are there: a filter that
/// is close to the identity has little bias, so that the derivative is much of its estimate.
struct Boxed(Sure);

const OF_MEAN: f32 = 0.25;

/// The method, whose card promises that its estimate is unbiased.
pub fn boxed(sure: Sure) -> Arc<dyn Factory> {
    method("boxed", "a pixel and those around it", None, move |_: NoParams| Ok(Boxed(sure)))
}

impl Denoiser for Boxed {
    fn card(&self) -> MethodCard {
        let citation = Citation::new("none", "made up for a test");
        let mut card = MethodCard::new("boxed", "A pixel and those around it", citation);
        // Halves are rendered for methods that need them.
        card.needs = vec![Need::ColorVariance, Need::ColorHalves];
        card.claims.estimates_error = true;
        card.unbiased_estimate = true;
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let color = &input.target.color;
        let (mean, variance) = (&color.mean, color.variance.as_ref().unwrap().mean_variance());
        let (w, h) = (mean.width(), mean.height());
        let around =
            |x: usize, y: usize| (x.saturating_sub(1)..(x + 2).min(w), y.saturating_sub(1)..(y + 2).min(h));
        let count = |x: usize, y: usize| {
            let (columns, rows) = around(x, y);
            (columns.len() * rows.len()) as f32
        };
        let image = Image::from_fn(w, h, 3, |c, x, y| {
            let (columns, rows) = around(x, y);
            let of_row = |j: usize| columns.clone().map(move |i| mean.get(c, i, j)).sum::<f32>();
            let around = rows.map(of_row).sum::<f32>() / count(x, y);
            mean.get(c, x, y) + OF_MEAN * (around - mean.get(c, x, y))
        });
        let estimate = Image::from_fn(w, h, 3, |c, x, y| {
            let (apart, v) = (image.get(c, x, y) - mean.get(c, x, y), variance.get(c, x, y));
            let derivative = match self.0 {
                Sure::Whole => 2.0 * v * (1.0 - OF_MEAN + OF_MEAN / count(x, y)),
                Sure::WithoutDerivative => 0.0,
            };
            apart * apart - v + derivative
        });
        let mut output = Output::from_image(image);
        output.error_estimate = Some(estimate);
        Ok(output)
    }
}
