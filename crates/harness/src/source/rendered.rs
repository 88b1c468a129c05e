//! Scenes that are rendered here.

mod adaptive;
mod identity;
mod progress;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Instant;

use noisefloor_frame::{Estimate, Frame, PixelFilter, Reference, Sampling, Statistic};
use noisefloor_render::{
    FeatureHit, Integrator, Keep, PhotonMaps, PhotonSettings, PixelClass, Prepared, Quantity, Recorded,
    RenderRequest, render,
};
use serde_json::{Value, json};

use crate::cache::Cache;
use crate::error::HarnessError;
use crate::observer::{Observer, Silent, Stage};
use crate::row::Row;
use crate::source::frame::{FrameKind, FrameSpec, frame_seed, frame_specs};
use crate::source::opened::Opened;
use crate::source::probe::{PROBE, PROBE_SPP};
use identity::{classes_of_probe, content_hash, frame_identity};
use noisefloor_questions::PixelClasses;
use noisefloor_scenes::{Rays, closed_form};
use noisefloor_study::hash_of_frame;
use noisefloor_study::plan::ReferenceRange;
use noisefloor_study::{
    AdaptiveFrames, Maps, Place, ReferenceSpec, SceneSource, SceneSpec, Shot, Study, StudyError,
};
use noisefloor_study::{Key, key_of, seed_of};
use progress::{advance, stopped};

/// A scene with everything that all its frames have in common.
pub(super) struct Rendered {
    prepared: Prepared,
    width: usize,
    height: usize,
    depth: u32,
    filter: PixelFilter,
    feature_hit: FeatureHit,
    sampling: Sampling,
    record: BTreeMap<Quantity, Keep>,
    /// Optional statistics of the frames.
    statistics: Vec<Statistic>,
    reference: ReferenceSpec,
    /// Hash and seed of each part of the reference.
    parts: Vec<(Key, u64)>,
    shot: Shot,
    /// Random seed of the maps that all frames share.
    map_seed: u64,
    /// Those maps, made when they are first needed.
    shared: OnceLock<PhotonMaps>,
    /// Small maps for probes.
    sample: Option<PhotonMaps>,
    /// Hashes of tiny frames in rounds, by what steers them.
    in_rounds: Mutex<BTreeMap<String, Key>>,
    /// Everything that a sample's value depends on.
    look: Value,
    /// What tells the scene at this moment from others.
    identity: Value,
    study_seed: u64,
}

/// Names of the settings that say how light is carried and how photon maps are used.
const LIGHT_SETTING: &str = "light";
const PHOTON_SETTING: &str = "photon maps";

/// The scene before its moment is chosen, what it is, what its file could not give, and what tells it from others.
fn build(
    study: &Study,
    spec: &SceneSpec,
) -> Result<(noisefloor_scenes::Scene, String, Vec<String>), HarnessError> {
    match &spec.source {
        SceneSource::Gltf(path) => {
            let loaded = noisefloor_gltf::load(path)?;
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            Ok((loaded.scene, format!("glTF file {name}"), loaded.notices))
        }
        SceneSource::Builtin(id) => {
            let entry = noisefloor_scenes::find(id)
                .map_err(|source| StudyError::Scene { place: Place::of_study(&study.name, None), source })?;
            Ok(((entry.build)(), entry.about.to_owned(), Vec::new()))
        }
        SceneSource::Synthetic(_) | SceneSource::Folder(_) => unreachable!("these are not rendered"),
    }
}

pub(super) fn open(
    study: &Study,
    spec: &SceneSpec,
    size: Option<(usize, usize)>,
    recorded: &BTreeMap<Quantity, Keep>,
) -> Result<(Opened, Rendered), HarnessError> {
    let shot = spec.shot;
    let (scene, about, notices) = build(study, spec)?;
    let name = scene.id.to_string();
    let scene = shot.of(scene);
    let prepared = Prepared::new(&scene)?;
    let (width, height) = size.unwrap_or((study.width, study.height));
    let mapped = |q: Quantity| q == Quantity::Caustics && shot.photons().is_some();
    let can = |q: Quantity| prepared.available().contains(&q) || mapped(q);
    let record: BTreeMap<Quantity, Keep> =
        recorded.iter().filter(|(q, _)| can(**q)).map(|(q, k)| (*q, *k)).collect();
    // Maps that nothing looks at are not made, and are no part of any key.
    let used = shot.integrator == Integrator::PhotonMapping || record.contains_key(&Quantity::Caustics);
    let shot = if used { shot } else { Shot { photons: None, maps: Maps::Fixed, ..shot } };
    // Frames of a sequence have random numbers of their own.
    let identity = if shot.frame == 0 { Value::from(name.as_str()) } else { json!([name, shot.frame]) };
    let map_seed = seed_of(&json!({"purpose": "photon maps", "scene": identity}));

    let statistics = study.optional_statistics();
    let reference = study.reference;
    let (depth, filter) = (study.depth, study.filter);
    // Everything that a sample's value depends on, whoever asks for it.
    let few = PhotonSettings { paths: 2000, caustic_paths: 2000, ..PhotonSettings::default() };
    let sample = shot.photons().map(|_| PhotonMaps::new(&prepared, &few, 0)).transpose()?;
    let look = |sampling: Sampling, record: &BTreeMap<Quantity, Keep>, maps: bool| {
        let probe = RenderRequest {
            depth,
            filter,
            sampling,
            feature_hit: study.feature_hit,
            record: Recorded::Exactly(record.clone()),
            integrator: if maps { shot.integrator } else { Integrator::PathTracing },
            photons: if maps { sample.as_ref() } else { None },
            ..RenderRequest::new(&prepared, PROBE[0], PROBE[1], PROBE_SPP)
        };
        let mut look = json!({
            "scene": content_hash(&scene), "renderer": hash_of_frame(&render(&probe, &noisefloor_render::Silent)?),
            "width": width, "height": height, "depth": depth, "filter": filter, "sampling": sampling,
        });
        // Frames without features are the same for all, and those of before had no such choice.
        if study.feature_hit != FeatureHit::First && !record.is_empty() {
            look["feature_hit"] = study.feature_hit.name().into();
        }
        if maps && let Some(settings) = shot.photons() {
            look["photons"] = json!({"settings": settings, "integrator": shot.integrator, "maps": shot.maps});
            if shot.maps == Maps::Fixed {
                look["photons"]["seed"] = map_seed.into();
            }
        }
        Ok::<_, HarnessError>(look)
    };
    let noisy = look(study.sampling, &record, true)?;
    // Path traced unless the frames share their maps with it: then it is the same with and without maps.
    let shared = shot.integrator == Integrator::PhotonMapping && shot.maps == Maps::Fixed;
    let clean = look(reference.sampling, &BTreeMap::new(), shared)?;
    let frames = frame_specs(study, spec, &identity, |spp, seed| {
        key_of(&frame_identity(&noisy, &record, &statistics, spp, seed))
    });
    let per_part = reference.spp / reference.parts; // parts ≥ 8 by the study's checks
    let parts: Vec<(Key, u64)> = (0..reference.parts)
        .map(|part| {
            // No study seed: all studies share one reference, drawn apart from every frame.
            let seed = seed_of(&json!({"purpose": "reference", "scene": identity, "part": part}));
            let key = key_of(&json!({
                "look": clean, "spp": per_part, "seed": seed, "record": "mean"
            }));
            (key, seed)
        })
        .collect();
    let reference_key = key_of(&json!({
        "parts": parts.iter().map(|(key, _)| key).collect::<Vec<_>>(), "classes": classes_of_probe(&prepared)?,
    }));
    let mut settings = vec![
        ("seed", study.seed.to_string()),
        ("path depth", study.depth.to_string()),
        ("film filter", study.filter.name().to_owned()),
        ("features taken", study.feature_hit.name().to_owned()),
        ("sampling", study.sampling.name().to_owned()),
        ("recorded", record.keys().map(|q| q.name()).collect::<Vec<_>>().join(", ")),
    ];
    if !statistics.is_empty() {
        let names: Vec<String> = statistics.iter().map(ToString::to_string).collect();
        settings.push(("optional statistics", names.join(", ")));
    }
    if shot.frame > 0 || shot.orbit_degrees != 0.0 {
        let orbit = if shot.orbit_degrees == 0.0 {
            String::new()
        } else {
            format!(", the camera goes around by {}° per frame", shot.orbit_degrees)
        };
        settings.push(("frame of the sequence", format!("{}{orbit}", shot.frame)));
    }
    if let Some(photons) = shot.photons() {
        settings.push((LIGHT_SETTING, shot.integrator.name().to_owned()));
        let paths = format!(
            "{} light paths and radius {} of the scene's; for caustics {} light paths, {} pixels, at most {}",
            photons.paths,
            photons.radius,
            photons.caustic_paths,
            photons.caustic_pixels,
            photons.caustic_radius
        );
        let whose = match shot.maps {
            Maps::Fixed => "fixed: one pair for all frames and the reference",
            Maps::Fresh => "fresh: a new pair in each replicate, the reference is path traced",
        };
        settings.push((PHOTON_SETTING, format!("{whose}; {paths}")));
    }
    if !notices.is_empty() {
        settings.push(("left out of the file", notices.join("; ")));
    }
    let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    let opened = Opened {
        id: spec.id.clone(),
        title: scene.title.to_string(),
        about,
        width,
        height,
        sampling: study.sampling,
        settings,
        maps: (shot.integrator == Integrator::PhotonMapping).then_some(shot.maps),
        frames,
        findings: Vec::new(),
        extra_features: BTreeSet::new(),
        reference_key,
        reference_spp: u64::from(reference.spp),
        reference_sampling: reference.sampling.name().to_owned(),
        known_mean: known_mean(study, spec, (width, height)),
        equal_time_spp: spec.equal_time_spp,
    };
    let rendered = Rendered {
        prepared,
        width,
        height,
        depth: study.depth,
        filter: study.filter,
        feature_hit: study.feature_hit,
        sampling: study.sampling,
        record,
        statistics,
        reference,
        parts,
        shot,
        map_seed,
        shared: OnceLock::new(),
        sample,
        in_rounds: Mutex::default(),
        look: noisy,
        identity,
        study_seed: study.seed,
    };
    Ok((opened, rendered))
}

impl Rendered {
    fn request(&self, spp: u32, seed: u64, sampling: Sampling, record: Recorded) -> RenderRequest<'_> {
        RenderRequest {
            spp,
            seed,
            sampling,
            record,
            depth: self.depth,
            filter: self.filter,
            feature_hit: self.feature_hit,
            ..RenderRequest::new(&self.prepared, self.width, self.height, spp)
        }
    }

    pub(super) fn missing_reference_samples(&self, cache: &Cache) -> u64 {
        let per_part = u64::from(self.reference.spp / self.reference.parts);
        self.parts.iter().filter(|(key, _)| !cache.has(key)).map(|_| per_part).sum()
    }

    /// One range for each part.
    pub(super) fn reference_ranges(&self, scene: &str) -> Vec<ReferenceRange> {
        let per_part = u64::from(self.reference.spp / self.reference.parts);
        let range = |(part, (key, seed)): (usize, &(Key, u64))| ReferenceRange {
            scene: scene.to_owned(),
            key: key.clone(),
            from: part as u64 * per_part,
            to: (part as u64 + 1) * per_part,
            seed: *seed,
            sampling: self.reference.sampling,
            samples: per_part * (self.width * self.height) as u64,
        };
        self.parts.iter().enumerate().map(range).collect()
    }

    /// The frame of the same replicate with another number of samples in every pixel: that of a study which has it as
    /// a level.
    pub(super) fn with_samples(&self, frame: &FrameSpec, spp: u32) -> FrameSpec {
        let seed = frame_seed(self.study_seed, &self.identity, spp, frame.replicate);
        let key = key_of(&frame_identity(&self.look, &self.record, &self.statistics, spp, seed));
        FrameSpec { seed, key, kind: FrameKind::Samples(spp), ..frame.clone() }
    }

    /// The frame of the same replicate with as many samples placed where `row` asks for them.
    pub(super) fn in_rounds(&self, frame: &FrameSpec, adaptive: AdaptiveFrames, row: &Row) -> FrameSpec {
        let mut all = frame_identity(&self.look, &self.record, &self.statistics, frame.spp, frame.seed);
        all["adaptive"] = json!(adaptive);
        all["method"] = json!([row.method.id, row.method.params, self.probe_in_rounds(adaptive, row)]);
        FrameSpec { key: key_of(&all), kind: FrameKind::Adaptive(adaptive), ..frame.clone() }
    }

    /// Hash of a tiny frame in rounds that the row steers: of renderer, density and sharing out together.
    fn probe_in_rounds(&self, adaptive: AdaptiveFrames, row: &Row) -> Key {
        let who = json!([adaptive, row.fingerprint]).to_string();
        // A panic elsewhere leaves nothing half done in here.
        let mut known = self.in_rounds.lock().unwrap_or_else(PoisonError::into_inner);
        let probe = || {
            let spp = adaptive.first.unwrap_or(0).min(64) + PROBE_SPP;
            let request = RenderRequest {
                width: PROBE[0],
                height: PROBE[1],
                integrator: self.shot.integrator,
                photons: self.sample.as_ref(),
                ..self.request(spp, 0, self.sampling, Recorded::Exactly(self.record.clone()))
            };
            let label = (spp, row.label.as_str());
            match adaptive::render(&request, adaptive, label, row.method.denoiser.adaptive(), &Silent) {
                Ok(frame) => hash_of_frame(&frame),
                // Told when a real frame is rendered.
                Err(_) => "no density".to_owned(),
            }
        };
        known.entry(who).or_insert_with(probe).clone()
    }

    pub(super) fn frame(
        &self,
        spec: &FrameSpec,
        row: Option<&Row>,
        cache: &Cache,
        observer: &dyn Observer,
    ) -> Result<Frame, HarnessError> {
        let record = Recorded::Exactly(self.record.clone());
        let mut request = self.request(spec.samples(), spec.seed, self.sampling, record);
        request.optional.statistics.clone_from(&self.statistics);
        let make = |request: &RenderRequest<'_>| match (spec.kind, row) {
            (FrameKind::Adaptive(adaptive), Some(row)) => {
                let label = (spec.spp, row.label.as_str());
                adaptive::render(request, adaptive, label, row.method.denoiser.adaptive(), observer)
            }
            _ => rendered(request, observer),
        };
        cache.frame(&spec.key, observer, || {
            let Some(settings) = self.shot.photons() else { return make(&request) };
            let fresh;
            let maps = match self.shot.maps {
                Maps::Fixed => self.shared_maps()?,
                Maps::Fresh => {
                    let seed = seed_of(&json!({"purpose": "photon maps", "frame": spec.seed}));
                    fresh = PhotonMaps::new(&self.prepared, &settings, seed)?;
                    &fresh
                }
            };
            let request =
                RenderRequest { photons: Some(maps), integrator: self.shot.integrator, ..request.clone() };
            let mut frame = make(&request)?;
            // What this frame would have cost alone.
            frame.provenance.render_seconds = frame.provenance.render_seconds.map(|s| s + maps.seconds());
            if self.shot.integrator == Integrator::PhotonMapping {
                frame.provenance.photon_maps = Some(self.shot.maps);
            }
            Ok(frame)
        })
    }

    /// The maps that all frames share.
    fn shared_maps(&self) -> Result<&PhotonMaps, HarnessError> {
        if let Some(maps) = self.shared.get() {
            return Ok(maps);
        }
        let maps = PhotonMaps::new(&self.prepared, &self.shot.photons().unwrap_or_default(), self.map_seed)?;
        Ok(self.shared.get_or_init(|| maps))
    }

    /// Part by part, each kept, so that a killed run loses at most one part.
    pub(super) fn reference(
        &self,
        scene: &str,
        cache: &Cache,
        observer: &dyn Observer,
    ) -> Result<Reference, HarnessError> {
        let per_part = self.reference.spp / self.reference.parts;
        let mut parts = Vec::new();
        for (part, (key, seed)) in self.parts.iter().enumerate() {
            observer.stage(&Stage::Reference {
                scene: scene.to_owned(),
                part: part as u32,
                parts: self.reference.parts,
            });
            let mut request = self.request(per_part, *seed, self.reference.sampling, Recorded::color_only());
            let frame = cache.frame(key, observer, || {
                if self.shot.integrator == Integrator::PhotonMapping && self.shot.maps == Maps::Fixed {
                    request.integrator = Integrator::PhotonMapping;
                    request.photons = Some(self.shared_maps()?);
                }
                let mut frame = rendered(&request, observer)?;
                frame.color = Estimate::from_mean(frame.color.mean);
                Ok(frame)
            })?;
            parts.push(frame.color.mean);
        }
        Reference::from_parts(parts, per_part, self.reference.sampling)
            .map_err(|source| HarnessError::Frame { scene: scene.to_owned(), source: Box::new(source) })
    }

    pub(super) fn classes(&self, reference: &Reference) -> Result<PixelClasses, HarnessError> {
        let of_scene = noisefloor_render::pixel_classes(&self.prepared, self.width, self.height)?.classes;
        let of_class =
            [PixelClass::Emitter, PixelClass::Glossy, PixelClass::OutOfFocus, PixelClass::Background]
                .map(|class| (class.name(), of_scene.iter().map(|c| *c == class).collect::<Vec<bool>>()));
        Ok(PixelClasses::from_masks(&of_class, reference))
    }
}

fn rendered(request: &RenderRequest<'_>, observer: &dyn Observer) -> Result<Frame, HarnessError> {
    let spp = u64::from(request.spp);
    let progress = |pixels: usize| advance(observer, pixels as u64 * spp);
    let start = Instant::now();
    let frame = render(request, &progress);
    let seconds = start.elapsed().as_secs_f64();
    let mut frame = frame.map_err(stopped)?;
    frame.provenance.render_seconds.get_or_insert(seconds);
    frame.provenance.render_threads.get_or_insert(rayon::current_num_threads() as u32);
    Ok(frame)
}

/// Of a scene that a formula describes, if nothing about it was changed.
fn known_mean(study: &Study, spec: &SceneSpec, size: (usize, usize)) -> Option<f64> {
    let rays = match study.filter {
        PixelFilter::Box => Rays::Area,
        PixelFilter::Point => Rays::Centres,
    };
    match &spec.source {
        SceneSource::Builtin(id) if spec.shot == Shot::default() => closed_form(id, study.depth, rays, size),
        _ => None,
    }
}
