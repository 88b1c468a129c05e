//! The method in the order of the authors' pseudo-code.

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::{Frame, Image};

use super::candidates::{Color, Errors, candidate, filter_errors};
use super::features::{combine, noisy, prefilter};
use super::half;
use super::kernel::{Guided, Sizes, regress};
use super::params::Params;
use super::selection::{Selection, select};
use super::settings::Settings;

/// What came of it.
#[derive(Debug)]
pub(super) struct Done {
    pub image: Image,
    /// The mean of the selected halves, before the last regression: what the error estimate is about.
    pub selected: Image,
    pub selection: Selection,
    pub errors: Errors,
    /// Features of the last regression.
    pub features: Vec<Image>,
}

/// All steps on a frame whose colour is finite.
pub(super) fn denoise(
    frame: &Frame,
    color: &Color<'_>,
    params: &Params,
    settings: &Settings,
    timer: &mut StageTimer,
) -> Result<Done, DenoiseError> {
    // Step 1: every feature filtered by itself, each half with weights from the other.
    let noisy = noisy(frame, params, settings)?;
    let filtered = noisy.iter().map(|noisy| prefilter(noisy, params, settings)).collect::<Result<Vec<_>, _>>()?;
    let of_half = |half: usize| filtered.iter().map(|halves| halves[half].clone()).collect();
    let features: [Vec<Image>; 2] = [of_half(0), of_half(1)];
    timer.finish("features");

    // Step 2: a narrow and a wide regression of each half by the other, with the other's features, and their errors, smoothed.
    let run = |k: f64| candidate(color, &features, k, params, settings);
    let candidates = [run(params.narrow_k)?, run(params.wide_k)?];
    timer.finish("candidates");
    let errors = filter_errors(color, &candidates, params, settings)?;
    timer.finish("errors");

    // Step 3: the less wrong one in each pixel and channel, as a smooth share.
    let selection = select(color, &candidates, &errors, params)?;
    timer.finish("selection");

    // Step 4: the features' halves together, filtered again.
    let features = filtered.iter().map(|halves| combine(halves, params, settings)).collect::<Result<Vec<_>, _>>()?;
    timer.finish("features again");

    // Step 5: what noise is left is seen in the difference of the halves, and taken out by one more regression.
    let [a, b] = &selection.halves;
    let (selected, variance) = (half::mean(a, b), half::variance(a, b));
    let sizes = Sizes {
        patch: params.patch_radius_px,
        window: params.window_radius_px,
        k: params.last_k,
        scale: settings.last_factor,
        epsilon: color.epsilon,
    };
    let guide = Guided { image: &selected, variance: &variance };
    let image = regress(&selected, guide, &features, &sizes, settings)?;
    timer.finish("last regression");
    Ok(Done { image, selected, selection, errors, features })
}
