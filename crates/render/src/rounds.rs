//! Rendering in rounds: more samples for chosen pixels, merged exactly into what is there.

use std::time::Instant;

use noisefloor_frame::{Counts, Frame, Image, Samples, Sampling};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use crate::assemble::fill;
use crate::limits::LONGEST_SEQUENCE;
use crate::optional::{OptionalPlan, OptionalTally, Taps, put};
use crate::plan::Plan;
use crate::planes::{BYTES_PER_VALUE, Planes, Strip};
use crate::provenance::provenance;
use crate::render::blank;
use crate::shot::{Shot, Totals};
use crate::tally::Tally;
use crate::worker::worker;
use crate::{Keep, Progress, RenderError, RenderRequest};

/// Pixels in one piece of work.
const PIECE: usize = 64;

/// A frame in the making: the running statistics of every pixel, to which samples can be added where they are wanted.
///
/// Every pixel goes through its own samples in their order, whatever the rounds: after any rounds a pixel has the bits
/// that one run with its number of samples gives it, on any number of threads. Frames whose pixels differ in their
/// number of samples carry a map of it. A density that was made from the samples themselves biases their mean; this
/// type does not know where its numbers come from.
///
/// A pixel takes 240 bytes for the colour alone and 1124 with features and flash (1476 with all there is), and 72 to
/// 576 more for every doubling of its samples beyond 16; optional statistics take more, tapped samples 20 bytes each.
#[derive(Debug)]
pub struct Rounds<'a> {
    request: RenderRequest<'a>,
    plan: Plan,
    pixels: Vec<Pixel>,
    rounds: u32,
    seconds: f64,
    counts: Totals,
}

/// One pixel: its statistics, and the index after its last sample.
#[derive(Debug, Clone)]
struct Pixel {
    tally: Tally,
    end: u32,
}

impl<'a> Rounds<'a> {
    /// Renders the first round: `request.spp` samples in every pixel, at least 2 so that every pixel has a variance.
    ///
    /// # Errors
    /// Like [`crate::render`]; [`RenderError::InvalidRequest`] also for fewer than 2 samples.
    pub fn start(request: &RenderRequest<'a>, progress: &dyn Progress) -> Result<Self, RenderError> {
        request.check()?;
        if request.spp < 2 {
            return Err(wrong("spp", request.spp.to_string(), "at least 2 in the first round".into()));
        }
        let plan = Plan::new(request, Keep::ALL)?;
        // Beside the frame that they end in, in units of what it takes per value.
        let optional = plan.optional.as_ref().map_or(0, OptionalPlan::bytes);
        let pixel = (size_of::<Pixel>() + plan.tally().bytes() + optional).div_ceil(BYTES_PER_VALUE as usize);
        request.check_memory(plan.planes() + pixel)?;
        let count = request.width * request.height;
        let pixels = vec![Pixel { tally: plan.tally(), end: request.sample_start }; count];
        let mut rounds = Self {
            request: request.clone(),
            plan,
            pixels,
            rounds: 0,
            seconds: 0.0,
            counts: Totals::default(),
        };
        rounds.add(&vec![request.spp; count], progress)?;
        Ok(rounds)
    }

    /// Adds `extra[p]` samples to pixel `p`, row by row. See [`crate::allocate`] for numbers from a density.
    ///
    /// # Errors
    /// [`RenderError::InvalidRequest`] before any work if there is not one number per pixel, or if a pixel would get more
    /// samples than its sequence has. After [`RenderError::Cancelled`] some pixels have their new samples and some have
    /// not; every one is whole, and the frame is usable.
    pub fn add(&mut self, extra: &[u32], progress: &dyn Progress) -> Result<(), RenderError> {
        let ends = self.ends();
        if extra.len() != ends.len() {
            let expected = format!("{}, one per pixel", ends.len());
            return Err(wrong("extra", format!("{} numbers", extra.len()), expected));
        }
        // Even and odd samples are points of two sequences.
        let low_discrepancy = self.request.sampling == Sampling::LowDiscrepancy;
        let longest = if low_discrepancy { 2 * LONGEST_SEQUENCE } else { u32::MAX };
        for (pixel, (end, extra)) in ends.iter().zip(extra).enumerate() {
            if end.checked_add(*extra).is_none_or(|sum| sum > longest) {
                let at = format!("{end} + {extra} in pixel {pixel}");
                return Err(wrong("sample_start + samples", at, format!("at most {longest}")));
            }
        }
        let start = Instant::now();
        let counts = Totals::default();
        let shot = Shot::new(&self.request, &self.plan, &counts);
        let done = grow(&mut self.pixels, &shot, extra, progress);
        self.rounds += 1;
        self.seconds += start.elapsed().as_secs_f64();
        self.counts.add(&counts);
        done
    }

    /// Appends a range of samples that was rendered apart: the same scene and request, and in every pixel it starts
    /// where this one ends. Four ranges of equal length that are multiples of [`noisefloor_frame::BLOCK_SAMPLES`],
    /// appended in their order, have the mean and variance of one run bit for bit if the length is a power of two;
    /// other ranges, and half buffers always, agree to the rounding of `f64`.
    ///
    /// # Errors
    /// [`RenderError::InvalidRequest`] if the requests differ or a pixel does not continue; then nothing changes.
    pub fn append(&mut self, next: &Self) -> Result<(), RenderError> {
        let (a, b) = (&self.request, &next.request);
        let same = std::ptr::eq(a.scene, b.scene)
            && (a.width, a.height, a.seed, a.depth) == (b.width, b.height, b.seed, b.depth)
            && (a.filter, a.sampling) == (b.filter, b.sampling)
            && (&a.record, a.feature_hit, a.integrator) == (&b.record, b.feature_hit, b.integrator)
            && a.optional == b.optional
            && match (a.photons, b.photons) {
                (None, None) => true,
                (Some(a), Some(b)) => std::ptr::eq(a, b),
                _ => false,
            };
        if !same {
            let expected = "the same scene, size, random seed, depth, filter, sampling, integrator, photon maps, record and optional statistics".to_owned();
            return Err(wrong("range", "of another request".into(), expected));
        }
        let start = b.sample_start;
        if let Some((pixel, end)) = self.ends().iter().enumerate().find(|(_, end)| **end != start) {
            let expected = format!("{end}, where pixel {pixel} ends");
            return Err(wrong("sample_start", start.to_string(), expected));
        }
        self.pixels.par_iter_mut().zip(&next.pixels).for_each(|(pixel, next)| {
            pixel.tally.append(&next.tally);
            pixel.end = next.end;
        });
        self.rounds += next.rounds;
        self.seconds += next.seconds;
        self.counts.add(&next.counts);
        Ok(())
    }

    /// Samples of every pixel so far, row by row.
    #[must_use]
    pub fn counts(&self) -> Vec<u32> {
        self.ends().iter().map(|end| end - self.request.sample_start).collect()
    }

    /// The frame so far; sampling may go on afterwards.
    ///
    /// # Errors
    /// [`RenderError::Frame`] if the buffers do not fit together, which would be a mistake in this crate.
    pub fn frame(&self) -> Result<Frame, RenderError> {
        let (request, first) = (&self.request, self.request.sample_start);
        let counts = self.counts();
        let in_a = |end: u32| end.div_ceil(2) - first.div_ceil(2);
        let samples = match Counts::PerPixel(counts.clone()).uniform() {
            Some(n) => Samples::uniform(n).with_half_a(Counts::Uniform(in_a(first + n))),
            None => {
                let half_a = self.ends().into_iter().map(in_a).collect();
                Samples::per_pixel(counts).with_half_a(Counts::PerPixel(half_a))
            }
        };
        let planes = Planes::zeros(request.width, request.height, &self.plan.images)?;
        let (mut strip, mut summary) = (Strip::new(PIECE, &self.plan.images), self.plan.summary());
        for (piece, pixels) in self.pixels.chunks(PIECE).enumerate() {
            for (at, pixel) in pixels.iter().enumerate() {
                self.plan.write(&pixel.tally, &mut summary, strip.pixel(at));
            }
            planes.write(&strip, piece * PIECE, pixels.len());
        }
        let mut frame = blank(request, samples, request.sampling);
        let mut images = planes.into_images();
        fill(&self.plan, &mut frame, &mut images)?;
        if let Some(wanted) = &self.plan.optional {
            let taps = Taps::default();
            for (at, pixel) in self.pixels.iter().enumerate().filter(|(at, _)| wanted.taps(*at)) {
                taps.put(at, pixel.tally.optional().map_or(&[], OptionalTally::tapped));
            }
            let tapped = taps.into_tapped(request.width, first);
            put(wanted, &mut frame, images, first, &self.ends(), tapped)?;
        }
        frame.provenance = provenance(request, request.sampling, self.seconds, &self.counts);
        frame.provenance.extra.insert("rounds".into(), self.rounds.to_string());
        Ok(frame)
    }

    /// Samples of every pixel as an image of one channel: the map that adaptive sampling shows.
    ///
    /// # Errors
    /// As [`Rounds::frame`].
    pub fn density(&self) -> Result<Image, RenderError> {
        let values = self.counts().into_iter().map(|n| n as f32).collect();
        Ok(Image::from_vec(self.request.width, self.request.height, 1, values)?)
    }

    /// The index after the last sample of every pixel.
    fn ends(&self) -> Vec<u32> {
        self.pixels.iter().map(|pixel| pixel.end).collect()
    }
}

fn wrong(parameter: &'static str, value: String, expected: String) -> RenderError {
    RenderError::InvalidRequest { parameter, value, expected }
}

fn grow(
    pixels: &mut [Pixel],
    shot: &Shot<'_>,
    extra: &[u32],
    progress: &dyn Progress,
) -> Result<(), RenderError> {
    let worker = || worker(shot, shot.request.sampling);
    let pieces = pixels.par_chunks_mut(PIECE).zip(extra.par_chunks(PIECE)).enumerate();
    pieces.try_for_each_init(worker, |worker, (piece, (pixels, extra))| {
        for (k, (pixel, extra)) in pixels.iter_mut().zip(extra).enumerate() {
            if *extra == 0 {
                continue;
            }
            let range = pixel.end..pixel.end + extra; // checked before any work
            worker.add(&mut pixel.tally, piece * PIECE + k, None, range.clone());
            pixel.end = range.end;
        }
        match progress.advance(pixels.len()) {
            std::ops::ControlFlow::Continue(()) => Ok(()),
            std::ops::ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })
}
