//! Rousselle et al. 2013, Algorithm 1 (Sec. 7), in its order.
//!
//! Where each of its lines is done:
//!
//! | line of Alg. 1 | what | file |
//! |---|---|---|
//! | 1 | the input is checked and brought to one exposure | `method.rs` |
//! | 2 | variance of the colour at the right level (Sec. 4) | `prepare.rs` |
//! | 3-4 | variances of the features (Sec. 4) | `features.rs` |
//! | 5 | numbers of the features' own filter (Sec. 5) | `params.rs` |
//! | 6-8 | features filtered by themselves, their residual variances (Sec. 5) | `features.rs` |
//! | 9-14 | FIRST, SECOND, THIRD with their derivatives (Sec. 6) | `candidates.rs` |
//! | 15-18 | risk estimates, filtered (Sec. 6) | `first_pass.rs` |
//! | 19-21 | the choice in each pixel (Sec. 6) | `selection.rs` |
//! | 22-25 | maps of the choice, filtered (Sec. 6) | `first_pass.rs` |
//! | 26 | the combination | `first_pass.rs` |
//! | 27-29 | the second pass over it (Sec. 7) | `second_pass.rs` |
//!
//! And its equations:
//!
//! | equation | what | file |
//! |---|---|---|
//! | Eq. 1 | the filter: a weighted mean | `kernel.rs`, for the engine in `noisefloor-kernels` |
//! | Eq. 2 | weights from patches of the colour (Sec. 4) | `kernel.rs`, likewise |
//! | Eq. 3 | weights from features (Sec. 5) | `kernel.rs`, likewise; what is compared in `features.rs` |
//! | Eq. 4 | the smaller of the two (Sec. 6) | `kernel.rs`, likewise |
//! | Eq. 5 | the risk estimate (Sec. 6) | `sure.rs`, its derivative in `candidates.rs` |
//!
//! Sec. 8 widens the candidates' window in time, below, and says where further samples help: `density.rs`.

use noisefloor_denoiser::{DenoiseError, Input, StageTimer};
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::nlm::MAX_PIXELS;

use crate::SecondPass;
use crate::candidates::{Candidate, Wanted, candidates};
use crate::features::{noisy, prefilter, usable};
use crate::first_pass::{FirstPass, binary_maps, estimates, filtered_maps};
use crate::kernel::within_range;
use crate::prepare::{Prepared, alike, color_variance, noisy_color};
use crate::second_pass::second_pass;
use crate::selection::Choice;
use crate::settings::Settings;

/// What is asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    /// Id of the method, for errors.
    pub id: &'static str,
    /// The candidate that runs alone.
    pub only: Option<Choice>,
    /// Features in use, by name.
    pub features: &'a [String],
    /// ε of the colour's distances (Sec. 4) at the frame's exposure.
    pub epsilon: f32,
    pub goal: Goal,
}

/// What lines are run for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Goal {
    /// The denoised image: all lines.
    Image,
    /// A density from candidates alone (Sec. 8): up to line 14.
    CandidateDensity,
    /// A density from the combination (Sec. 8): up to line 26.
    CombinationDensity,
}

/// What came of it.
#[derive(Debug)]
pub(crate) struct Done<'a> {
    pub target: Prepared<'a>,
    pub candidates: Vec<Candidate>,
    /// The combination of all three and the output, where lines after the 14th were run.
    pub combination: Option<(FirstPass, Image)>,
}

/// Algorithm 1 on a checked input, all of whose neighbours are in use.
pub(crate) fn denoise<'a>(
    task: &Task<'_>,
    settings: &Settings,
    input: &Input<'a>,
    timer: &mut StageTimer,
) -> Result<Done<'a>, DenoiseError> {
    // Alg. 1, line 1 (Sec. 7): colour c and features f_1 … f_M, each with its sample variance; R is in the settings. All
    // frames are brought to the target's units.
    let id = task.id;
    DenoiseError::refuse_size(id, input.target, MAX_PIXELS)?;
    let in_use = usable(input.target, task.features, settings.far);
    let prepare = |frame: &'a Frame, timer: &mut StageTimer| {
        let (halves, sampled) = noisy_color(id, frame, &in_use)?;

        // Alg. 1, line 2 (Sec. 4): variance of the colour, with the structure of one estimate and the level of another.
        let variance = color_variance(frame, halves, sampled, settings.scaling);
        timer.finish("variance");

        // Alg. 1, lines 3-4 (Sec. 4): the same of each feature.
        let found = in_use.iter().filter_map(|(id, unit)| Some((id.name(), frame.feature(id)?, *unit)));
        let noisy = found.map(|(name, feature, unit)| noisy(frame, feature, name, unit, settings.scaling));

        // Alg. 1, lines 5-8 (Sec. 5): each is filtered by itself, which leaves it a residual variance.
        let features = noisy.map(|noisy| prefilter(id, frame, noisy, settings)).collect::<Result<_, _>>()?;
        timer.finish("prefilter");
        Ok(Prepared { frame, halves, variance, features, epsilon: task.epsilon })
    };
    let target = prepare(input.target, timer)?;

    // Sec. 8, space-time filtering: the candidates' window reaches into frames before and after. One that lacks a feature of
    // the target has no distances to it.
    let frames = input.before.iter().chain(input.after);
    let beside = frames.map(|frame| prepare(frame, timer)).collect::<Result<Vec<_>, DenoiseError>>()?;
    let beside: Vec<_> = beside.into_iter().filter(|frame| alike(&target, frame)).collect();

    // Alg. 1, lines 9-14 (Sec. 6, Eq. 1, Eq. 2, Eq. 3, Eq. 4): three filters between fidelity to detail and robustness to
    // noise, in one sweep, and how much each moves with its own pixel. Half buffers serve the second pass alone.
    let image = task.goal == Goal::Image;
    let second = task.only.is_none() && settings.second_pass != SecondPass::Off;
    let wanted = Wanted { halves: image && second, counts: !image };
    let which = task.only.map_or_else(|| Choice::ALL.to_vec(), |choice| vec![choice]);
    let candidates = candidates(id, &target, &beside, &which, wanted, settings)?;
    timer.finish("candidates");
    if task.only.is_some() || task.goal == Goal::CandidateDensity {
        return Ok(Done { target, candidates, combination: None });
    }

    // Alg. 1, lines 15-18 (Sec. 6, Eq. 5): how wrong each is, from the noisy data, smoothed a little.
    let errors = estimates(id, &target, &candidates, settings)?;
    timer.finish("errors");

    // Alg. 1, lines 19-21 (Sec. 6): 1 for the least wrong one; FIRST only where it filters more than SECOND.
    let binary = binary_maps(&candidates, &errors, settings.ties);

    // Alg. 1, lines 22-25 (Sec. 6): the choice smoothed more, as a map of choices has no outliers.
    let weights = filtered_maps(id, &target, &binary, settings)?;

    // Alg. 1, line 26 (Sec. 6): the candidates' mean with these weights.
    let first = FirstPass::new(&candidates, errors, binary, weights);
    timer.finish("selection");

    // Alg. 1, lines 27-29 (Sec. 7): noise that is left, mostly along edges, is found from the half buffers and filtered.
    let mut output = within_range(first.mean.clone());
    if let Some(halves) = &first.halves {
        let halves = halves.clone().map(within_range);
        output = second_pass(id, &target, &halves, &output, settings)?;
        timer.finish("second pass");
    }
    Ok(Done { target, candidates, combination: Some((first, output)) })
}
