//! One method on one frame, alone: refused, warmed up, timed, checked.

use std::time::Instant;

use noisefloor_denoiser::{DenoiseError, Diagnostic, Diagnostics, Input, Output, StageSeconds};
use noisefloor_frame::Finding;

use crate::fingerprint::attempt;
use crate::row::Row;
use noisefloor_questions::median;
use noisefloor_study::Timing;
use noisefloor_study::record::Outcome;

/// What a method gave, and how long it took.
pub(super) struct Denoised {
    /// Of the first run: all runs give the same bits.
    pub(super) output: Output,
    /// Median of the method's own seconds.
    pub(super) seconds: f64,
    /// Median of what was around them: starting a program and its files; none where all time is the method's.
    pub(super) around: Option<f64>,
    /// All timed runs in order.
    pub(super) runs: Vec<f64>,
    /// Stages of the run whose time is the median, or next below it.
    pub(super) stages: Vec<StageSeconds>,
    /// From a run of its own, which is not timed.
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// Runs a row on a checked frame and its neighbours; `findings` are those about the frame. `diagnostics` asks for
/// diagnostic images that probe this pixel, given in fractions of the image (`Some(None)`: where the method likes).
pub(super) fn denoise(
    row: &Row,
    input: Input<'_>,
    findings: &[Finding],
    timing: Timing,
    diagnostics: Option<Option<[f64; 2]>>,
) -> Result<Denoised, Outcome> {
    let frame = input.target;
    match input.check(&row.card) {
        Err(error @ DenoiseError::MissingInputs { .. }) => return Err(skipped(&error, findings)),
        Err(error) => return Err(Outcome::Failed { reason: error.to_string() }),
        Ok(()) => {}
    }
    let mut first = None;
    for _ in 0..timing.warmup {
        first = Some(once(row, &input)?);
    }
    let (mut timed, mut around) = (Vec::new(), Vec::new());
    for _ in 0..timing.runs.max(1) {
        let start = Instant::now();
        let output = once(row, &input)?;
        let wall = start.elapsed().as_secs_f64();
        // What a method says of itself, as far as it can be true.
        let own = output.seconds.filter(|own| (0.0..=wall).contains(own));
        around.extend(own.map(|own| wall - own));
        timed.push((own.unwrap_or(wall), output.stages.clone()));
        first.get_or_insert(output);
    }
    let around = median(around.into_iter());
    let runs: Vec<f64> = timed.iter().map(|(seconds, _)| *seconds).collect();
    timed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let seconds = median(runs.iter().copied()).unwrap_or(0.0); // at least one run
    let stages = timed.swap_remove((timed.len() - 1) / 2).1;
    let diagnostics = match diagnostics {
        Some(probe) => {
            let pixel = |at: f64, size: usize| ((at * size as f64) as usize).min(size - 1); // images are never empty
            let probe = probe.map(|[x, y]| (pixel(x, frame.width()), pixel(y, frame.height())));
            once(row, &input.with_diagnostics(Diagnostics::On { probe }))?.diagnostics
        }
        None => Vec::new(),
    };
    let output = first.ok_or_else(|| Outcome::Failed { reason: "it was never run".into() })?;
    Ok(Denoised { output, seconds, around, runs, stages, diagnostics })
}

/// What is missing, and why if that was found.
fn skipped(error: &DenoiseError, findings: &[Finding]) -> Outcome {
    let mut reason = error.to_string();
    for finding in error.because(findings) {
        reason.push_str(&format!(" ({})", finding.text));
    }
    Outcome::Skipped { reason }
}

/// Runs a method once. Errors and panics of a method end its cell, not the study.
fn once(row: &Row, input: &Input<'_>) -> Result<Output, Outcome> {
    let failed = |reason: String| Outcome::Failed { reason };
    let output = match attempt(|| row.method.denoiser.denoise(input)) {
        Ok(Ok(output)) => output,
        Ok(Err(error @ DenoiseError::MissingInputs { .. })) => {
            return Err(Outcome::Skipped { reason: error.to_string() });
        }
        Ok(Err(error)) => return Err(failed(error.to_string())),
        Err(panic) => return Err(failed(format!("{} panicked: {panic}", row.method.id))),
    };
    let target = &input.target.color.mean;
    if !output.image.same_shape(target) {
        return Err(failed(format!(
            "{} gave an image of {}×{}×{} for a frame of {}×{}×{}",
            row.method.id,
            output.image.width(),
            output.image.height(),
            output.image.channels(),
            target.width(),
            target.height(),
            target.channels()
        )));
    }
    if let Some(estimate) = output.error_estimate.as_ref().filter(|e| !e.same_shape(target)) {
        return Err(failed(format!(
            "{} gave an error estimate of {}×{}×{} for a frame of {}×{}×{}",
            row.method.id,
            estimate.width(),
            estimate.height(),
            estimate.channels(),
            target.width(),
            target.height(),
            target.channels()
        )));
    }
    if let Some((name, _)) = output.estimate_of.as_ref().filter(|(_, image)| !image.same_shape(target)) {
        return Err(failed(format!("{} gave `{name}` in another size than the frame's", row.method.id)));
    }
    if let Some(bound) = output.bounds.iter().find(|bound| !bound.half_width.same_shape(target)) {
        let name = &bound.name;
        return Err(failed(format!(
            "{} gave the bound `{name}` in another size than the frame's",
            row.method.id
        )));
    }
    Ok(output)
}
