//! Error estimates, maps of the choice between the candidates, and their combination (Alg. 1, lines 15-26; Sec. 6).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::nlm::NlmParams;

use crate::candidates::Candidate;
use crate::kernel;
use crate::params::Ties;
use crate::prepare::Prepared;
use crate::selection::select;
use crate::settings::Settings;
use crate::sure::{mean_of_channels, sum_of_channels};

/// k_c of the filters of error estimates and selection maps (Alg. 1, line 15 and Alg. 1, line 22).
const MAP_K: f32 = 1.0;
/// Window radius for error estimates, pixels (Alg. 1, line 15).
const ERROR_RADIUS: usize = 1;
/// Window radius for selection maps, pixels (Alg. 1, line 22).
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

impl FirstPass {
    /// Alg. 1, line 26: the candidates with these weights. The risk estimate of the combination is ours.
    pub fn new(candidates: &[Candidate], errors: Image, binary: Image, weights: Image) -> Self {
        let halves = candidates.iter().all(|c| c.halves.is_some()).then(|| {
            [0, 1]
                .map(|h| combined(candidates, &weights, |c| &c.halves.as_ref().expect("all have theirs")[h]))
        });
        let mean = combined(candidates, &weights, |c| &c.mean);
        let sure = combined(candidates, &weights, |c| &c.sure);
        Self { halves, mean, errors, binary, weights, sure }
    }
}

/// Eq. 5 summed over the channels and smoothed over the least window: Alg. 1, line 16 for FIRST, Alg. 1, line 17 for SECOND,
/// Alg. 1, line 18 for THIRD, one channel each.
pub(crate) fn estimates(
    method: &str,
    target: &Prepared<'_>,
    candidates: &[Candidate],
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let (width, height) = (target.frame.width(), target.frame.height());
    let raw: Vec<Vec<f32>> = candidates.iter().map(|c| sum_of_channels(&c.sure).data().to_vec()).collect();
    let raw = kernel::image(&raw, width, height);
    filter_errors(method, target, &raw, (settings.map_patch, ERROR_RADIUS), settings)
}

/// The maps of the choice, smoothed: Alg. 1, line 23 for FIRST, Alg. 1, line 24 for SECOND, Alg. 1, line 25 for THIRD, one
/// channel each.
pub(crate) fn filtered_maps(
    method: &str,
    target: &Prepared<'_>,
    binary: &Image,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let maps = by_color(method, target, binary, (settings.map_patch, MAP_RADIUS), settings)?;
    Ok(normalized(&maps))
}

/// Filters maps with weights from the colour (Eq. 2) alone, with this patch and window radius.
fn by_color(
    method: &str,
    target: &Prepared<'_>,
    maps: &Image,
    (patch, radius): (usize, usize),
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let (width, height) = (maps.width(), maps.height());
    let guide = kernel::channels(&target.frame.color.mean, &target.variance);
    let params = NlmParams {
        center: settings.center,
        epsilon: target.epsilon,
        rules: settings.rules,
        ..NlmParams::new(width, height, radius, MAP_K)
    };
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
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let scale = unit_scale(errors);
    let filtered = by_color(method, target, &errors.map(|v| v * scale), sizes, settings)?;
    // At least 2⁻¹⁰⁴, as magnitudes are at most 3·10³⁰.
    Ok(filtered.map(|v| v / scale))
}

/// The power of two that takes values above 1 to at most 1.
pub(crate) fn unit_scale(image: &Image) -> f32 {
    let largest = image.data().iter().fold(0.0f32, |most, v| most.max(v.abs()));
    if largest > 1.0 { (-largest.log2().ceil()).exp2() } else { 1.0 }
}

/// One channel per candidate, 1 where it is chosen (Alg. 1, lines 19-21). What the derivatives of three channels are compared
/// by is not printed; their mean, as in the authors' program.
pub(crate) fn binary_maps(candidates: &[Candidate], errors: &Image, ties: Ties) -> Image {
    let derivatives: Vec<Image> = candidates.iter().map(|c| mean_of_channels(&c.derivative)).collect();
    let mut maps = Image::new(errors.width(), errors.height(), candidates.len());
    for p in 0..errors.pixels() {
        let errors = [0, 1, 2].map(|k| errors.plane(k)[p]);
        let slopes = [0, 1, 2].map(|k| derivatives[k].plane(0)[p]);
        maps.plane_mut(select(errors, slopes, ties).index())[p] = 1.0;
    }
    maps
}

/// Divides the channels by their sum, as the authors' program does and Alg. 1 does not say. The maps before filtering sum to 1
/// and share their weights, so the sum is 1 up to rounding.
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
