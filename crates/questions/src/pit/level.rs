//! The transform of the green channel of a thinned set of pixels.

use noisefloor_frame::SquaredError;
use noisefloor_stats::{PitError, ecdf, pit};

use super::ID;
use super::answer::{Answer, POINTS};
use crate::answers;
use crate::cell::{Measure, MeasureError};
use crate::level::{LevelCell, LevelFound};

/// Samples of a reference over those of a level from which it passes for the truth.
const LONG: u64 = 256;
/// Most pixels: neighbours and channels depend on each other, and a band for very many values would reject every frame.
const MOST: usize = 1000;
/// Of the random numbers that stand for pixels without variance whose mean is right.
const SEED: u64 = 0x5EED_0F17;
/// Green.
const CHANNEL: usize = 1;

/// Where t-intervals mean anything and the truth is known well enough.
pub(super) fn measure(level: &LevelCell<'_>, found: &mut LevelFound) -> Result<(), MeasureError> {
    let truth = level.reference.mean();
    let exact = level.reference.squared_error() == SquaredError::Exact;
    let long = level.reference_spp >= LONG * u64::from(level.spp);
    if !(exact || long) || truth.channels() <= CHANNEL {
        return Ok(());
    }
    let chosen: Vec<usize> = thinned(truth.width(), truth.height())
        .into_iter()
        .map(|pixel| CHANNEL * truth.pixels() + pixel)
        .collect();
    let measures: Vec<Measure<'_>> = level.measures().collect();
    let mut answer = Answer::default();
    let mut sums = vec![0.0; POINTS];
    for (frame, measure) in level.frames.iter().zip(&measures) {
        let Some(observed) = measure.intervals() else { continue };
        let seed = SEED ^ (u64::from(frame.replicate) << 32);
        let transform = match pit(&observed, &measure.truth, &chosen, seed) {
            Ok(transform) => transform,
            Err(PitError::Shape(source)) => return Err(source.into()),
            // A frame of another size than the reference, which the shapes tell.
            Err(PitError::Index { .. }) => return Ok(()),
        };
        let Some(deviation) = transform.largest_deviation(POINTS) else { continue };
        sums.iter_mut().zip(ecdf(&transform.values, POINTS)).for_each(|(sum, f)| *sum += f);
        answer.replicates.push(frame.replicate);
        answer.values.push(transform.values.len() as u64);
        answer.deviation.push(deviation);
        answer.constant.push(transform.constant);
        answer.missed_above.push(transform.missed_above);
        answer.missed_below.push(transform.missed_below);
        answer.left_out.push(transform.left_out);
    }
    let count = answer.replicates.len() as f64;
    // To five digits, far below what a thousand values tell; without a replicate nothing is kept.
    answer.ecdf = sums.iter().map(|sum| (sum / count * 1e5).round() / 1e5).collect();
    if count > 0.0 {
        answers::keep(&mut found.answers, ID, &answer);
    }
    Ok(())
}

/// Pixels on a square grid, as dense as [`MOST`] of them allow, row by row.
fn thinned(width: usize, height: usize) -> Vec<usize> {
    let many = |step: usize| width.div_ceil(step) * height.div_ceil(step) > MOST;
    let mut step = 1;
    while many(step) {
        step += 1;
    }
    let rows = (0..height).step_by(step);
    rows.flat_map(|y| (0..width).step_by(step).map(move |x| y * width + x)).collect()
}

#[cfg(test)]
mod tests;
