//! The exposure at which frames are filtered.

use noisefloor_denoiser::{Input, Output};
use noisefloor_frame::{Estimate, Frame, Image, Variance};
use noisefloor_kernels::nlm::MIN_EPSILON;

/// Largest value that goes to the engine. Its square and that times 10⁶ are within the engine's range.
const BRIGHT: f32 = 1e12;
/// ε of the text, for frames of a median luminance between ¼ and ½.
const EPSILON: f64 = 1e-10;

/// Target and neighbours times a power of two that takes the target's median luminance to between ¼ and ½: what the
/// method adds to variances and squared means (ε, 0.01) is meant for such values, and no result depends on the
/// exposure that a frame came with. A power of two changes no digit.
#[derive(Debug)]
pub(crate) struct Exposed {
    target: Frame,
    before: Vec<Frame>,
    after: Vec<Frame>,
    factor: f64,
    /// What of ε is left where the frame's brightest value keeps it from its exposure, above 0.
    epsilon: f32,
}

impl Exposed {
    /// Non-finite values are left for those who refuse them.
    pub fn new(input: &Input<'_>) -> Self {
        let frames = || input.before.iter().chain([input.target]).chain(input.after);
        let images = frames().flat_map(|f| f.color.halves.iter().flatten().chain([&f.color.mean]));
        let finite = images.flat_map(|image| image.data().iter().map(|v| v.abs())).filter(|v| v.is_finite());
        let largest = finite.fold(0.0f32, f32::max);
        // 2^(−2−⌊log₂⌋): exact, and within the range of the type for every positive value.
        let power = |typical: f32| (-2.0 - f64::from(typical).log2().floor()).exp2();
        let wanted = input.target.color.mean.median_luminance().map_or(1.0, power);
        let factor = if f64::from(largest) * wanted > f64::from(BRIGHT) {
            (-(f64::from(largest) / f64::from(BRIGHT)).log2().ceil()).exp2()
        } else {
            wanted
        };
        let dim = |frame: &Frame| Frame { color: exposed(&frame.color, factor), ..frame.clone() };
        let epsilon = EPSILON * (factor / wanted).powi(2);
        Self {
            target: dim(input.target),
            before: input.before.iter().map(dim).collect(),
            after: input.after.iter().map(dim).collect(),
            factor,
            epsilon: epsilon.max(f64::from(MIN_EPSILON)) as f32,
        }
    }

    /// ε at this exposure.
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// The input at this exposure.
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
        if let Some((_, image)) = &mut output.estimate_of {
            *image = scaled(image, radiance);
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

fn exposed(color: &Estimate, factor: f64) -> Estimate {
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
