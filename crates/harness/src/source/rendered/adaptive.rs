//! Frames in rounds: samples where a method asks for them.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use noisefloor_denoiser::{Adaptive, Input};
use noisefloor_frame::{Frame, RoundsTaken};
use noisefloor_render::{RenderRequest, Rounds, allocate};

use super::progress::{advance, stopped};
use crate::error::HarnessError;
use crate::observer::Observer;
use noisefloor_study::AdaptiveFrames;

/// Renders level `spp` for the row `label`: a uniform round, then rounds whose samples go where the method wants them
/// after what it has seen so far.
pub(super) fn render(
    request: &RenderRequest<'_>,
    adaptive: AdaptiveFrames,
    (spp, label): (u32, &str),
    method: Option<&dyn Adaptive>,
    observer: &dyn Observer,
) -> Result<Frame, HarnessError> {
    let failed = |reason: String| HarnessError::Density { label: label.to_owned(), reason };
    let method = method.ok_or_else(|| failed("the method has none".into()))?;
    let start = Instant::now();
    let mut density_seconds = 0.0;
    let pixels = (request.width * request.height) as u64;
    // Some progress calls are for pixels without a sample: the sum is told when a round is done.
    let progress = |_: usize| advance(observer, 0);
    let first = RenderRequest { spp: adaptive.first(spp), ..request.clone() };
    let mut rounds = Rounds::start(&first, &progress).map_err(stopped)?;
    let _ = advance(observer, u64::from(first.spp) * pixels);
    for budget in adaptive.budgets(spp, pixels) {
        let mut so_far = rounds.frame()?;
        let looking = Instant::now();
        so_far.sanitize().map_err(|e| failed(e.to_string()))?;
        // The method's state is not touched again after a panic unless by another cell, which fails on its own.
        let density = catch_unwind(AssertUnwindSafe(|| method.density(&Input::new(&so_far))));
        let density =
            density.map_err(|_| failed("the method panicked".into()))?.map_err(|e| failed(e.to_string()))?;
        density_seconds += looking.elapsed().as_secs_f64();
        let density: Vec<f64> = density.data().iter().copied().map(f64::from).collect();
        if density.len() as u64 != pixels {
            return Err(failed(format!("{} numbers for {pixels} pixels", density.len())));
        }
        // A pixel's share is limited to a multiple of the average, so that no outlier takes the round.
        let most = (u64::from(adaptive.most) * budget).div_ceil(pixels).max(1);
        let most = u32::try_from(most).unwrap_or(u32::MAX);
        let extra = allocate(&density, budget, 0..=most).map_err(|e| failed(e.to_string()))?;
        rounds.add(&extra, &progress).map_err(stopped)?;
        let _ = advance(observer, budget);
    }
    let mut frame = rounds.frame()?;
    frame.provenance.render_seconds = Some(start.elapsed().as_secs_f64());
    frame.provenance.render_threads.get_or_insert(rayon::current_num_threads() as u32);
    frame.provenance.rounds =
        Some(RoundsTaken { count: adaptive.rounds, density_seconds: Some(density_seconds) });
    Ok(frame)
}
