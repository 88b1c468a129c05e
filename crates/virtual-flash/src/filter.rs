//! One filter step over homogeneous pixels (Sec. 3.2 and 3.3; Sec. 4 in a volume of frames), by the kernel [`noisefloor_kernels::flash_filter`].
//!
//! D_p = Σ w·x̄_q / Σ w over q in H(Ω_p), weights g_s by distance and g_r by likeness of patches (Eq. 1). Divided by their sum
//! k(p) the weights are not negative and add up to 1, which is all that the proof asks of them (App. A, Eq. 5).

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::flash_filter::{
    self, FlashFilterError, FlashInputs, FlashParams, Neighbor, PatchWeights,
};

use crate::card::ID;
use crate::guide::Guide;
use crate::params::Step;
use crate::spread::Along;
use crate::tolerance::Tolerance;

/// Ω_p, σ_s and u(F_p) of a step, for the kernel.
pub(crate) fn kernel_params(frame: &Frame, step: &Step, patch: &PatchWeights) -> FlashParams {
    FlashParams {
        width: frame.width(),
        height: frame.height(),
        window_radius: step.window_radius,
        spatial_sigma: step.spatial_sigma,
        patch: *patch,
    }
}

/// N, F and what is carried along of every frame of a volume (Sec. 4), in time order, for the kernel.
pub(crate) fn planes<'a>(
    sources: impl IntoIterator<Item = &'a Image>,
    guides: &'a [Guide],
    along: &'a [Along<'_>],
) -> Vec<Neighbor<'a>> {
    let frames = sources.into_iter().enumerate().map(|(at, source)| Neighbor {
        source: [0, 1, 2].map(|c| source.plane(c)),
        guide: guides.get(at).map(|guide| flash_filter::Guide {
            planes: [0, 1, 2].map(|c| guide.image.plane(c)),
            sigma_r2: &guide.sigma_r2,
        }),
        carried: along.get(at).map(Along::planes),
    });
    frames.collect()
}

/// The frame at `at`, at most `neighbors` frames on each side of it, and the half-widths that make H(Ω_p), for the kernel.
pub(crate) fn inputs<'a>(
    frames: &'a [Neighbor<'a>],
    at: usize,
    neighbors: usize,
    tolerance: &'a Tolerance,
) -> FlashInputs<'a> {
    let (before, rest) = frames.split_at(at);
    let (target, after) = (rest[0], &rest[1..]);
    FlashInputs {
        source: target.source,
        membership: tolerance.membership(),
        guide: target.guide,
        before: &before[at.saturating_sub(neighbors)..],
        after: &after[..neighbors.min(after.len())],
    }
}

/// One step: the filtered image, and the sums of what it carries.
pub(crate) fn step(
    frame: &Frame,
    step: &Step,
    patch: &PatchWeights,
    inputs: &FlashInputs<'_>,
    along: Option<&Along<'_>>,
) -> Result<(Image, Option<Image>), DenoiseError> {
    let (params, level) = (kernel_params(frame, step, patch), InstructionSet::in_use());
    let mut image = Image::new(frame.width(), frame.height(), 3);
    let Some(along) = along else {
        flash_filter::filter_into(&params, inputs, level, planes_mut(&mut image)).map_err(kernel_error)?;
        return Ok((image, None));
    };
    let mut sums = Image::new(frame.width(), frame.height(), 3);
    let out = [planes_mut(&mut image), planes_mut(&mut sums)];
    flash_filter::filter_carrying_into(&params, inputs, &along.carried(), level, out)
        .map_err(kernel_error)?;
    Ok((image, Some(sums)))
}

fn planes_mut(image: &mut Image) -> [&mut [f32]; 3] {
    let mut planes = image.planes_mut();
    [(); 3].map(|()| planes.next().expect("three channels"))
}

/// The kernel refuses what was checked before it ran; should it find more, its message is kept.
pub(crate) fn kernel_error(error: FlashFilterError) -> DenoiseError {
    DenoiseError::of_kernel(ID, &error)
}
