use std::sync::Arc;

use noisefloor_denoiser::{
    Adaptive, DenoiseError, Denoiser, Diagnostics, Exposed, Factory, Input, MethodCard, Output, ParamError,
    Parameters, StageTimer, Unit, method,
};
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::{MAX_PIXELS, MIN_EPSILON};

use crate::candidates::{Candidate, Wanted, candidates};
use crate::density;
use crate::diagnostics::{describe_choice, describe_inputs, figures};
use crate::features::usable;
use crate::first_pass::first_pass;
use crate::kernel::within_range;
use crate::prepare::Prepared;
use crate::second_pass::second_pass;
use crate::selection::Choice;
use crate::settings::Settings;
use crate::{Density, Params, SecondPass, card};

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

    /// Prepares the target and its neighbours, all of which are in use, and runs the candidates.
    fn start<'a>(
        &self,
        input: &Input<'a>,
        epsilon: f32,
        wanted: Wanted,
        timer: &mut StageTimer,
    ) -> Result<(Prepared<'a>, Vec<Candidate>), DenoiseError> {
        DenoiseError::refuse_size(self.id, input.target, MAX_PIXELS)?;
        // All frames are brought to the target's units.
        let features = usable(input.target, &self.params.features, self.settings.far);
        let prepare = |frame, timer: &mut StageTimer| {
            Prepared::new(self.id, frame, &features, epsilon, &self.settings, timer)
        };
        let target = prepare(input.target, timer)?;
        let beside = input
            .before
            .iter()
            .chain(input.after)
            .map(|frame| prepare(frame, timer))
            .collect::<Result<Vec<_>, _>>()?;
        // A neighbour that lacks a feature of the target has no distances to it.
        let beside: Vec<Prepared<'_>> = beside.into_iter().filter(|frame| alike(&target, frame)).collect();
        let which = self.only.map_or_else(|| Choice::ALL.to_vec(), |choice| vec![choice]);
        let candidates = candidates(self.id, &target, &beside, &which, wanted, &self.settings)?;
        timer.finish("candidates");
        Ok((target, candidates))
    }

    /// [`Denoiser::denoise`] at the exposure for which ε is meant.
    fn filter(&self, input: &Input<'_>, epsilon: f32) -> Result<Output, DenoiseError> {
        let mut timer = StageTimer::start();
        let halves = self.only.is_none() && self.settings.second_pass != SecondPass::Off;
        let wanted = Wanted { halves, counts: false };
        let (target, mut candidates) = self.start(input, epsilon, wanted, &mut timer)?;
        let diagnostics = input.diagnostics != Diagnostics::Off;
        let mut output = if self.only.is_some() {
            let candidate = candidates.remove(0); // asked for one
            let mut output = Output::from_image(candidate.mean);
            output.error_estimate = Some(candidate.sure);
            output
        } else {
            let first = first_pass(self.id, &target, &candidates, &self.settings, &mut timer)?;
            let mean = within_range(first.mean.clone());
            let mut output = Output::from_image(match &first.halves {
                None => mean,
                Some(halves) => {
                    let halves = halves.clone().map(within_range);
                    let image = second_pass(self.id, &target, &halves, &mean, &self.settings)?;
                    timer.finish("second pass");
                    image
                }
            });
            figures(&mut output, &first);
            if diagnostics {
                describe_choice(&mut output, &candidates, &first);
            }
            output.error_estimate = Some(first.sure);
            if first.halves.is_some() {
                output.estimate_of = Some(("first pass".into(), first.mean));
            }
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

/// Whether both frames have the same features with the same channels.
fn alike(a: &Prepared<'_>, b: &Prepared<'_>) -> bool {
    let shape = |p: &Prepared<'_>| -> Vec<(String, usize)> {
        p.features.iter().map(|f| (f.name.clone(), f.mean.channels())).collect()
    };
    shape(a) == shape(b)
}

impl Denoiser for Rdfc {
    fn card(&self) -> MethodCard {
        card::card(self.id, self.only, &self.params)
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
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

impl Adaptive for Rdfc {
    fn density(&self, input: &Input<'_>) -> Result<Image, DenoiseError> {
        input.check(&self.card())?;
        let input = &self.in_use(input);
        let wanted = Wanted { halves: false, counts: true };
        // A density has no unit.
        let exposed = Exposed::new(input, BRIGHT);
        let mut timer = StageTimer::start();
        let (target, candidates) =
            self.start(&exposed.input(input), epsilon(&exposed), wanted, &mut timer)?;
        if self.settings.density != Density::Text {
            return density::code(self.id, &target, &candidates[0], &self.settings);
        }
        let first = match self.only {
            Some(_) => None,
            None => Some(first_pass(self.id, &target, &candidates, &self.settings, &mut timer)?),
        };
        density::text(self.id, &target, &candidates, first.as_ref(), &self.settings)
    }
}

/// Largest value that goes to the engine. Its square and that times 10⁶ are within the engine's range.
const BRIGHT: f32 = 1e12;
/// ε of the text (Sec. 4), for frames of a median luminance between ¼ and ½.
const EPSILON: f64 = 1e-10;

/// ε at the exposure of a frame, above 0.
fn epsilon(exposed: &Exposed) -> f32 {
    (EPSILON * exposed.left().powi(2)).max(f64::from(MIN_EPSILON)) as f32
}
