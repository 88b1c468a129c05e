//! Frames brighter than the engine takes, at a lower exposure.

use noisefloor_denoiser::{Input, Output};
use noisefloor_frame::{Estimate, Frame, Image, Variance};

/// Largest value that goes to the engine as it is. Its square and that times 10⁶ are within the engine's range.
const BRIGHT: f32 = 1e12;

/// Target and neighbours times a power of two.
#[derive(Debug)]
pub(crate) struct Dimmed {
    target: Frame,
    before: Vec<Frame>,
    after: Vec<Frame>,
    factor: f64,
}

impl Dimmed {
    /// `None` if the frames are fine as they are. Non-finite values are left for those who refuse them.
    pub fn new(input: &Input<'_>) -> Option<Self> {
        let frames = || input.before.iter().chain([input.target]).chain(input.after);
        let images = frames().flat_map(|f| f.color.halves.iter().flatten().chain([&f.color.mean]));
        let finite = images.flat_map(|image| image.data().iter().map(|v| v.abs())).filter(|v| v.is_finite());
        let largest = finite.fold(0.0f32, f32::max);
        if largest <= BRIGHT {
            return None;
        }
        let factor = (-f64::from(largest / BRIGHT).log2().ceil()).exp2();
        let dim = |frame: &Frame| Frame { color: dimmed(&frame.color, factor), ..frame.clone() };
        Some(Self {
            target: dim(input.target),
            before: input.before.iter().map(dim).collect(),
            after: input.after.iter().map(dim).collect(),
            factor,
        })
    }

    /// The same input at the lower exposure.
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
        for (name, image) in &mut output.diagnostics {
            if name.starts_with("candidate") || name == "first pass" {
                *image = scaled(image, radiance);
            } else if name.starts_with("error estimate") || name.starts_with("variance of the colour") {
                *image = scaled(image, square);
            }
        }
        for (name, value) in &mut output.figures {
            if name.contains("error estimate") {
                *value *= square;
            }
        }
    }
}

fn dimmed(color: &Estimate, factor: f64) -> Estimate {
    let variance = color.variance.as_ref().map(Variance::mean_variance);
    Estimate {
        mean: scaled(&color.mean, factor),
        variance: variance.map(|v| Variance::of_mean(scaled(v, factor * factor))),
        halves: color.halves.as_ref().map(|halves| halves.each_ref().map(|half| scaled(half, factor))),
    }
}

/// Times a factor, within the range of the type.
pub(crate) fn scaled(image: &Image, factor: f64) -> Image {
    let most = f64::from(f32::MAX);
    // A clamp leaves a NaN what it is.
    image.map(|v| (f64::from(v) * factor).clamp(-most, most) as f32)
}
