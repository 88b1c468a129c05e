//! What the figures of the source work show: the flash image, the homogeneous set of one pixel and its weights (Fig. 5), the
//! result of the first step (Fig. 7).

use noisefloor_denoiser::{Output, Unit};
use noisefloor_frame::Image;
use noisefloor_kernels::flash_filter::{
    FlashFilterError, FlashInputs, FlashParams, homogeneous_counts, homogeneous_window,
};

/// Adds the number of homogeneous pixels of every pixel and the set of `probe` for one step.
pub(crate) fn describe_step(
    output: &mut Output,
    name: &str,
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    probe: (usize, usize),
) -> Result<(), FlashFilterError> {
    let (width, height) = (params.width, params.height);
    let counts = [0, 1, 2].map(|c| homogeneous_counts(params, inputs, c));
    let mut planes = Vec::with_capacity(3 * width * height);
    for counts in counts {
        planes.extend(counts?.into_iter().map(|n| n as f32));
    }
    let mean = planes.iter().copied().map(f64::from).sum::<f64>() / planes.len() as f64; // never empty
    output.figure(format!("mean number of homogeneous pixels, {name}"), Unit::Pixels, mean);
    let image = Image::from_vec(width, height, 3, planes).expect("three counts per pixel");
    output.diagnose(format!("homogeneous pixels, {name}"), Unit::Pixels, image);

    let window = homogeneous_window(params, inputs, probe.0, probe.1)?;
    // Frames one below the other in time order.
    let (side, rows) = (window.side, window.frames * window.side);
    let members = Image::from_fn(side, rows, 3, |c, x, y| f32::from(window.member[c][y * side + x]));
    let weights = Image::from_fn(side, rows, 3, |c, x, y| window.weight[c][y * side + x]);
    output.diagnose(format!("homogeneous set of the probe, {name}"), Unit::None, members);
    output.diagnose(format!("weights of the probe, {name}"), Unit::None, weights);
    Ok(())
}
