use std::sync::Arc;

use noisefloor_denoiser::{
    Adaptive, DenoiseError, Denoiser, Diagnostics, Exposed, Factory, Input, MethodCard, Output, ParamError,
    Parameters, StageTimer, Unit, method,
};
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::MIN_EPSILON;

use crate::algorithm::{self, Done, Goal, Task};
use crate::density;
use crate::diagnostics::{describe_choice, describe_inputs, figures};
use crate::selection::Choice;
use crate::settings::Settings;
use crate::{Density, Params, card};

/// Factories of the whole method and of its three candidates.
#[must_use]
pub fn methods() -> [Arc<dyn Factory>; 4] {
    let one = |id: &'static str, only, summary: &str| {
        method(id, summary, Some(crate::README), move |params| Rdfc::with(id, only, params))
    };
    [
        one(
            "rdfc",
            None,
            "three filters by colour and features, chosen per pixel by an unbiased risk estimate",
        ),
        one("rdfc-first", Some(Choice::First), "colour in 3×3 patches and features: keeps small detail"),
        one("rdfc-second", Some(Choice::Second), "colour in 7×7 patches and features: robust to noise"),
        one("rdfc-third", Some(Choice::Third), "features alone: blind to what the colour shows"),
    ]
}

/// The method of Rousselle et al. 2013, or one of its candidate filters: see the crate documentation.
#[derive(Debug, Clone, PartialEq)]
pub struct Rdfc {
    id: &'static str,
    only: Option<Choice>,
    params: Params,
    settings: Settings,
}

impl Rdfc {
    /// The whole method.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        Self::with("rdfc", None, params)
    }

    /// One candidate filter alone.
    ///
    /// # Errors
    /// As [`Rdfc::new`].
    pub fn candidate(choice: Choice, params: Params) -> Result<Self, ParamError> {
        let id = match choice {
            Choice::First => "rdfc-first",
            Choice::Second => "rdfc-second",
            Choice::Third => "rdfc-third",
        };
        Self::with(id, Some(choice), params)
    }

    fn with(id: &'static str, only: Option<Choice>, params: Params) -> Result<Self, ParamError> {
        params.check()?;
        let settings = Settings::new(&params);
        Ok(Self { id, only, params, settings })
    }

    /// The parameters.
    #[must_use]
    pub fn params(&self) -> &Params {
        &self.params
    }

    /// [`Denoiser::denoise`] at the exposure for which ε is meant.
    fn filter(&self, input: &Input<'_>, epsilon: f32) -> Result<Output, DenoiseError> {
        let mut timer = StageTimer::start();
        let task = self.task(epsilon, Goal::Image);
        let Done { target, mut candidates, combination } =
            algorithm::denoise(&task, &self.settings, input, &mut timer)?;
        let diagnostics = input.diagnostics != Diagnostics::Off;
        let mut output = if let Some((first, image)) = combination {
            let mut output = Output::from_image(image);
            figures(&mut output, &first);
            if diagnostics {
                describe_choice(&mut output, &candidates, &first);
            }
            output.error_estimate = Some(first.sure);
            if first.halves.is_some() {
                output.estimate_of = Some(("first pass".into(), first.mean));
            }
            output
        } else {
            let candidate = candidates.remove(0); // asked for one
            let mut output = Output::from_image(candidate.mean);
            output.error_estimate = Some(candidate.sure);
            output
        };
        if let Some(estimate) = &output.error_estimate {
            // An image has at least one value.
            let values = estimate.data();
            let mean = values.iter().copied().map(f64::from).sum::<f64>() / values.len() as f64;
            output.figure("mean error estimate", Unit::RadianceSquared, mean);
        }
        if diagnostics {
            describe_inputs(&mut output, &target);
            timer.finish("diagnostics");
        }
        output.stages = timer.into_stages();
        Ok(output)
    }

    fn task(&self, epsilon: f32, goal: Goal) -> Task<'_> {
        Task { id: self.id, only: self.only, features: &self.params.features, epsilon, goal }
    }

    /// The input with the neighbouring frames in use, the nearest of each side.
    fn in_use<'a>(&self, input: &Input<'a>) -> Input<'a> {
        let k = self.params.neighbors;
        let before = &input.before[input.before.len().saturating_sub(k)..];
        input.with_neighbors(before, &input.after[..k.min(input.after.len())])
    }
}

impl Default for Rdfc {
    fn default() -> Self {
        Self::new(Params::default()).expect("the defaults are in range")
    }
}

impl Denoiser for Rdfc {
    fn card(&self) -> MethodCard {
        card::card(self.id, self.only, &self.params)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        // Alg. 1, line 1: what it begins with is there, and at the exposure for which ε is meant.
        input.check(&self.card())?;
        let input = &self.in_use(input);
        let exposed = Exposed::new(input, BRIGHT);
        let mut output = self.filter(&exposed.input(input), epsilon(&exposed))?;
        exposed.undo(&mut output);
        Ok(output)
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        Some(self)
    }
}

/// Adaptive sampling (Sec. 8).
impl Adaptive for Rdfc {
    fn density(&self, input: &Input<'_>) -> Result<Image, DenoiseError> {
        input.check(&self.card())?;
        let input = &self.in_use(input);
        // A density has no unit.
        let exposed = Exposed::new(input, BRIGHT);
        let printed = self.settings.density == Density::Text;
        let goal = if printed { Goal::CombinationDensity } else { Goal::CandidateDensity };
        let task = self.task(epsilon(&exposed), goal);
        let mut timer = StageTimer::start();
        let Done { target, candidates, combination } =
            algorithm::denoise(&task, &self.settings, &exposed.input(input), &mut timer)?;
        if printed {
            let first = combination.as_ref().map(|(first, _)| first);
            density::text(self.id, &target, &candidates, first, &self.settings)
        } else {
            density::code(self.id, &target, &candidates[0], &self.settings)
        }
    }
}

/// Largest value that goes to the engine; ours. Its square and that times 10⁶ are within the engine's range.
const BRIGHT: f32 = 1e12;
/// ε of Sec. 4, for frames of a median luminance between ¼ and ½: the authors' program's, as the text prints no number.
const EPSILON: f64 = 1e-10;

/// ε at the exposure of a frame, above 0.
fn epsilon(exposed: &Exposed) -> f32 {
    (EPSILON * exposed.left().powi(2)).max(f64::from(MIN_EPSILON)) as f32
}
