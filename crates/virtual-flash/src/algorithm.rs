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
//! | App. A, Eq. 3 | the interval of the truth | `tolerance.rs` |
//! | App. A, Eq. 4 | what the means of homogeneous pixels lie between | `tolerance.rs` |
//! | App. A, Eq. 5 | the output as a mean of them | `filter.rs` |
//! | App. A, Eq. 6 | so it lies there too | `card.rs` |
//! | App. A, Eq. 7 | and is not far from the truth | `card.rs` |

use noisefloor_denoiser::{DenoiseError, StageTimer};
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::flash_filter::PatchWeights;

use crate::Params;
use crate::card::ID;
use crate::filter::{self, inputs};
use crate::guide::Guide;
use crate::params::Step;
use crate::spread::{Along, tested_variance};
use crate::tolerance::Tolerance;

/// The output, and what it came from.
#[derive(Debug)]
pub(crate) struct Done {
    pub image: Image,
    pub guide: Option<Guide>,
    /// Half-widths of the test in the first step.
    pub first: Tolerance,
    /// What the second step filters, and the half-widths of its test.
    pub second: Option<(Image, Tolerance)>,
}

/// Filters a checked frame with one or two steps.
pub(crate) fn denoise(
    frame: &Frame,
    params: &Params,
    steps: &[Step],
    patch: &PatchWeights,
    timer: &mut StageTimer,
) -> Result<Done, DenoiseError> {
    // Sec. 3.1: the virtual flash image F, or what stands for it; Sec. 4: σ_r of its range weights, from its noise.
    let guide = Guide::new(frame, params, patch);
    if let Some(guide) = &guide {
        DenoiseError::refuse(ID, "guide image is not finite", &guide.image, |v| v.is_finite())?;
    }
    timer.finish("guide");

    // Sec. 3.3: x̄_p and n_p are the frame's, and s_p/√n_p is the root of the variance of its mean.
    let tested = tested_variance(frame, params);
    let along = Along::new(frame, params, tested.as_deref());
    if let Some(Along::Variances(variance)) = along {
        DenoiseError::refuse(ID, "variance is negative or not finite", variance, |v| {
            (0.0..=f32::MAX).contains(&v)
        })?;
    }
    let raw = || tested.as_deref().cloned();
    // Eq. 2: H(Ω_p) holds the pixels whose means are within t·s_p/√n_p of that of p.
    let interval = |variance, step: &Step| Tolerance::new(params, variance, &frame.samples, step.level);

    // Sec. 3.5, first step: a small window at a high level takes the worst of the noise. Eq. 1: mean of x̄ over H(Ω_p),
    // weighted by g_s and g_r.
    let step = &steps[0];
    let first = interval(raw(), step);
    let source = inputs(&frame.color.mean, guide.as_ref(), &first);
    let (image, sums) = filter::step(frame, step, patch, &source, along.as_ref())?;
    timer.finish(step.name);
    let Some(step) = steps.get(1) else {
        return Ok(Done { image, guide, first, second: None });
    };

    // Sec. 3.5, second step: Eq. 2 and Eq. 1 again on what the first has made, with a large window at a lower level and the
    // same F. Which spread it tests with is ours, as the section does not say.
    let variance = match (&along, sums) {
        (Some(along), Some(sums)) => Some(along.variance(sums, params.second_spread, &frame.samples)),
        _ => raw(),
    };
    let second = interval(variance, step);
    let (output, _) = filter::step(frame, step, patch, &inputs(&image, guide.as_ref(), &second), None)?;
    timer.finish(step.name);

    // Sec. 3.4: whatever the weights, Theorem 3.1 bounds the error of one step; `card.rs` says what is left of it for two.
    Ok(Done { image: output, guide, first, second: Some((image, second)) })
}
