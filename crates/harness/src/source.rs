//! Where the frames and the reference of a scene come from: rendered here, drawn from a known law, or imported.

mod folder;
mod quantities;
mod rendered;

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Fidelity, Finding, Frame, Hygiene, Maps, Reference, Sampling};
use noisefloor_questions::PixelClasses;
use noisefloor_render::{Keep, Quantity};
use noisefloor_synthetic::SyntheticScene;
use serde_json::json;

use crate::cache::Cache;
use crate::error::HarnessError;
use crate::observer::Observer;
use crate::row::Row;
use noisefloor_study::plan::{Placed, ReferenceRange};
use noisefloor_study::{AdaptiveFrames, Place, RowFrames, SceneSource, SceneSpec, Shot, Study, StudyError};
use noisefloor_study::{Bits, hash_of_frame};
use noisefloor_study::{Key, key_of, seed_of};

use folder::Imported;
pub(crate) use quantities::recorded;
use rendered::{PROBE, PROBE_SPP, Rendered};

/// A noisy frame that the plan asks for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FrameSpec {
    pub(crate) spp: u32,
    pub(crate) replicate: u32,
    pub(crate) seed: u64,
    /// Hash of all that determines the frame.
    pub(crate) key: Key,
    pub(crate) kind: FrameKind,
}

/// How a frame differs from the study's own of its level and replicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrameKind {
    /// Not at all.
    Uniform,
    /// So many samples in every pixel instead of the level's.
    Samples(u32),
    /// Rendered in rounds.
    Adaptive(AdaptiveFrames),
}

impl FrameSpec {
    /// Samples per pixel, on average.
    pub(crate) fn samples(&self) -> u32 {
        match self.kind {
            FrameKind::Samples(spp) => spp,
            FrameKind::Uniform | FrameKind::Adaptive(_) => self.spp,
        }
    }
}

impl FrameKind {
    /// In the words of the plan.
    pub(crate) fn placed(self) -> Placed {
        match self {
            Self::Uniform => Placed::Uniform,
            Self::Samples(_) => Placed::Samples,
            Self::Adaptive(_) => Placed::Rounds,
        }
    }
}

/// A noisy frame that was checked, see [`Frame::inspect`]: methods may look at it.
#[derive(Debug, Clone)]
pub(crate) struct Checked {
    pub(crate) frame: Frame,
    /// What was found and mended.
    pub(crate) hygiene: Hygiene,
    /// Scene, and file or level and replicate.
    name: String,
}

impl Checked {
    /// What was found, with the frame's name.
    pub(crate) fn findings(&self) -> Vec<Finding> {
        self.hygiene.findings.iter().cloned().map(|finding| finding.within(&self.name)).collect()
    }
}

/// A scene of a study, opened.
pub(crate) struct Scene {
    pub(crate) id: String,
    pub(crate) title: String,
    pub(crate) about: String,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Kind of sampling of the noisy frames.
    pub(crate) sampling: Sampling,
    pub(crate) settings: BTreeMap<String, String>,
    /// Which photon maps light the frames, if any do.
    pub(crate) maps: Option<Maps>,
    pub(crate) frames: Vec<FrameSpec>,
    /// What the headers of its files show.
    pub(crate) findings: Vec<Finding>,
    /// Names of the layers in its files that have no fixed meaning.
    pub(crate) extra_features: BTreeSet<String>,
    /// Hash of all that determines the reference.
    pub(crate) reference_key: Key,
    /// Samples per pixel of the reference; 0 if exact or unknown.
    pub(crate) reference_spp: u64,
    /// Sampling of the reference, or `exact`.
    pub(crate) reference_sampling: String,
    /// The study's rows with this scene's parameters.
    pub(crate) rows: Vec<Row>,
    /// Samples per pixel of frames of equal time.
    equal_time_spp: Option<u32>,
    /// The scene at other moments of its sequence, by the distance in frames, as far as rows look at them.
    beside: BTreeMap<i64, Scene>,
    source: Source,
}

enum Source {
    Rendered(Box<Rendered>),
    Synthetic(SyntheticScene),
    Imported(Imported),
}

impl Scene {
    /// Opens a scene: builds it, or looks at the files of its folder. Renders nothing but tiny probes and decodes
    /// nothing.
    pub(crate) fn open(
        study: &Study,
        spec: &SceneSpec,
        size: Option<(usize, usize)>,
        recorded: &BTreeMap<Quantity, Keep>,
    ) -> Result<Self, HarnessError> {
        match &spec.source {
            SceneSource::Builtin(_) | SceneSource::Gltf(_) => rendered::open(study, spec, size, recorded),
            SceneSource::Synthetic(scene) => synthetic(study, spec, scene, size),
            SceneSource::Folder(path) => folder::open(spec, path),
        }
    }

    /// Opens the moments of a rendered sequence that the rows look at beside the scene's own.
    pub(crate) fn open_beside(
        &mut self,
        study: &Study,
        spec: &SceneSpec,
        size: Option<(usize, usize)>,
        recorded: &BTreeMap<Quantity, Keep>,
    ) -> Result<(), HarnessError> {
        if !matches!(self.source, Source::Rendered(_)) {
            return Ok(());
        }
        let reach = self.rows.iter().map(|row| row.card.neighbors).max().unwrap_or(0) as i64;
        for distance in (-reach..=reach).filter(|distance| *distance != 0) {
            if let Ok(frame) = u32::try_from(i64::from(spec.shot.frame) + distance) {
                let moment = SceneSpec { shot: Shot { frame, ..spec.shot }, ..spec.clone() };
                self.beside.insert(distance, Self::open(study, &moment, size, recorded)?);
            }
        }
        Ok(())
    }

    /// The frame that a row denoises, from the study's own of its level and replicate.
    pub(crate) fn frame_of(&self, frame: &FrameSpec, row: &Row) -> FrameSpec {
        match (&self.source, &row.frames, self.equal_time_spp) {
            (Source::Rendered(rendered), RowFrames::EqualTime { .. }, Some(spp)) => {
                rendered.with_samples(frame, spp)
            }
            (Source::Rendered(rendered), RowFrames::Adaptive(adaptive), _) => {
                rendered.in_rounds(frame, *adaptive, row)
            }
            // The study's checks leave no other rows with frames of their own.
            _ => frame.clone(),
        }
    }

    /// The neighbouring moments that a row looks at beside a frame, each with its frame, earlier ones first.
    pub(crate) fn beside<'a>(
        &'a self,
        frame: &FrameSpec,
        row: &Row,
    ) -> impl Iterator<Item = (i64, FrameSpec)> + use<'a> {
        let reach = row.card.neighbors as i64;
        let (spp, replicate, kind) = (frame.spp, frame.replicate, frame.kind);
        self.beside
            .iter()
            .filter(move |(distance, _)| distance.abs() <= reach && kind == FrameKind::Uniform)
            .filter_map(move |(distance, scene)| {
                let same = |f: &&FrameSpec| f.spp == spp && f.replicate == replicate;
                scene.frames.iter().find(same).map(|frame| (*distance, frame.clone()))
            })
    }

    /// The scene at a neighbouring moment.
    pub(crate) fn moment(&self, distance: i64) -> Option<&Scene> {
        self.beside.get(&distance)
    }

    /// Replicates per level.
    pub(crate) fn replicates(&self) -> BTreeMap<u32, u32> {
        let mut out = BTreeMap::new();
        for frame in &self.frames {
            *out.entry(frame.spp).or_insert(0) += 1;
        }
        out
    }

    /// Whether no level has a second replicate, so that uncertainty can only come from within the image.
    pub(crate) fn single(&self) -> bool {
        self.frames.iter().all(|frame| frame.replicate == 0)
    }

    /// Camera samples still to be rendered for the reference, if it is needed, and for these frames.
    pub(crate) fn samples<'a>(
        &self,
        cache: &Cache,
        frames: impl Iterator<Item = &'a FrameSpec>,
        reference: bool,
    ) -> u64 {
        let Source::Rendered(rendered) = &self.source else { return 0 };
        let pixels = (self.width * self.height) as u64;
        let frames = frames.filter(|f| !cache.has(&f.key)).map(|f| u64::from(f.samples()));
        let parts = if reference { rendered.missing_reference_samples(cache) } else { 0 };
        pixels * (frames.sum::<u64>() + parts)
    }

    /// Camera samples of a frame of so many samples per pixel; 0 where nothing is rendered.
    pub(crate) fn camera_samples(&self, spp: u64) -> u64 {
        match self.source {
            Source::Rendered(_) => (self.width * self.height) as u64 * spp,
            Source::Synthetic(_) | Source::Imported(_) => 0,
        }
    }

    /// The samples of the reference, in the order in which they are merged.
    pub(crate) fn reference_ranges(&self) -> Vec<ReferenceRange> {
        let Source::Rendered(rendered) = &self.source else { return Vec::new() };
        rendered.reference_ranges(&self.id)
    }

    /// Renders, draws or reads a frame, and checks it; `row` is who steers it, if it is adaptive.
    pub(crate) fn frame(
        &self,
        spec: &FrameSpec,
        row: Option<&Row>,
        cache: &Cache,
        observer: &dyn Observer,
    ) -> Result<Checked, HarnessError> {
        let (mut frame, fidelity, name) = match &self.source {
            Source::Rendered(rendered) => {
                let frame = rendered.frame(spec, row, cache, observer)?;
                (frame, Fidelity::Rounded, self.name_of(spec, row))
            }
            Source::Synthetic(scene) => {
                let frame = scene.render(spec.spp, spec.seed);
                (frame, Fidelity::Rounded, self.name_of(spec, row))
            }
            Source::Imported(folder) => {
                let (file, name) = folder.frame(spec)?;
                // What its header shows was told with the scene.
                (file.frame, file.fidelity, format!("{}: {name}", self.id))
            }
        };
        match frame.inspect(fidelity) {
            Ok(hygiene) => Ok(Checked { frame, hygiene, name }),
            Err(source) => Err(HarnessError::Unsound { frame: name, source: Box::new(source) }),
        }
    }

    /// Scene, level and replicate of a frame, and the row if the frame is its own.
    fn name_of(&self, spec: &FrameSpec, row: Option<&Row>) -> String {
        let name = format!("{} at {} spp, replicate {}", self.id, spec.spp, spec.replicate);
        match (spec.kind, row) {
            (FrameKind::Adaptive(_), Some(row)) => format!("{name}, frame of {}", row.label),
            (FrameKind::Samples(spp), _) => format!("{name}, frame of {spp} samples"),
            _ => name,
        }
    }

    /// Renders or reads the reference, with what was found about it.
    ///
    /// # Errors
    /// [`HarnessError::Image`] also for one that contradicts itself.
    pub(crate) fn reference(
        &self,
        cache: &Cache,
        observer: &dyn Observer,
    ) -> Result<(Reference, Vec<Finding>), HarnessError> {
        match &self.source {
            Source::Rendered(rendered) => Ok((rendered.reference(&self.id, cache, observer)?, Vec::new())),
            Source::Synthetic(scene) => Ok((scene.truth(), Vec::new())),
            Source::Imported(folder) => {
                let (reference, found) = folder.reference()?;
                let name = format!("{}: reference", self.id);
                Ok((reference, found.into_iter().map(|finding| finding.within(&name)).collect()))
            }
        }
    }

    /// One class per pixel.
    pub(crate) fn classes(&self, reference: &Reference) -> Result<PixelClasses, HarnessError> {
        match &self.source {
            Source::Rendered(rendered) => rendered.classes(reference),
            Source::Synthetic(scene) => Ok(PixelClasses::from(scene.classes())),
            Source::Imported(_) => Ok(PixelClasses::from_reference(reference)),
        }
    }
}

fn synthetic(
    study: &Study,
    spec: &SceneSpec,
    scene: &SyntheticScene,
    size: Option<(usize, usize)>,
) -> Result<Scene, HarnessError> {
    let scene = match size {
        Some((width, height)) => scene.resized(width, height).map_err(|e| StudyError::Field {
            place: Place::of_study(&study.name, None),
            field: format!("scene `{}`: size", spec.id),
            value: format!("{width}×{height}"),
            allowed: e.to_string(),
        })?,
        None => scene.clone(),
    };
    let description = serde_json::to_value(&scene).unwrap_or_default();
    let (drawn, truth) = synthetic_probes(&scene);
    // Frames of a sequence have random numbers of their own.
    let frame = spec.shot.frame;
    let identity = if frame == 0 { description.clone() } else { json!([description, frame]) };
    let frames = frame_specs(study, spec, &identity, |spp, seed| {
        key_of(&json!({ "synthetic": description, "drawn": drawn, "spp": spp, "seed": seed }))
    });
    let settings = BTreeMap::from([
        ("seed".to_owned(), study.seed.to_string()),
        ("samples".to_owned(), description.to_string()),
    ]);
    Ok(Scene {
        id: spec.id.clone(),
        title: spec.id.clone(),
        about: format!(
            "synthetic: samples of a known law ({}) around a known mean image",
            scene.law().name()
        ),
        width: scene.width(),
        height: scene.height(),
        sampling: Sampling::Independent,
        settings,
        maps: None,
        frames,
        findings: Vec::new(),
        extra_features: BTreeSet::new(),
        reference_key: key_of(&json!({ "truth": description, "drawn": truth })),
        reference_spp: 0,
        reference_sampling: "exact".into(),
        rows: Vec::new(),
        equal_time_spp: None,
        beside: BTreeMap::new(),
        source: Source::Synthetic(scene),
    })
}

/// Hashes of a tiny frame of a synthetic scene and of its truth with the classes of its pixels: they change whenever other
/// numbers are drawn.
fn synthetic_probes(scene: &SyntheticScene) -> (Key, Key) {
    let (width, height) = (scene.width().min(PROBE[0]), scene.height().min(PROBE[1]));
    // Never larger than a size that is allowed.
    let small = scene.resized(width, height).unwrap_or_else(|_| scene.clone());
    let mut truth = Bits::of("truth");
    truth.frame(&small.truth().frame);
    PixelClasses::from(small.classes()).add_to(&mut truth);
    (hash_of_frame(&small.render(PROBE_SPP, 0)), truth.finish())
}

/// Random seed of a noisy frame.
fn frame_seed(study_seed: u64, identity: &serde_json::Value, spp: u32, replicate: u32) -> u64 {
    seed_of(&json!({
        "purpose": "frame", "seed": study_seed, "scene": identity, "spp": spp, "replicate": replicate
    }))
}

/// The frames of a scene whose random seeds follow from study seed, scene, level and replicate, never from the study's
/// name, so that studies share frames.
fn frame_specs(
    study: &Study,
    spec: &SceneSpec,
    identity: &serde_json::Value,
    key: impl Fn(u32, u64) -> Key,
) -> Vec<FrameSpec> {
    let mut frames = Vec::new();
    for &spp in study.levels(spec) {
        for replicate in 0..study.replicates(spec, spp) {
            let seed = frame_seed(study.seed, identity, spp, replicate);
            frames.push(FrameSpec { spp, replicate, seed, key: key(spp, seed), kind: FrameKind::Uniform });
        }
    }
    frames
}
