//! What every output must be, whatever the frame.

use noisefloor_denoiser::{MethodCard, Output};
use noisefloor_frame::{Counts, Frame, Image};
use noisefloor_stats::{Observed, enclosure, half_widths};

use crate::Broken;

/// Shapes, finite values, and every enclosure that the card claims.
pub(super) fn examine(card: &MethodCard, frame: &Frame, output: &Output) -> Result<(), Broken> {
    let shape = |what: &str, image: &Image| {
        image.expect_shape(what, frame.width(), frame.height(), 3).map_err(Broken::Shape)
    };
    let values = |what: &str, image: &Image, how, good: fn(f32) -> bool| {
        let values = image.data().iter().filter(|value| !good(**value)).count();
        if values == 0 { Ok(()) } else { Err(Broken::Values { what: what.into(), values, how }) }
    };
    shape("output", &output.image)?;
    values("the output", &output.image, "not finite", f32::is_finite)?;
    if let Some(estimate) = &output.error_estimate {
        shape("error estimate", estimate)?;
        // An unbiased estimate of a square may be negative.
        values("the error estimate", estimate, "not finite", f32::is_finite)?;
    }
    if let Some((name, image)) = &output.estimate_of {
        shape(name, image)?;
        values(name, image, "not finite", f32::is_finite)?;
    }
    for bound in &output.bounds {
        shape(&bound.name, &bound.half_width)?;
        values(&bound.name, &bound.half_width, "no half-width", |v| v >= 0.0)?;
    }
    for diagnostic in &output.diagnostics {
        values(&diagnostic.name, &diagnostic.image, "not finite", f32::is_finite)?;
    }
    if let Some(figure) = output.figures.iter().find(|figure| !figure.value.is_finite()) {
        return Err(Broken::Values { what: figure.name.clone(), values: 1, how: "not finite" });
    }
    enclosed(card, frame, output)
}

/// |D−x̄| ≤ Σ factor·t·s/√n at every pixel and channel.
fn enclosed(card: &MethodCard, frame: &Frame, output: &Output) -> Result<(), Broken> {
    let Some(observed) = observed(frame) else { return Ok(()) };
    for claim in &card.claims.enclosure {
        // The shapes were checked.
        let widths = half_widths(&observed, &claim.terms);
        let found = widths.and_then(|widths| enclosure(output.image.data(), &widths, &observed));
        let Ok(found) = found else { continue };
        if !found.held {
            let (pixel, channel) = (found.worst_index % frame.pixels(), found.worst_index / frame.pixels());
            return Err(Broken::Enclosure {
                claim: claim.name.to_string(),
                ratio: found.worst_ratio,
                x: pixel % frame.width(),
                y: pixel / frame.width(),
                channel,
            });
        }
    }
    Ok(())
}

/// What intervals are made of; `None` without a variance.
pub(crate) fn observed(frame: &Frame) -> Option<Observed<'_>> {
    let counts = match frame.samples.total() {
        Counts::Uniform(n) => noisefloor_stats::SampleCounts::Uniform(*n),
        Counts::PerPixel(map) => noisefloor_stats::SampleCounts::PerPixel(map),
    };
    let variance = frame.color.variance.as_ref()?.mean_variance().data();
    let mean = frame.color.mean.data();
    Some(Observed { mean, variance, counts, pixels: frame.pixels(), valid: None })
}

/// Whether two outputs agree in every bit of what counts: image and estimate of its error.
pub(crate) fn same_bits(a: &Output, b: &Output) -> bool {
    let same = |a: &Image, b: &Image| {
        a.same_shape(b) && a.data().iter().zip(b.data()).all(|(a, b)| a.to_bits() == b.to_bits())
    };
    let estimates = match (&a.error_estimate, &b.error_estimate) {
        (Some(a), Some(b)) => same(a, b),
        (a, b) => a.is_none() && b.is_none(),
    };
    same(&a.image, &b.image) && estimates
}
