//! Looking inside the filter: how many pixels are homogeneous with each, and which ones for a chosen pixel.

use super::members::Tests;
use super::naive::Weights;
use super::volume::Volume;
use super::{FlashFilterError, FlashInputs, FlashParams};

/// The window around one pixel: who belongs to its set, and with what weight.
#[derive(Clone, Debug, PartialEq)]
pub struct HomogeneousWindow {
    /// Side of the window in pixels, 2r+1. The chosen pixel is in the middle.
    pub side: usize,
    /// Frames of the window in time order; 1 without neighbouring frames.
    pub frames: usize,
    /// Which of them is the chosen pixel's, from 0.
    pub target: usize,
    /// For each channel, frames·side·side flags, frame by frame in rows: whether that neighbour is in the set. False outside
    /// the image.
    pub member: [Vec<bool>; 3],
    /// For each channel, frames·side·side weights in that order, 0 to 1, not normalised. 0 for all that are not members.
    pub weight: [Vec<f32>; 3],
}

/// Number of homogeneous pixels |H(p)| of each pixel, itself included: 1 to (2r+1)² in every frame of the window.
///
/// Counts members of the set of `channel` (0 to 2); the three are equal unless the membership is
/// [`super::Membership::PerChannel`]. Weights play no part. Plain loops, meant for pictures rather than for speed.
///
/// # Errors
/// As [`FlashParams::check`], and [`FlashFilterError::Channel`].
pub fn homogeneous_counts(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    channel: usize,
) -> Result<Vec<u32>, FlashFilterError> {
    params.check(inputs)?;
    if channel > 2 {
        return Err(FlashFilterError::Channel { channel });
    }
    let volume = Volume::new(params, inputs);
    let tests = Tests::new(inputs, &volume);
    let (w, h, r) = (params.width, params.height, params.window_radius);
    let mut counts = Vec::with_capacity(w * h);
    for (py, px) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
        let columns = px.saturating_sub(r)..(px + r + 1).min(w);
        let rows = py.saturating_sub(r)..(py + r + 1).min(h);
        let area = rows.flat_map(|y| columns.clone().map(move |x| y * w + x));
        let members = |frame| area.clone().filter(|&q| tests.members(py * w + px, frame, q)[channel]).count();
        let members: usize = volume.window().map(|(_, frame)| members(frame)).sum();
        counts.push(members as u32);
    }
    Ok(counts)
}

/// The homogeneous set of pixel (`x`, `y`) and the weight of each member.
///
/// # Errors
/// As [`FlashParams::check`], and [`FlashFilterError::PixelOutside`].
pub fn homogeneous_window(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    x: usize,
    y: usize,
) -> Result<HomogeneousWindow, FlashFilterError> {
    params.check(inputs)?;
    let (w, h) = (params.width, params.height);
    if x >= w || y >= h {
        return Err(FlashFilterError::PixelOutside { x, y, width: w, height: h });
    }
    let volume = Volume::new(params, inputs);
    let tests = Tests::new(inputs, &volume);
    let frames: Vec<_> = volume.window().collect();
    let weights = Weights::<f64>::new(params, inputs);
    let r = params.window_radius as isize;
    let side = 2 * params.window_radius + 1;
    let mut window = HomogeneousWindow {
        side,
        frames: frames.len(),
        target: frames.iter().take_while(|(time, _)| *time < 0).count(),
        member: [(); 3].map(|()| vec![false; frames.len() * side * side]),
        weight: [(); 3].map(|()| vec![0.0; frames.len() * side * side]),
    };
    let area = (-r..=r).flat_map(|dy| (-r..=r).map(move |dx| (dy, dx)));
    for (i, &(time, frame)) in frames.iter().enumerate() {
        for (dy, dx) in area.clone() {
            let (qx, qy) = (x as isize + dx, y as isize + dy);
            if !(0..w as isize).contains(&qx) || !(0..h as isize).contains(&qy) {
                continue;
            }
            let members = tests.members(y * w + x, frame, qy as usize * w + qx as usize);
            let weight = weights.weight((x as isize, y as isize), (qx, qy, time)) as f32;
            let cell = (i * side + (dy + r) as usize) * side + (dx + r) as usize;
            for c in (0..3).filter(|&c| members[c]) {
                window.member[c][cell] = true;
                window.weight[c][cell] = weight;
            }
        }
    }
    Ok(window)
}
