use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use noisefloor_frame::{Counts, Estimate, Frame, Image, Provenance, Reference, Samples, Sampling};

use crate::bvh::Ray;
use crate::camera::Eye;
use crate::film::{Extent, develop};
use crate::intersect::Traversal;
use crate::limits::{DEEPEST, LONGEST_SEQUENCE};
use crate::path::{View, trace};
use crate::plan::{COLOR, Plan, WITH_ALL, WITH_BOTH, WITH_FEATURES, WITH_FLASH, tally_values};
use crate::planes::Planes;
use crate::request::REVISION;
use crate::sampler::{Independent, OwenSobol, Sampler, Sequence, SobolTables, pixel_key};
use crate::tally::Tally;
use crate::{FeatureHit, Integrator, Keep, Progress, RenderError, RenderRequest};

/// Sequences of a reference are numbered from here on, those of a frame from 0: equal seeds do not make a frame a part
/// of its own reference.
const REFERENCE_SEQUENCES: u32 = 1 << 16;

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
    let planes = shot.dispatch(plan.planes(), progress)?;
    counts.check(request)?;
    let even = |end: u32| end.div_ceil(2);
    let end = request.sample_start + request.spp; // checked above
    let samples =
        Samples::uniform(request.spp).with_half_a(Counts::Uniform(even(end) - even(request.sample_start)));
    let mut frame = blank(request, samples, request.sampling);
    plan.fill(&mut frame, planes, request.width, request.height)?;
    frame.provenance = provenance(request, start.elapsed().as_secs_f64(), &counts);
    frame.provenance.sampler = Some(crate::sampler::name(request.sampling).into());
    Ok(frame)
}

/// Renders a reference: `request.spp` samples in all, split over `parts` separately randomised low-discrepancy sequences,
/// whatever `request.sampling` says. Of the recorded quantities only the means are kept.
///
/// # Errors
/// Like [`render`]; [`RenderError::InvalidRequest`] also if there are fewer than [`Reference::LEAST_PARTS`] parts, if
/// `spp` is not a multiple of `parts`, if a part is longer than 65536, or if `sample_start` is not 0.
pub fn render_reference(
    request: &RenderRequest<'_>,
    parts: u32,
    progress: &dyn Progress,
) -> Result<Reference, RenderError> {
    let request = &RenderRequest { sampling: Sampling::Independent, ..request.clone() };
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
    request.check_memory(3 * parts as usize + plan.planes())?;
    let start = Instant::now();
    let counts = Totals::default();
    let shot = Shot { parts: Some(parts), ..Shot::new(request, &plan, &counts) };
    let mut planes = shot.dispatch(3 * parts as usize + plan.planes(), progress)?;
    counts.check(request)?;
    let rest = planes.split_off(3 * parts as usize);
    let images = planes
        .chunks_exact(3)
        .map(|rgb| Image::from_vec(request.width, request.height, 3, rgb.concat()))
        .collect::<Result<Vec<_>, _>>()?;
    let mut reference = Reference::from_parts(images, request.spp / parts, Sampling::LowDiscrepancy)?;
    let mut recorded = blank(request, Samples::uniform(request.spp), Sampling::LowDiscrepancy);
    plan.fill(&mut recorded, rest, request.width, request.height)?;
    reference.frame.features = recorded.features;
    reference.frame.flash = recorded.flash;
    reference.frame.provenance = provenance(request, start.elapsed().as_secs_f64(), &counts);
    reference.frame.provenance.sampler = Some(crate::sampler::name(Sampling::LowDiscrepancy).into());
    reference.frame.provenance.extra.insert("parts".into(), parts.to_string());
    Ok(reference)
}

/// Random numbers of the moment of a sample: beyond those of the longest path.
const TIME_GROUP: u32 = 2 * DEEPEST + 1;

/// A frame with a black colour, to be filled.
pub(crate) fn blank(request: &RenderRequest<'_>, samples: Samples, sampling: Sampling) -> Frame {
    Frame::from_color(Estimate::from_mean(Image::new(request.width, request.height, 3)), samples, sampling)
}

pub(crate) fn provenance(request: &RenderRequest<'_>, seconds: f64, counts: &Totals) -> Provenance {
    let eye = Eye::new(&request.scene.camera, request.width, request.height, request.filter);
    let mut extra = std::collections::BTreeMap::new();
    let [non_finite, rays] = counts.read();
    extra.insert("rays".into(), rays.to_string());
    if non_finite > 0 {
        extra.insert("non_finite_samples".into(), non_finite.to_string());
    }
    if request.sample_start > 0 {
        extra.insert("sample_start".into(), request.sample_start.to_string());
    }
    if request.feature_hit != FeatureHit::First {
        extra.insert("feature_hit".into(), request.feature_hit.name().into());
    }
    if let Some(maps) = request.photons {
        let s = maps.settings();
        extra.insert("photon_map_seed".into(), maps.seed().to_string());
        extra.insert("photon_paths".into(), format!("{} global, {} caustic", s.paths, s.caustic_paths));
        extra.insert(
            "photon_radii".into(),
            format!("{} global, {} px caustic, at most {}", s.radius, s.caustic_pixels, s.caustic_radius),
        );
    }
    if request.scene.shutter > 0.0 && !request.scene.bodies.is_empty() {
        extra.insert("shutter".into(), request.scene.shutter.to_string());
    }
    let integrator = match request.integrator {
        Integrator::PathTracing => "path",
        Integrator::PhotonMapping => "photon-mapping",
    };
    Provenance {
        scene: Some(request.scene.id().into()),
        renderer: Some(format!("noisefloor {} (revision {REVISION})", env!("CARGO_PKG_VERSION"))),
        integrator: Some(format!("{integrator} depth={}", request.depth)),
        light: Some(request.integrator),
        photon_maps: None,
        rounds: None,
        sampler: None,
        seed: Some(request.seed),
        filter: Some(request.filter),
        camera: Some(eye.provenance(&request.scene.camera)),
        render_seconds: Some(seconds),
        render_threads: u32::try_from(rayon::current_num_threads()).ok(),
        extra,
    }
}

/// Everything that is common to the pixels of one rendering.
pub(crate) struct Shot<'a> {
    request: &'a RenderRequest<'a>,
    plan: &'a Plan,
    eye: Eye,
    /// The camera one frame later, if anything moves.
    next: Option<Eye>,
    parts: Option<u32>,
    sobol: SobolTables,
    counts: &'a Totals,
}

/// What is counted over a rendering, on all threads.
#[derive(Debug, Default)]
pub(crate) struct Totals {
    /// Samples that were not finite and count as black.
    non_finite: AtomicU64,
    /// Rays that were followed.
    rays: AtomicU64,
}

impl Totals {
    /// Samples that were not finite, and rays.
    pub(crate) fn read(&self) -> [u64; 2] {
        [&self.non_finite, &self.rays].map(|count| count.load(Ordering::Relaxed))
    }

    /// Refuses an image of which more than half is made up: samples that are not finite count as black.
    fn check(&self, request: &RenderRequest<'_>) -> Result<(), RenderError> {
        let [non_finite, _] = self.read();
        let samples = (request.width * request.height) as u64 * u64::from(request.spp);
        if non_finite <= samples / 2 {
            return Ok(());
        }
        Err(RenderError::NonFinite { scene: request.scene.id().into(), non_finite, samples })
    }

    /// Adds what another rendering counted.
    pub(crate) fn add(&self, other: &Self) {
        let [non_finite, rays] = other.read();
        self.non_finite.fetch_add(non_finite, Ordering::Relaxed);
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }
}

/// What a thread keeps from pixel to pixel.
struct Scratch<const C: usize> {
    traversal: Traversal,
    tally: Tally<C>,
}

impl<'a> Shot<'a> {
    pub(crate) fn new(request: &'a RenderRequest<'a>, plan: &'a Plan, counts: &'a Totals) -> Self {
        let eye = Eye::new(&request.scene.camera, request.width, request.height, request.filter);
        let next = request.scene.camera_move.map(|step| {
            Eye::new(&step.apply(&request.scene.camera, 1.0), request.width, request.height, request.filter)
        });
        Self { request, plan, eye, next, parts: None, sobol: SobolTables::new(), counts }
    }

    /// Picks the code for what is recorded, so that what is not recorded costs nothing.
    fn dispatch(&self, planes: usize, progress: &dyn Progress) -> Result<Planes, RenderError> {
        match (self.plan.extras, self.plan.features, self.plan.flash) {
            (true, false, _) => self.run::<false, false, true, COLOR>(planes, progress),
            (true, true, _) => self.run::<true, true, true, WITH_ALL>(planes, progress),
            (false, false, false) => self.run::<false, false, false, COLOR>(planes, progress),
            (false, true, false) => self.run::<true, false, false, WITH_FEATURES>(planes, progress),
            (false, false, true) => self.run::<false, true, false, WITH_FLASH>(planes, progress),
            (false, true, true) => self.run::<true, true, false, WITH_BOTH>(planes, progress),
        }
    }

    fn run<const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
        &self,
        planes: usize,
        progress: &dyn Progress,
    ) -> Result<Planes, RenderError> {
        let request = self.request;
        let extent = Extent { width: request.width, height: request.height, samples: request.spp };
        let scratch = || Scratch::<C> { traversal: request.scene.traversal(), tally: Tally::new() };
        develop(extent, planes, progress, scratch, |scratch, x, y, out| match self.parts {
            Some(parts) => {
                let key = pixel_key(request.seed, (y * request.width + x) as u64);
                self.reference_pixel::<FEATURES, FLASH, EXTRAS, C>(scratch, x, y, key, parts, out)
            }
            None => {
                let Scratch { traversal, tally } = scratch;
                tally.clear();
                let material =
                    self.samples::<FEATURES, FLASH, EXTRAS, C>(traversal, tally, (x, y), self.range());
                self.plan.write(tally, material, out);
            }
        })
    }

    /// Adds a range of a pixel's samples to a tally; returns the material of the first one.
    pub(crate) fn samples<const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
        &self,
        traversal: &mut Traversal,
        tally: &mut Tally<C>,
        (x, y): (usize, usize),
        range: std::ops::Range<u32>,
    ) -> i32 {
        let key = pixel_key(self.request.seed, (y * self.request.width + x) as u64);
        match self.request.sampling {
            Sampling::Independent => {
                let sampler = |k| Independent::new(key, k);
                self.extend::<_, FEATURES, FLASH, EXTRAS, C>(traversal, tally, (x, y), range, sampler)
            }
            Sampling::LowDiscrepancy => {
                let halves = [0, 1].map(|half| Sequence::new(key, half));
                let sampler = |k: u32| OwenSobol::new(&self.sobol, &halves[(k & 1) as usize], k >> 1);
                self.extend::<_, FEATURES, FLASH, EXTRAS, C>(traversal, tally, (x, y), range, sampler)
            }
        }
    }

    fn range(&self) -> std::ops::Range<u32> {
        self.request.sample_start..self.request.sample_start + self.request.spp
    }

    /// Fills the tally with the samples of a pixel; returns the material of the first one.
    fn pixel<S: Sampler, const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
        &self,
        scratch: &mut Scratch<C>,
        x: usize,
        y: usize,
        samples: std::ops::Range<u32>,
        sampler: impl Fn(u32) -> S,
    ) -> i32 {
        scratch.tally.clear();
        let Scratch { traversal, tally } = scratch;
        self.extend::<_, FEATURES, FLASH, EXTRAS, C>(traversal, tally, (x, y), samples, sampler)
    }

    /// Adds samples of a pixel to a tally; returns the material of the first one.
    #[inline(always)]
    fn extend<S: Sampler, const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
        &self,
        traversal: &mut Traversal,
        tally: &mut Tally<C>,
        (x, y): (usize, usize),
        samples: std::ops::Range<u32>,
        sampler: impl Fn(u32) -> S,
    ) -> i32 {
        let scene = self.request.scene;
        let view = View {
            eye: self.eye.position(),
            depth: self.request.depth,
            follow: self.request.feature_hit == FeatureHit::ThroughSpecular,
            photons: self.request.photons,
            gather: self.request.integrator == Integrator::PhotonMapping,
            pixel: self.eye.pixel(),
            frames: self.next.map(|next| [self.eye, next]),
        };
        let first = samples.start;
        let mut material = -1;
        for k in samples {
            let sampler = sampler(k);
            let (origin, direction) = self.eye.ray(x, y, sampler.group(0));
            let ray = Ray { origin, direction };
            if EXTRAS && !scene.bodies.is_empty() {
                scene.set_time(traversal, sampler.group(TIME_GROUP)[0]);
            }
            let outcome = trace::<S, FEATURES, FLASH, EXTRAS>(scene, ray, &view, sampler, traversal);
            let (values, finite) = tally_values::<FEATURES, FLASH, EXTRAS, C>(&outcome);
            if !finite {
                self.counts.non_finite.fetch_add(1, Ordering::Relaxed);
            }
            tally.push(k, &values);
            if k == first {
                material = outcome.material;
            }
        }
        self.counts.rays.fetch_add(traversal.take_rays(), Ordering::Relaxed);
        material
    }

    /// Colour means of the parts, then the means over all parts.
    fn reference_pixel<const FEATURES: bool, const FLASH: bool, const EXTRAS: bool, const C: usize>(
        &self,
        scratch: &mut Scratch<C>,
        x: usize,
        y: usize,
        key: u64,
        parts: u32,
        out: &mut [f32],
    ) {
        let (colors, rest) = out.split_at_mut(3 * parts as usize);
        let mut all = Tally::new();
        let mut material = -1;
        for (part, color) in colors.chunks_exact_mut(3).enumerate() {
            let sequence = Sequence::new(key, REFERENCE_SEQUENCES + part as u32);
            let sampler = |k| OwenSobol::new(&self.sobol, &sequence, k);
            let first = self.pixel::<_, FEATURES, FLASH, EXTRAS, C>(
                scratch,
                x,
                y,
                0..self.request.spp / parts,
                sampler,
            );
            if part == 0 {
                material = first;
            }
            let mean = scratch.tally.total().mean().map(|v| v as f32);
            color.copy_from_slice(&mean[..3]);
            // Parts have equal sample counts: the mean over all samples is the mean of their means.
            all.push(part as u32, &mean);
        }
        self.plan.write(&mut all, material, rest);
    }
}
