//! The three candidate filters, in one sweep over the window (Alg. 1, lines 9-14; Sec. 6): each is Eq. 1 with the smaller of
//! both weights, Eq. 4.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::nlm::{NlmInputs, NlmParams, Pass, Perturbation, Planes, filter};
use noisefloor_toolbox::mean_of_halves;

use crate::kernel;
use crate::prepare::Prepared;
use crate::selection::Choice;
use crate::settings::{FLOOR, LOW_FLOOR, Settings};
use crate::sure::sure;

/// Step of the finite difference over the value: δ/u of Sec. 6, below Eq. 5.
const STEP: f32 = 0.01;
/// Values below this fraction of the image's median luminance get the derivative for fixed weights. Ours: the text divides by
/// whatever δ is, even by 0.
const SMALL: f32 = 1e-6;

/// What one candidate gives.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// Both halves, where [`Wanted::halves`] asks for them.
    pub halves: Option<[Image; 2]>,
    pub mean: Image,
    /// dF/du per channel.
    pub derivative: Image,
    /// Estimated squared error per channel.
    pub sure: Image,
    /// Σ w, one plane.
    pub weight_sum: Image,
    /// Σ w·n, one plane: samples that contribute, where [`Wanted::counts`] asks for them.
    pub contributing: Option<Image>,
    /// w(p,p)/Σ w, one plane.
    pub center_share: Image,
}

impl Candidate {
    /// Σ w·n, of candidates that were asked for it.
    pub fn contributing(&self) -> &Image {
        self.contributing.as_ref().expect("densities want counts")
    }
}

/// What candidates are to filter beside what every use needs: each plane costs time in every pair of pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted {
    /// The halves, for a second pass, in place of the mean.
    pub halves: bool,
    /// The samples, for a density.
    pub counts: bool,
}

/// Runs the candidates of `which` on `target`, with windows that also take in `beside` (Sec. 8).
pub(crate) fn candidates(
    method: &str,
    target: &Prepared<'_>,
    beside: &[Prepared<'_>],
    which: &[Choice],
    wanted: Wanted,
    settings: &Settings,
) -> Result<Vec<Candidate>, DenoiseError> {
    let frame = target.frame;
    let (width, height) = (frame.width(), frame.height());
    let params = NlmParams {
        rules: settings.candidate_rules(),
        ..target.engine(settings, settings.radius, settings.color_k)
    };
    // k_c, k_f and r = R are the same for all, but for k_c = ∞ of THIRD: no patch.
    let pass = |choice: &Choice| match choice {
        // Parameters: Alg. 1, line 9; the filter: Alg. 1, line 10.
        Choice::First => Pass { patch: Some(1), floor: FLOOR, derivative: true },
        // Parameters: Alg. 1, line 11; the filter: Alg. 1, line 12.
        Choice::Second => Pass { patch: Some(3), floor: FLOOR, derivative: true },
        // Parameters: Alg. 1, line 13; the filter: Alg. 1, line 14.
        Choice::Third => Pass { patch: None, floor: LOW_FLOOR, derivative: true },
    };
    let passes: Vec<Pass> = which.iter().map(pass).collect();
    let steps = steps(&frame.color.mean);
    let counts: Vec<Image> = std::iter::once(target).chain(beside).map(|p| counts(p.frame)).collect();
    let inputs = NlmInputs {
        frame: planes(target, &counts[0], wanted),
        neighbors: beside.iter().zip(&counts[1..]).map(|(p, counts)| planes(p, counts, wanted)).collect(),
        perturbation: Some(Perturbation { step: [0, 1, 2].map(|c| steps.plane(c)), rule: settings.rule }),
    };
    let filtered = filter(&params, &passes, &inputs).map_err(|e| kernel::kernel_error(method, &e))?;
    Ok(filtered
        .into_iter()
        .map(|f| {
            let (color, counts) = f.planes.split_at(if wanted.halves { 6 } else { 3 });
            let halves = wanted.halves.then(|| kernel::halves(color, width, height));
            let mean = match &halves {
                Some(halves) => mean_of_halves(halves, &frame.samples),
                None => kernel::image(color, width, height),
            };
            let derivative = plausible(kernel::image(&f.derivative, width, height), &f.center_share);
            let sure = sure(&mean, &frame.color.mean, &target.variance, &derivative);
            let contributing = counts.first().map(|counts| {
                let sums = counts.iter().zip(&f.weight_sum).map(|(n, w)| n * w).collect();
                kernel::image(&[sums], width, height)
            });
            Candidate {
                sure,
                halves,
                mean,
                derivative,
                contributing,
                weight_sum: kernel::image(&[f.weight_sum], width, height),
                center_share: kernel::image(&[f.center_share], width, height),
            }
        })
        .collect())
}

/// The frame's planes with those to filter.
fn planes<'a>(prepared: &'a Prepared<'_>, counts: &'a Image, wanted: Wanted) -> Planes<'a> {
    let mut targets = if wanted.halves {
        kernel::half_planes(prepared.halves)
    } else {
        prepared.frame.color.mean.planes().collect()
    };
    if wanted.counts {
        targets.push(counts.plane(0));
    }
    prepared.planes(targets)
}

/// δ of the finite difference (Sec. 6), 0 where the pixel gets the derivative for fixed weights: where a channel is not
/// positive or next to nothing.
pub(crate) fn steps(color: &Image) -> Image {
    let least = SMALL * color.median_luminance().unwrap_or(0.0);
    let mut out = color.map(|v| STEP * v);
    for p in 0..color.pixels() {
        let fine = |v: f32| v > 0.0 && v >= least;
        if !color.planes().all(|plane| fine(plane[p])) {
            out.planes_mut().for_each(|plane| plane[p] = 0.0);
        }
    }
    out
}

/// The derivative where it is between 0 and 1 in all channels, and elsewhere that for fixed weights, w(p,p)/Σ w. A mean
/// neither moves against one of its values nor by more than it; a quotient that says so has met the end of a weight.
/// The text says nothing of it, the authors' program does this.
pub(crate) fn plausible(mut derivative: Image, center_share: &[f32]) -> Image {
    for (p, share) in center_share.iter().enumerate() {
        // A NaN is in no range.
        if !derivative.planes().all(|plane| (0.0..=1.0).contains(&plane[p])) {
            derivative.planes_mut().for_each(|plane| plane[p] = *share);
        }
    }
    derivative
}

/// Samples of every pixel, one plane.
fn counts(frame: &Frame) -> Image {
    Image::from_fn(frame.width(), frame.height(), 1, |_, x, y| frame.samples.at(y * frame.width() + x) as f32)
}
