use std::panic::{AssertUnwindSafe, catch_unwind};

use noisefloor_denoiser::{DenoiseError, Denoiser, Diagnostics, Input, Output};
use noisefloor_frame::{Counts, Frame};
use noisefloor_stats::{Observed, enclosure, half_widths};

use crate::HardCase;

/// How a method came through a hard case.
#[derive(Debug, Clone, PartialEq)]
pub enum Survival {
    /// It gave a finite image.
    Finite,
    /// It refused with a typed error.
    Refused(DenoiseError),
}

/// Runs a method on a hard case and checks what every method must keep:
///
/// * no panic, and finite output of the frame's shape or a typed error;
/// * missing inputs are refused, and refused before anything else;
/// * the same bits when asked again, with and without diagnostics;
/// * every enclosure that the card claims holds at every pixel and channel.
///
/// # Errors
/// A sentence that names method and case and says what broke.
pub fn check_method(denoiser: &dyn Denoiser, case: &HardCase) -> Result<Survival, String> {
    let card = denoiser.card();
    let named = |what: String| format!("{} on \"{}\": {what}", card.id, case.name);
    let (frame, _) = case.frame();
    let run = |diagnostics| {
        let input = Input::new(&frame).with_diagnostics(diagnostics);
        catch_unwind(AssertUnwindSafe(|| denoiser.denoise(&input))).map_err(|panic| {
            let message = panic.downcast_ref::<String>().map(String::as_str);
            named(format!("panics: {}", message.or(panic.downcast_ref::<&str>().copied()).unwrap_or("?")))
        })
    };
    let missing = card.missing(&frame);
    let output = match run(Diagnostics::Off)? {
        Ok(_) if !missing.is_empty() => return Err(named("runs although inputs are missing".into())),
        Err(error @ DenoiseError::MissingInputs { .. }) if !missing.is_empty() => {
            return Ok(Survival::Refused(error));
        }
        Err(error) if !missing.is_empty() => {
            return Err(named(format!("inputs are missing, but the error is: {error}")));
        }
        Err(DenoiseError::MissingInputs { .. }) => return Err(named("refuses inputs that are there".into())),
        Err(error) => return Ok(Survival::Refused(error)),
        Ok(output) => output,
    };
    check_output(denoiser, &frame, &output).map_err(named)?;
    for diagnostics in [Diagnostics::Off, Diagnostics::On { probe: None }] {
        let again = run(diagnostics)?.map_err(|e| named(format!("second run fails: {e}")))?;
        if bits(&again) != bits(&output) {
            return Err(named(format!("second run ({diagnostics:?}) gives other bits")));
        }
    }
    Ok(Survival::Finite)
}

fn bits(output: &Output) -> Vec<u32> {
    output.image.data().iter().map(|v| v.to_bits()).collect()
}

fn check_output(denoiser: &dyn Denoiser, frame: &Frame, output: &Output) -> Result<(), String> {
    let (w, h) = (frame.width(), frame.height());
    output.image.expect_shape("output", w, h, 3).map_err(|e| e.to_string())?;
    let bad = output.image.count_non_finite();
    if bad > 0 {
        return Err(format!("{bad} output values are not finite"));
    }
    let Some(variance) = &frame.color.variance else { return Ok(()) };
    let counts = match frame.samples.total() {
        Counts::Uniform(n) => noisefloor_stats::Counts::Uniform(*n),
        Counts::PerPixel(map) => noisefloor_stats::Counts::PerPixel(map),
    };
    let observed = Observed {
        mean: frame.color.mean.data(),
        variance: variance.mean_variance().data(),
        counts,
        pixels: frame.pixels(),
        valid: None,
    };
    for claim in denoiser.card().claims.enclosure {
        let widths = half_widths(&observed, &claim.terms).map_err(|e| e.to_string())?;
        let found = enclosure(output.image.data(), &widths, &observed).map_err(|e| e.to_string())?;
        if !found.held {
            let (pixel, channel) = (found.worst_index % frame.pixels(), found.worst_index / frame.pixels());
            return Err(format!(
                "leaves the enclosure \"{}\" {}-fold at ({}, {}), channel {channel}",
                claim.name,
                found.worst_ratio,
                pixel % w,
                pixel / w
            ));
        }
    }
    Ok(())
}
