//! Error estimates, the choice between the candidates, and their combination (Algorithm 1, lines 14 to 27).

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::{Center, NlmParams};

use crate::candidates::Candidate;
use crate::kernel;
use crate::prepare::Prepared;
use crate::selection::select;
use crate::settings::Settings;
use crate::sure::{mean_of_channels, sum_of_channels};

/// k_c of the filters of error estimates and selection maps.
const MAP_K: f32 = 1.0;
/// Window radius for error estimates, pixels.
const ERROR_RADIUS: usize = 1;
/// Window radius for selection maps, pixels.
const MAP_RADIUS: usize = 5;

/// The combination of the candidates and how it came about.
#[derive(Debug, Clone)]
pub(crate) struct FirstPass {
    /// Both halves, where the candidates have theirs.
    pub halves: Option<[Image; 2]>,
    pub mean: Image,
    /// Filtered error estimates, one channel per candidate.
    pub errors: Image,
    /// 1 for the chosen candidate, one channel per candidate.
    pub binary: Image,
    /// Weights of the candidates, one channel each; they sum to 1.
    pub weights: Image,
    /// Estimated squared error of the combination per colour channel: the candidates' own, not filtered, with its
    /// weights.
    pub sure: Image,
}

/// Chooses between all three candidates.
pub(crate) fn first_pass(
    method: &str,
    target: &Prepared<'_>,
    candidates: &[Candidate],
    settings: &Settings,
    timer: &mut StageTimer,
) -> Result<FirstPass, DenoiseError> {
    let (width, height) = (target.frame.width(), target.frame.height());
    let raw: Vec<Vec<f32>> = candidates.iter().map(|c| sum_of_channels(&c.sure).data().to_vec()).collect();
    let errors = filter_errors(
        method,
        target,
        &kernel::image(&raw, width, height),
        (settings.map_patch, ERROR_RADIUS),
        settings.center,
    )?;
    timer.finish("errors");
    let binary = binary_maps(candidates, &errors, settings);
    let maps = by_color(method, target, &binary, (settings.map_patch, MAP_RADIUS), settings.center)?;
    let weights = normalized(&maps);
    let halves = candidates.iter().all(|c| c.halves.is_some()).then(|| {
        [0, 1].map(|h| combined(candidates, &weights, |c| &c.halves.as_ref().expect("all have theirs")[h]))
    });
    let mean = combined(candidates, &weights, |c| &c.mean);
    let sure = combined(candidates, &weights, |c| &c.sure);
    timer.finish("selection");
    Ok(FirstPass { halves, mean, errors, binary, weights, sure })
}

/// Filters maps with weights from the colour, with this patch and window radius.
fn by_color(
    method: &str,
    target: &Prepared<'_>,
    maps: &Image,
    (patch, radius): (usize, usize),
    center: Center,
) -> Result<Image, DenoiseError> {
    let (width, height) = (maps.width(), maps.height());
    let guide = kernel::channels(&target.frame.color.mean, &target.variance);
    let params =
        NlmParams { center, epsilon: target.epsilon, ..NlmParams::new(width, height, radius, MAP_K) };
    let filtered = kernel::filter_guided(method, &params, patch, guide, maps.planes().collect())?;
    Ok(kernel::image(&filtered.planes, width, height))
}

/// Filters error estimates, which may be squares of the largest values that the engine takes: scaled by a power of two,
/// which changes no digit.
pub(crate) fn filter_errors(
    method: &str,
    target: &Prepared<'_>,
    errors: &Image,
    sizes: (usize, usize),
    center: Center,
) -> Result<Image, DenoiseError> {
    let scale = unit_scale(errors);
    let filtered = by_color(method, target, &errors.map(|v| v * scale), sizes, center)?;
    // At least 2⁻¹⁰⁴, as magnitudes are at most 3·10³⁰.
    Ok(filtered.map(|v| v / scale))
}

/// The power of two that takes values above 1 to at most 1.
pub(crate) fn unit_scale(image: &Image) -> f32 {
    let largest = image.data().iter().fold(0.0f32, |most, v| most.max(v.abs()));
    if largest > 1.0 { (-largest.log2().ceil()).exp2() } else { 1.0 }
}

/// One channel per candidate, 1 where it is chosen.
fn binary_maps(candidates: &[Candidate], errors: &Image, settings: &Settings) -> Image {
    let derivatives: Vec<Image> = candidates.iter().map(|c| mean_of_channels(&c.derivative)).collect();
    let mut maps = Image::new(errors.width(), errors.height(), candidates.len());
    for p in 0..errors.pixels() {
        let errors = [0, 1, 2].map(|k| errors.plane(k)[p]);
        let slopes = [0, 1, 2].map(|k| derivatives[k].plane(0)[p]);
        maps.plane_mut(select(errors, slopes, settings.ties).index())[p] = 1.0;
    }
    maps
}

/// Divides the channels by their sum. The maps before filtering sum to 1 and share their weights, so the sum is 1 up
/// to rounding.
fn normalized(maps: &Image) -> Image {
    let mut out = maps.clone();
    for p in 0..maps.pixels() {
        let sum: f32 = maps.planes().map(|plane| plane[p]).sum();
        out.planes_mut().for_each(|plane| plane[p] /= sum);
    }
    out
}

/// Σ weight·part of every candidate.
pub(crate) fn combined<'a>(
    candidates: &'a [Candidate],
    weights: &Image,
    part: impl Fn(&'a Candidate) -> &'a Image,
) -> Image {
    let mut out = part(&candidates[0]).map(|_| 0.0);
    for (k, candidate) in candidates.iter().enumerate() {
        let (from, weights) = (part(candidate), weights.plane(k));
        for c in 0..from.channels() {
            for ((value, from), weight) in out.plane_mut(c).iter_mut().zip(from.plane(c)).zip(weights) {
                *value += weight * from;
            }
        }
    }
    out
}
