//! Moon et al. 2013 in its order.
//!
//! | source | what | file |
//! |---|---|---|
//! | Sec. 3.1 | flash image from two parts of the light, and its intensity | `flash.rs` |
//! | Sec. 3.2, Eq. 1 | mean with weights by distance and by likeness of the flash image | `filter.rs`, for the kernel |
//! | Sec. 3.3, Eq. 2 | homogeneous pixels | `tolerance.rs`, half-widths of the test |
//! | Sec. 3.4, Theorem 3.1 | bound of the error | `card.rs` |
//! | Sec. 3.5 | two steps, and what each tests with | `spread.rs` |
//! | Sec. 4 | widths of both Gaussians | `guide.rs`, that of the likeness |
//! | Sec. 4 | frames of an animation as a volume | `volume.rs` |
//! | App. A, Eq. 3 | the interval of the truth | `tolerance.rs` |
//! | App. A, Eq. 4 | what the means of homogeneous pixels lie between | `tolerance.rs` |
//! | App. A, Eq. 5 | the output as a mean of them | `filter.rs` |
//! | App. A, Eq. 6 | so it lies there too | `card.rs` |
//! | App. A, Eq. 7 | and is not far from the truth | `card.rs` |

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::Image;
use noisefloor_kernels::flash_filter::PatchWeights;

use crate::Params;
use crate::card::ID;
use crate::filter::{self, inputs};
use crate::guide::Guide;
use crate::params::Step;
use crate::spread::{Along, tested_variance};
use crate::tolerance::Tolerance;
use crate::volume::Volume;

/// The output, and what it came from.
#[derive(Debug)]
pub(crate) struct Done {
    pub image: Image,
    /// One for each frame, or none.
    pub guides: Vec<Guide>,
    /// Half-widths of the target's test in the first step.
    pub first: Tolerance,
    /// What the second step filters, of every frame, and the half-widths of its test.
    pub second: Option<(Vec<Image>, Tolerance)>,
}

/// Filters the target of a checked volume with one or two steps.
pub(crate) fn denoise(
    volume: &Volume<'_>,
    params: &Params,
    steps: &[Step],
    patch: &PatchWeights,
    timer: &mut StageTimer,
) -> Result<Done, DenoiseError> {
    // Sec. 4, denoising animations: what is said of one image below is done with a volume of frames, each with its own N and F.
    let (frames, target, frame) = (&volume.frames, volume.target, volume.target());
    // Sec. 3.1: the virtual flash image F, or what stands for it; Sec. 4: σ_r of its range weights, from its noise.
    let guides = Guide::of_frames(frames, params, patch);
    for guide in &guides {
        DenoiseError::refuse(ID, "guide image is not finite", &guide.image, |v| v.is_finite())?;
    }
    timer.finish("guide");

    // Sec. 3.3: x̄_p and n_p are the frame's, and s_p/√n_p is the root of the variance of its mean.
    let tested: Vec<_> = frames.iter().map(|frame| tested_variance(frame, params)).collect();
    let spreads = frames.iter().zip(&tested);
    let along: Vec<Along<'_>> =
        spreads.filter_map(|(frame, tested)| Along::new(frame, params, tested.as_deref())).collect();
    for along in &along {
        if let Along::Variances(variance) = along {
            DenoiseError::refuse(ID, "variance is negative or not finite", variance, |v| {
                (0.0..=f32::MAX).contains(&v)
            })?;
        }
    }
    let raw = |at: usize| tested[at].as_deref().cloned();
    // Eq. 2: H(Ω_p) holds the pixels whose means are within t·s_p/√n_p of that of p.
    let interval =
        |variance, at: usize, step: &Step| Tolerance::new(params, variance, &frames[at].samples, step.level);

    // Sec. 3.5, first step: a small window at a high level takes the worst of the noise. Eq. 1: mean of x̄ over H(Ω_p),
    // weighted by g_s and g_r.
    let step = &steps[0];
    let means = filter::planes(frames.iter().map(|frame| &frame.color.mean), &guides, &along);
    let first = interval(raw(target), target, step);
    let source = inputs(&means, target, volume.neighbors, &first);
    let (image, sums) = filter::step(frame, step, patch, &source, along.get(target))?;
    let Some(second) = steps.get(1) else {
        timer.finish(step.name);
        return Ok(Done { image, guides, first, second: None });
    };
    // The second compares results of the first, so every frame of its window has one, from as much of the volume as is there.
    let other = |at: usize| -> Result<Image, DenoiseError> {
        let interval = interval(raw(at), at, step);
        let source = inputs(&means, at, volume.neighbors, &interval);
        Ok(filter::step(frames[at], step, patch, &source, None)?.0)
    };
    let mut images = (0..target).map(other).collect::<Result<Vec<_>, _>>()?;
    images.push(image);
    for at in target + 1..frames.len() {
        images.push(other(at)?);
    }
    timer.finish(step.name);

    // Sec. 3.5, second step: Eq. 2 and Eq. 1 again on what the first has made, with a large window at a lower level and the
    // same F. Which spread it tests with is ours, as the section does not say.
    let step = second;
    let variance = match (along.get(target), sums) {
        (Some(along), Some(sums)) => Some(along.variance(sums, params.second_spread, &frame.samples)),
        _ => raw(target),
    };
    let second = interval(variance, target, step);
    let results = filter::planes(&images, &guides, &[]);
    let source = inputs(&results, target, volume.neighbors, &second);
    let (output, _) = filter::step(frame, step, patch, &source, None)?;
    timer.finish(step.name);

    // Sec. 3.4: whatever the weights, Theorem 3.1 bounds the error of one step; `card.rs` says what is left of it for two.
    Ok(Done { image: output, guides, first, second: Some((images, second)) })
}
