//! Follows the samples of pixels: the code that is compiled for every kind of rendering, and the choice between them.

use std::ops::Range;

use glam::Vec4;
use noisefloor_frame::{BLOCK_SAMPLES, Block, Sampling};

use crate::FeatureHit;
use crate::bvh::Ray;
use crate::columns::COLOR;
use crate::intersect::Traversal;
use crate::limits::DEEPEST;
use crate::optional::{OptionalTally, Positions};
use crate::path::trace;
use crate::recorder::Recorder;
use crate::recording::Recording;
use crate::sampler::{Sampler, pixel_key};
use crate::shot::Shot;
use crate::stream::{IndependentSamples, Sequences, Stream};
use crate::tally::{LANES, Tally};

/// Random numbers of the moment of a sample: beyond those of the longest path.
const TIME_GROUP: u32 = 2 * DEEPEST + 1;

/// One thread's part in a rendering.
pub trait Worker {
    /// Adds a range of a pixel's samples, or of those of one part of a reference there, to a tally.
    fn add(&mut self, tally: &mut Tally, pixel: usize, part: Option<u32>, range: Range<u32>);
}

/// Picks the code for a rendering, so that what is not asked for costs nothing: the only place where what is chosen at
/// run time becomes a type.
pub fn worker<'a>(shot: &'a Shot<'a>, sampling: Sampling) -> Box<dyn Worker + 'a> {
    fn with<'a, R: Recorder + 'a>(
        shot: &'a Shot<'a>,
        sampling: Sampling,
        recorder: R,
    ) -> Box<dyn Worker + 'a> {
        match (sampling, shot.plan.extras) {
            (Sampling::Independent, false) => {
                Box::new(Tracer::<_, false, IndependentSamples>::new(shot, recorder))
            }
            (Sampling::Independent, true) => {
                Box::new(Tracer::<_, true, IndependentSamples>::new(shot, recorder))
            }
            (Sampling::LowDiscrepancy, false) => {
                Box::new(Tracer::<_, false, Sequences<'a>>::new(shot, recorder))
            }
            (Sampling::LowDiscrepancy, true) => {
                Box::new(Tracer::<_, true, Sequences<'a>>::new(shot, recorder))
            }
        }
    }
    let columns = &shot.plan.columns;
    if columns.list.is_empty() {
        return with(shot, sampling, ());
    }
    let follow = shot.request.feature_hit == FeatureHit::ThroughSpecular;
    with(shot, sampling, Recording::new(columns, follow))
}

/// A worker with a recorder and a kind of random numbers.
struct Tracer<'a, R, const EXTRAS: bool, N> {
    shot: &'a Shot<'a>,
    recorder: R,
    traversal: Traversal,
    /// All values of the samples of a block.
    block: Vec<f32>,
    numbers: std::marker::PhantomData<N>,
}

impl<'a, R: Recorder, const EXTRAS: bool, N: Stream<'a>> Tracer<'a, R, EXTRAS, N> {
    fn new(shot: &'a Shot<'a>, recorder: R) -> Self {
        Self {
            shot,
            recorder,
            traversal: shot.request.scene.traversal(),
            block: vec![0.0; shot.plan.columns.all * BLOCK_SAMPLES as usize],
            numbers: std::marker::PhantomData,
        }
    }

    /// Follows one sample; writes its values, zeros if they are not finite. Whether they are.
    #[inline(always)]
    fn sample(&mut self, pixel: usize, sampler: impl Sampler, row: usize) -> bool {
        let Shot { request, eye, view, plan, .. } = self.shot;
        let scene = request.scene;
        let (origin, direction) = eye.ray(pixel % request.width, pixel / request.width, sampler.group(0));
        let ray = Ray { origin, direction };
        if EXTRAS && !scene.bodies.is_empty() {
            scene.set_time(&mut self.traversal, sampler.group(TIME_GROUP)[0]);
        }
        let (recorder, traversal) = (&mut self.recorder, &mut self.traversal);
        let color = trace::<_, R, EXTRAS>(scene, ray, view, sampler, recorder, traversal);
        let all = plan.columns.all;
        let values = &mut self.block[row * all..][..all];
        let (colors, others) = values.split_at_mut(LANES);
        // The product with 0 is 0, or no number.
        let mut zeros = (color * 0.0).extend(0.0);
        colors[..COLOR].copy_from_slice(&color.to_array());
        if let Some((next, kept)) = recorder.values().split_first() {
            colors[COLOR] = *next;
            zeros.w += next * 0.0;
            let (lanes, first) = others.split_at_mut(plan.columns.accumulated - LANES);
            let (kept_lanes, kept_first) = kept.split_at(lanes.len());
            for (to, from) in lanes.chunks_exact_mut(LANES).zip(kept_lanes.chunks_exact(LANES)) {
                let from = Vec4::from_slice(from);
                from.write_to_slice(to);
                zeros += from * 0.0;
            }
            first.copy_from_slice(kept_first);
        }
        let finite = zeros == Vec4::ZERO;
        let accumulated = &mut values[..plan.columns.accumulated];
        if !finite {
            accumulated.fill(0.0);
        }
        finite
    }

    /// Adds the samples of a block to a pixel's optional statistics. Kept out of the way of those who want none.
    #[cold]
    #[inline(never)]
    fn extend_optional(&self, optional: &mut OptionalTally, pixel: usize, numbers: &N, range: Range<u32>) {
        let Shot { eye, plan, .. } = self.shot;
        let Some(wanted) = &plan.optional else { return };
        let mut positions = Positions::default();
        if wanted.looks_at_positions(pixel) {
            // Random numbers depend on the index alone, so those of the camera can be had again.
            for (position, index) in positions.iter_mut().zip(range.clone()) {
                *position = eye.place(numbers.sample(index).group(0));
            }
        }
        let (stride, samples) = (plan.columns.all, range.len());
        let (values, positions) = (&self.block[..samples * stride], &positions[..samples]);
        let block = Block { first: range.start, values, stride, positions };
        optional.extend(&block, wanted.taps(pixel));
    }
}

impl<'a, R: Recorder, const EXTRAS: bool, N: Stream<'a>> Worker for Tracer<'a, R, EXTRAS, N> {
    fn add(&mut self, tally: &mut Tally, pixel: usize, part: Option<u32>, range: Range<u32>) {
        let shot = self.shot;
        let numbers = N::new(&shot.sobol, pixel_key(shot.request.seed, pixel as u64), part);
        let mut non_finite = 0;
        let mut start = range.start;
        while start < range.end {
            // The end of the block; the last one may lie beyond the numbers of this type.
            let end = (start | (BLOCK_SAMPLES - 1)).saturating_add(1).min(range.end);
            for index in start..end {
                let finite = self.sample(pixel, numbers.sample(index), (index - start) as usize);
                non_finite += u64::from(!finite);
            }
            let samples = (end - start) as usize * shot.plan.columns.all;
            tally.extend(start, &self.block[..samples]);
            if let Some(optional) = tally.optional_mut() {
                self.extend_optional(optional, pixel, &numbers, start..end);
            }
            start = end;
        }
        shot.counts.count(non_finite, self.traversal.take_rays());
    }
}
