//! The exposure at which frames are filtered.

use noisefloor_frame::{Estimate, Frame, Image, Variance};

use crate::{Input, Output, Unit};

/// Target and neighbours times a power of two that takes the target's median luminance to between ¼ and ½: constants that a
/// method adds to values or variances are then meant for such values, and no result depends on the exposure that a frame
/// came with. A power of two changes no digit. Only the colour is scaled.
#[derive(Debug)]
pub struct Exposed {
    target: Frame,
    before: Vec<Frame>,
    after: Vec<Frame>,
    factor: f64,
    /// 1, or less where the frame's brightest value keeps it from its exposure.
    left: f64,
}

impl Exposed {
    /// `brightest` is the largest value that the method takes: a frame with a brighter one goes to a lower exposure.
    /// Non-finite values are left for those who refuse them.
    #[must_use]
    pub fn new(input: &Input<'_>, brightest: f32) -> Self {
        let frames = || input.before.iter().chain([input.target]).chain(input.after);
        let images = frames().flat_map(|f| f.color.halves.iter().flatten().chain([&f.color.mean]));
        let finite = images.flat_map(|image| image.data().iter().map(|v| v.abs())).filter(|v| v.is_finite());
        let largest = finite.fold(0.0f32, f32::max);
        // 2^(−2−⌊log₂⌋): exact, and within the range of the type for every positive value.
        let power = |typical: f32| (-2.0 - f64::from(typical).log2().floor()).exp2();
        let wanted = input.target.color.mean.median_luminance().map_or(1.0, power);
        let factor = if f64::from(largest) * wanted > f64::from(brightest) {
            (-(f64::from(largest) / f64::from(brightest)).log2().ceil()).exp2()
        } else {
            wanted
        };
        let dim = |frame: &Frame| Frame { color: exposed(&frame.color, factor), ..frame.clone() };
        Self {
            target: dim(input.target),
            before: input.before.iter().map(dim).collect(),
            after: input.after.iter().map(dim).collect(),
            factor,
            left: factor / wanted,
        }
    }

    /// What of the exposure is left: 1, or less where the brightest value keeps the frame from it. Constants in radiance are
    /// to be multiplied by it, in squared radiance by its square.
    #[must_use]
    pub fn left(&self) -> f64 {
        self.left
    }

    /// What the frame's radiances are multiplied by: a power of two.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// The input at this exposure.
    #[must_use]
    pub fn input<'a>(&'a self, input: &Input<'_>) -> Input<'a> {
        Input {
            target: &self.target,
            before: &self.before,
            after: &self.after,
            diagnostics: input.diagnostics,
        }
    }

    /// Takes an output back to the exposure of the input.
    pub fn undo(&self, output: &mut Output) {
        let (radiance, square) = (1.0 / self.factor, 1.0 / (self.factor * self.factor));
        output.image = scaled(&output.image, radiance);
        if let Some(estimate) = &mut output.error_estimate {
            *estimate = scaled(estimate, square);
        }
        for bound in &mut output.bounds {
            bound.half_width = scaled(&bound.half_width, radiance);
        }
        if let Some((_, image)) = &mut output.estimate_of {
            *image = scaled(image, radiance);
        }
        let factor = |unit| match unit {
            Unit::Radiance => Some(radiance),
            Unit::RadianceSquared => Some(square),
            Unit::Pixels | Unit::None => None,
        };
        for diagnostic in &mut output.diagnostics {
            if let Some(factor) = factor(diagnostic.unit) {
                diagnostic.image = scaled(&diagnostic.image, factor);
            }
        }
        for figure in &mut output.figures {
            figure.value *= factor(figure.unit).unwrap_or(1.0);
        }
    }
}

fn exposed(color: &Estimate, factor: f64) -> Estimate {
    let variance = color.variance.as_ref().map(Variance::mean_variance);
    Estimate {
        mean: scaled(&color.mean, factor),
        variance: variance.map(|v| Variance::of_mean(scaled(v, factor * factor))),
        halves: color.halves.as_ref().map(|halves| halves.each_ref().map(|half| scaled(half, factor))),
    }
}

/// Times a factor, within the range of the type.
fn scaled(image: &Image, factor: f64) -> Image {
    let most = f64::from(f32::MAX);
    // A clamp leaves a NaN what it is.
    image.map(|v| (f64::from(v) * factor).clamp(-most, most) as f32)
}
