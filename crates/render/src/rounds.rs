//! Rendering in rounds: more samples for chosen pixels, merged exactly into what is there.

use std::time::Instant;

use noisefloor_frame::{Counts, Frame, Image, Samples, Sampling};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use crate::limits::LONGEST_SEQUENCE;
use crate::plan::{COLOR, Plan, WITH_ALL, WITH_BOTH, WITH_FEATURES, WITH_FLASH};
use crate::planes::Planes;
use crate::render::{Shot, Totals, blank, provenance};
use crate::tally::Tally;
use crate::{Keep, Progress, RenderError, RenderRequest};

/// What a pixel takes beside the frame that it ends in, in units of what the frame takes per value: 1952 bytes.
const PIXEL_VALUES: usize = 244;

/// Pixels in one piece of work.
const PIECE: usize = 64;

/// A frame in the making: the running statistics of every pixel, to which samples can be added where they are wanted.
///
/// Every pixel goes through its own samples in their order, whatever the rounds: after any rounds a pixel has the bits
/// that one run with its number of samples gives it, on any number of threads. Frames whose pixels differ in their
/// number of samples carry a map of it. A density that was made from the samples themselves biases their mean; this
/// type does not know where its numbers come from.
///
/// A pixel takes 208 bytes for the colour alone and 1216 with features and flash (1504 with all there is), and 56 to
/// 488 more for every doubling of its samples beyond 16.
#[derive(Debug)]
pub struct Rounds<'a> {
    request: RenderRequest<'a>,
    plan: Plan,
    pixels: Pixels,
    rounds: u32,
    seconds: f64,
    counts: Totals,
}

/// One pixel: its statistics, the material of its first sample, and the index after its last.
#[derive(Debug, Clone)]
struct Pixel<const C: usize> {
    tally: Tally<C>,
    material: i32,
    end: u32,
}

/// All pixels, by what is recorded.
#[derive(Debug)]
enum Pixels {
    Color(Vec<Pixel<COLOR>>),
    Features(Vec<Pixel<WITH_FEATURES>>),
    Flash(Vec<Pixel<WITH_FLASH>>),
    Both(Vec<Pixel<WITH_BOTH>>),
    /// The colour alone, of a scene that needs more than most.
    ExtraColor(Vec<Pixel<COLOR>>),
    All(Vec<Pixel<WITH_ALL>>),
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
        request.check_memory(plan.planes() + PIXEL_VALUES)?;
        let count = request.width * request.height;
        let first = request.sample_start;
        let pixels = match (plan.features, plan.flash) {
            _ if plan.extras && plan.features => Pixels::All(empty(count, first)),
            _ if plan.extras => Pixels::ExtraColor(empty(count, first)),
            (false, false) => Pixels::Color(empty(count, first)),
            (true, false) => Pixels::Features(empty(count, first)),
            (false, true) => Pixels::Flash(empty(count, first)),
            (true, true) => Pixels::Both(empty(count, first)),
        };
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
        let done = match &mut self.pixels {
            Pixels::Color(pixels) => {
                grow::<false, false, false, _>(pixels, &shot, &self.request, extra, progress)
            }
            Pixels::Features(pixels) => {
                grow::<true, false, false, _>(pixels, &shot, &self.request, extra, progress)
            }
            Pixels::Flash(pixels) => {
                grow::<false, true, false, _>(pixels, &shot, &self.request, extra, progress)
            }
            Pixels::Both(pixels) => {
                grow::<true, true, false, _>(pixels, &shot, &self.request, extra, progress)
            }
            Pixels::ExtraColor(pixels) => {
                grow::<false, false, true, _>(pixels, &shot, &self.request, extra, progress)
            }
            Pixels::All(pixels) => grow::<true, true, true, _>(pixels, &shot, &self.request, extra, progress),
        };
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
            && match (a.photons, b.photons) {
                (None, None) => true,
                (Some(a), Some(b)) => std::ptr::eq(a, b),
                _ => false,
            };
        if !same {
            let expected = "the same scene, size, random seed, depth, filter, sampling, integrator, photon maps and record".to_owned();
            return Err(wrong("range", "of another request".into(), expected));
        }
        let start = b.sample_start;
        if let Some((pixel, end)) = self.ends().iter().enumerate().find(|(_, end)| **end != start) {
            let expected = format!("{end}, where pixel {pixel} ends");
            return Err(wrong("sample_start", start.to_string(), expected));
        }
        match (&mut self.pixels, &next.pixels) {
            (Pixels::Color(a), Pixels::Color(b)) => join(a, b),
            (Pixels::Features(a), Pixels::Features(b)) => join(a, b),
            (Pixels::Flash(a), Pixels::Flash(b)) => join(a, b),
            (Pixels::Both(a), Pixels::Both(b)) => join(a, b),
            (Pixels::ExtraColor(a), Pixels::ExtraColor(b)) => join(a, b),
            (Pixels::All(a), Pixels::All(b)) => join(a, b),
            _ => unreachable!("equal records make equal plans"),
        }
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
        let planes = match &self.pixels {
            Pixels::Color(pixels) => planes(pixels, &self.plan),
            Pixels::Features(pixels) => planes(pixels, &self.plan),
            Pixels::Flash(pixels) => planes(pixels, &self.plan),
            Pixels::Both(pixels) => planes(pixels, &self.plan),
            Pixels::ExtraColor(pixels) => planes(pixels, &self.plan),
            Pixels::All(pixels) => planes(pixels, &self.plan),
        };
        let mut frame = blank(request, samples, request.sampling);
        self.plan.fill(&mut frame, planes, request.width, request.height)?;
        frame.provenance = provenance(request, self.seconds, &self.counts);
        frame.provenance.sampler = Some(crate::sampler::name(request.sampling).into());
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
        fn of<const C: usize>(pixels: &[Pixel<C>]) -> Vec<u32> {
            pixels.iter().map(|p| p.end).collect()
        }
        match &self.pixels {
            Pixels::Color(pixels) => of(pixels),
            Pixels::Features(pixels) => of(pixels),
            Pixels::Flash(pixels) => of(pixels),
            Pixels::Both(pixels) => of(pixels),
            Pixels::ExtraColor(pixels) => of(pixels),
            Pixels::All(pixels) => of(pixels),
        }
    }
}

fn wrong(parameter: &'static str, value: String, expected: String) -> RenderError {
    RenderError::InvalidRequest { parameter, value, expected }
}

fn empty<const C: usize>(count: usize, first: u32) -> Vec<Pixel<C>> {
    vec![Pixel { tally: Tally::new(), material: -1, end: first }; count]
}

fn grow<const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
    pixels: &mut [Pixel<C>],
    shot: &Shot<'_>,
    request: &RenderRequest<'_>,
    extra: &[u32],
    progress: &dyn Progress,
) -> Result<(), RenderError> {
    let stack = || request.scene.traversal();
    let pieces = pixels.par_chunks_mut(PIECE).zip(extra.par_chunks(PIECE)).enumerate();
    pieces.try_for_each_init(stack, |stack, (piece, (pixels, extra))| {
        for (k, (pixel, extra)) in pixels.iter_mut().zip(extra).enumerate() {
            if *extra == 0 {
                continue;
            }
            let at = piece * PIECE + k;
            let at = (at % request.width, at / request.width);
            let range = pixel.end..pixel.end + extra; // checked before any work
            let first = pixel.end == request.sample_start;
            let material =
                shot.samples::<FEATURES, FLASH, EXTRAS, C>(stack, &mut pixel.tally, at, range.clone());
            if first {
                pixel.material = material;
            }
            pixel.end = range.end;
        }
        match progress.advance(pixels.len()) {
            std::ops::ControlFlow::Continue(()) => Ok(()),
            std::ops::ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })
}

fn join<const C: usize>(pixels: &mut [Pixel<C>], next: &[Pixel<C>]) {
    pixels.par_iter_mut().zip(next).for_each(|(pixel, next)| {
        pixel.tally.append(&next.tally);
        pixel.end = next.end;
    });
}

fn planes<const C: usize>(pixels: &[Pixel<C>], plan: &Plan) -> Planes {
    let mut planes = vec![vec![0.0f32; pixels.len()]; plan.planes()];
    let mut values = vec![0.0f32; plan.planes()];
    for (at, pixel) in pixels.iter().enumerate() {
        // Reading the total ends the open block; the copy keeps this pixel's for the next round.
        plan.write(&mut pixel.tally.clone(), pixel.material, &mut values);
        for (plane, value) in planes.iter_mut().zip(&values) {
            plane[at] = *value;
        }
    }
    planes
}
