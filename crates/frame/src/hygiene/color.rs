//! The colour and its statistics.

use crate::{Estimate, Finding, FindingKind, FrameError, Samples, Variance};

use super::fill::Rings;
use super::{DEEPEST_FILL, Hygiene, halves, invalid_pixels, share_too_large, variance};

/// Layer name of the colour in findings: none, as a frame is first of all its colour.
const COLOR: &str = "";

pub(super) fn clean(color: &mut Estimate, samples: &Samples, report: &mut Hygiene) -> Result<(), FrameError> {
    let invalid = invalid_pixels(&color.mean);
    let pixels = invalid.len();
    let width = color.mean.width();
    let rings = Rings::new(width, &invalid).ok_or(FrameError::NoValidPixel { pixels })?;
    report.invalid_pixels = invalid.iter().filter(|&&bad| bad).count();
    let of_half_file = crate::inspect::Precision::of(color.mean.data()).is_half();
    if report.invalid_pixels > 0 {
        let read = |p: usize| [0, 1, 2].map(|c| color.mean.plane(c)[p]); // a frame's colour has three channels
        report.as_read = (0..pixels).filter(|&p| invalid[p]).map(read).collect();
        color.mean.planes_mut().for_each(|plane| rings.fill(plane));
        tell_invalid(&rings, &invalid, report);
    }
    if let Some(stated) = color.variance.take() {
        let mut image = stated.into_mean_variance();
        let kept = variance::clean(COLOR, &mut image, &invalid, of_half_file, report);
        if let Some(unknown) = kept {
            report.unknown = if unknown.contains(&true) { unknown } else { Vec::new() };
            color.variance = Some(Variance::of_mean(image));
        }
    }
    if !halves::clean(COLOR, color, &invalid, samples, report) {
        color.halves = None;
    }
    for half in color.halves.iter_mut().flatten() {
        half.planes_mut().for_each(|plane| rings.fill(plane));
    }
    report.invalid = if report.invalid_pixels > 0 { invalid } else { Vec::new() };
    Ok(())
}

fn tell_invalid(rings: &Rings, invalid: &[bool], report: &mut Hygiene) {
    let (count, pixels) = (report.invalid_pixels, invalid.len());
    let many = share_too_large(count, pixels);
    let absent: Vec<bool> =
        rings.distance().iter().map(|&d| if many { d > 0 } else { d > DEEPEST_FILL }).collect();
    report.absent_pixels = absent.iter().filter(|&&flag| flag).count();
    let done = match report.absent_pixels {
        0 => "filled from their neighbours for methods, and in no number".to_owned(),
        all if all == count => "no part of the image".to_owned(),
        some => {
            format!("filled from their neighbours, {some} of them no part of the image, and in no number")
        }
    };
    report.absent = if report.absent_pixels > 0 { absent } else { Vec::new() };
    let text = format!("{count} of {pixels} pixels have a colour that is not finite: {done}");
    report.findings.push(Finding::new(FindingKind::InvalidPixels, COLOR, text).with_value(count as f64));
}
