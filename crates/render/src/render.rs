//! One image at once.

use std::time::Instant;

use noisefloor_frame::{Counts, Estimate, Frame, Image, Reference, Samples, Sampling};

use crate::assemble::fill;
use crate::columns::COLOR;
use crate::film::{Extent, develop};
use crate::limits::LONGEST_SEQUENCE;
use crate::optional::{OptionalTally, Taps, put};
use crate::plan::Plan;
use crate::planes::Planes;
use crate::provenance::provenance;
use crate::shot::{Shot, Totals};
use crate::tally::{Summary, Tally};
use crate::worker::{Worker, worker};
use crate::{Keep, OptionalRecord, Progress, RenderError, RenderRequest};

/// Renders a frame on the threads of the current rayon pool. The result is the same, bit for bit, for any number of them.
///
/// Samples are accumulated in blocks of [`noisefloor_frame::BLOCK_SAMPLES`] that are merged in a fixed tree. With
/// low-discrepancy sampling, even and odd samples are points of two separately randomised sequences, and the variance is
/// s²/n all the same, which is not the variance of the mean there. Variances and halves are left out with one sample.
///
/// # Errors
/// [`RenderError::InvalidRequest`], [`RenderError::Unavailable`] and [`RenderError::Memory`] before any work;
/// [`RenderError::Cancelled`]; [`RenderError::NonFinite`] if most samples are not finite.
pub fn render(request: &RenderRequest<'_>, progress: &dyn Progress) -> Result<Frame, RenderError> {
    request.check()?;
    let limit = if request.spp >= 2 { Keep::ALL } else { Keep::MEAN };
    let plan = Plan::new(request, limit)?;
    request.check_memory(plan.planes())?;
    let start = Instant::now();
    let counts = Totals::default();
    let shot = Shot::new(request, &plan, &counts);
    let taps = Taps::default();
    let mut images = frame_planes(&shot, &taps, progress)?.into_images();
    counts.check(request)?;
    let even = |end: u32| end.div_ceil(2);
    let end = request.sample_start + request.spp; // checked above
    let samples =
        Samples::uniform(request.spp).with_half_a(Counts::Uniform(even(end) - even(request.sample_start)));
    let mut frame = blank(request, samples, request.sampling);
    fill(&plan, &mut frame, &mut images)?;
    if let Some(wanted) = &plan.optional {
        let tapped = taps.into_tapped(request.width, request.sample_start);
        put(wanted, &mut frame, images, request.sample_start, &[end], tapped)?;
    }
    frame.provenance = provenance(request, request.sampling, start.elapsed().as_secs_f64(), &counts);
    Ok(frame)
}

/// Renders a reference: `request.spp` samples in all, split over `parts` separately randomised low-discrepancy sequences,
/// whatever `request.sampling` says. Of the recorded quantities only the means are kept, and no
/// optional statistics.
///
/// # Errors
/// Like [`render`]; [`RenderError::InvalidRequest`] also if there are fewer than [`Reference::LEAST_PARTS`] parts, if
/// `spp` is not a multiple of `parts`, if a part is longer than 65536, or if `sample_start` is not 0.
pub fn render_reference(
    request: &RenderRequest<'_>,
    parts: u32,
    progress: &dyn Progress,
) -> Result<Reference, RenderError> {
    let optional = OptionalRecord::default();
    let request = &RenderRequest { sampling: Sampling::Independent, optional, ..request.clone() };
    request.check()?;
    let wrong = |parameter, value: u32, expected: String| {
        Err(RenderError::InvalidRequest { parameter, value: value.to_string(), expected })
    };
    let least = Reference::LEAST_PARTS as u32;
    if parts < least {
        return wrong("parts", parts, format!("at least {least}"));
    }
    if !request.spp.is_multiple_of(parts) || request.spp / parts > LONGEST_SEQUENCE {
        let expected = format!("a multiple of the {parts} parts, at most 65536 each");
        return wrong("spp", request.spp, expected);
    }
    if request.sample_start != 0 {
        return wrong("sample_start", request.sample_start, "0 for a reference".into());
    }
    let plan = Plan::new(request, Keep::MEAN)?;
    request.check_memory(COLOR * parts as usize + plan.planes())?;
    let start = Instant::now();
    let counts = Totals::default();
    let shot = Shot::new(request, &plan, &counts);
    let mut planes = reference_planes(&shot, parts, progress)?.into_images();
    counts.check(request)?;
    let images = planes
        .by_ref()
        .take(parts as usize)
        .map(|part| Image::from_vec(request.width, request.height, COLOR, part))
        .collect::<Result<Vec<_>, _>>()?;
    let mut reference = Reference::from_parts(images, request.spp / parts, Sampling::LowDiscrepancy)?;
    let mut recorded = blank(request, Samples::uniform(request.spp), Sampling::LowDiscrepancy);
    fill(&plan, &mut recorded, &mut planes)?;
    reference.frame.features = recorded.features;
    reference.frame.flash = recorded.flash;
    reference.frame.provenance =
        provenance(request, Sampling::LowDiscrepancy, start.elapsed().as_secs_f64(), &counts);
    reference.frame.provenance.extra.insert("parts".into(), parts.to_string());
    Ok(reference)
}

/// A frame with a black colour, to be filled.
pub(crate) fn blank(request: &RenderRequest<'_>, samples: Samples, sampling: Sampling) -> Frame {
    Frame::from_color(Estimate::from_mean(Image::new(request.width, request.height, 3)), samples, sampling)
}

/// What a thread keeps from pixel to pixel.
struct Scratch<'a> {
    worker: Box<dyn Worker + 'a>,
    tally: Tally,
    summary: Summary,
}

impl<'a> Scratch<'a> {
    fn new(shot: &'a Shot<'a>, sampling: Sampling) -> Self {
        Self { worker: worker(shot, sampling), tally: shot.plan.tally(), summary: shot.plan.summary() }
    }
}

fn frame_planes(shot: &Shot<'_>, taps: &Taps, progress: &dyn Progress) -> Result<Planes, RenderError> {
    let Shot { request, plan, .. } = shot;
    let range = request.sample_start..request.sample_start + request.spp;
    let extent = Extent { width: request.width, height: request.height, samples: request.spp };
    let scratch = || Scratch::new(shot, request.sampling);
    develop(extent, &plan.images, progress, scratch, |scratch, pixel, strip, at| {
        let Scratch { worker, tally, summary } = scratch;
        tally.clear();
        worker.add(tally, pixel, None, range.clone());
        if plan.optional.as_ref().is_some_and(|wanted| wanted.taps(pixel)) {
            taps.put(pixel, tally.optional().map_or(&[], OptionalTally::tapped));
        }
        plan.write(tally, summary, strip.pixel(at));
    })
}

/// Colour means of the parts, then the means over all parts.
fn reference_planes(shot: &Shot<'_>, parts: u32, progress: &dyn Progress) -> Result<Planes, RenderError> {
    let Shot { request, plan, .. } = shot;
    let images: Vec<usize> = std::iter::repeat_n(COLOR, parts as usize).chain(plan.images.clone()).collect();
    let extent = Extent { width: request.width, height: request.height, samples: request.spp };
    let scratch = || (Scratch::new(shot, Sampling::LowDiscrepancy), plan.tally());
    develop(extent, &images, progress, scratch, |(scratch, all), pixel, strip, at| {
        let Scratch { worker, tally, summary } = scratch;
        let mut out = strip.pixel(at);
        all.clear();
        for part in 0..parts {
            tally.clear();
            worker.add(tally, pixel, Some(part), 0..request.spp / parts);
            tally.summarise(summary);
            let means = plan.means(summary);
            // In this order: the other one would take a plane too many.
            for (mean, out) in means[..COLOR].iter().zip(&mut out) {
                *out = *mean;
            }
            // Parts have equal sample counts: the mean over all samples is the mean of their means.
            all.extend(part, &means);
        }
        plan.write(all, summary, out);
    })
}
