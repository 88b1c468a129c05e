#![doc = include_str!("README.md")]

mod algorithm;
mod candidates;
mod card;
mod features;
mod half;
mod kernel;
mod params;
mod selection;
mod settings;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use noisefloor_denoiser::{
    DenoiseError, Denoiser, Diagnostics, Exposed, Factory, Input, MethodCard, Need, Output, ParamError, Parameters,
    StageTimer, Unit,
};
use noisefloor_frame::{Frame, Variance};
use noisefloor_kernels::regression::dense::{MAX_EPSILON, MIN_EPSILON};
use noisefloor_toolbox::scaled_sample_variance;

use algorithm::Done;
use candidates::Color;
use card::ID;
use settings::Settings;

pub use card::CITATION;
pub use params::{
    Channels, Depth, Exposure, Guide, NegativeError, Params, Profile, Solver, VarianceScaling,
};

/// Largest value that is filtered; ours. Brighter frames are filtered darker, by a power of two.
const BRIGHT: f32 = 1e10;

/// Nonlinearly weighted first-order regression: see the module documentation.
#[derive(Debug, Clone, PartialEq)]
pub struct Nfor {
    params: Params,
    settings: Settings,
}

impl Nfor {
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        params.check()?;
        let settings = Settings::of(&params);
        Ok(Self { params, settings })
    }

    /// All steps on a frame at the exposure that is filtered.
    fn filter(&self, frame: &Frame, epsilon: f32, diagnostics: bool) -> Result<Output, DenoiseError> {
        let mut timer = StageTimer::start();
        let sampled = frame.color.variance.as_ref().map(Variance::mean_variance);
        let (Some(halves), Some(sampled)) = (&frame.color.halves, sampled) else {
            return Err(DenoiseError::MissingInputs {
                method: ID.into(),
                missing: vec![Need::ColorVariance, Need::ColorHalves],
                ways_out: Vec::new(),
            });
        };
        for image in halves.iter().chain([&frame.color.mean]) {
            DenoiseError::refuse(ID, "a value is not finite", image, |v| v.abs() <= kernel::MOST)?;
        }
        let variance = if self.settings.scales(frame.sampling) {
            scaled_sample_variance(&features::known(sampled), halves, &frame.samples, kernel::MOST_SQUARE)
        } else {
            features::known(sampled)
        };
        let color = Color { mean: &frame.color.mean, halves, variance: &variance, epsilon };
        let done = algorithm::denoise(frame, &color, &self.params, &self.settings, &mut timer)?;
        let mut output = Output::from_image(done.image.clone());
        if diagnostics {
            describe(&mut output, &done);
        }
        output.error_estimate = Some(done.selection.error);
        output.estimate_of = Some(("before the last regression".into(), done.selected));
        output.stages = timer.into_stages();
        Ok(output)
    }

    /// ε at the exposure that is filtered.
    fn epsilon(&self, exposed: &Exposed) -> f32 {
        let factor = match self.settings.exposure {
            // A power of two: as if the frame were filtered as it is.
            Exposure::AsIs => exposed.factor(),
            Exposure::Common => exposed.left(),
        };
        let epsilon = f64::from(kernel::EPSILON) * factor * factor;
        epsilon.clamp(f64::from(MIN_EPSILON), f64::from(MAX_EPSILON)) as f32
    }
}

impl Default for Nfor {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

/// Factory of [`Nfor`].
#[must_use]
pub fn method() -> Arc<dyn Factory> {
    let summary = "a first-order model of the colour by features at every pixel, chosen between two widths by half buffers";
    noisefloor_denoiser::method(ID, summary, Some(include_str!("README.md")), Nfor::new)
}

impl Denoiser for Nfor {
    fn card(&self) -> MethodCard {
        card::card(&self.params, &self.settings)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let exposed = Exposed::new(input, BRIGHT);
        let diagnostics = input.diagnostics != Diagnostics::Off;
        let mut output = self.filter(exposed.input(input).target, self.epsilon(&exposed), diagnostics)?;
        exposed.undo(&mut output);
        Ok(output)
    }
}

/// Images that show how it came about.
fn describe(output: &mut Output, done: &Done) {
    output.diagnose("share of the wider candidate", Unit::None, done.selection.wide.clone());
    let [narrow, wide] = &done.errors.compared;
    output.diagnose("error estimate, narrow", Unit::RadianceSquared, narrow.clone());
    output.diagnose("error estimate, wide", Unit::RadianceSquared, wide.clone());
    for (i, feature) in done.features.iter().enumerate() {
        output.diagnose(format!("feature {}, filtered", i + 1), Unit::None, feature.clone());
    }
}
