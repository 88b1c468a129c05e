//! A scene of a study: its frames, its reference, its pixel classes, wherever they come from.

use std::collections::BTreeMap;
use std::ops::Deref;

use noisefloor_frame::{Fidelity, Finding, Reference, Statistic};
use noisefloor_questions::PixelClasses;
use noisefloor_render::{Keep, Quantity};
use noisefloor_study::plan::ReferenceRange;
use noisefloor_study::{RowFrames, SceneSource, SceneSpec, Shot, Study};
use noisefloor_synthetic::SyntheticScene;

use crate::access::Access;
use crate::cache::Cache;
use crate::error::HarnessError;
use crate::observer::Observer;
use crate::row::Row;
use crate::source::folder::{self, Imported};
use crate::source::frame::{Checked, FrameKind, FrameSpec};
use crate::source::opened::Opened;
use crate::source::rendered::{self, Rendered};
use crate::source::synthetic;

/// A scene of a study, opened.
pub(crate) struct Scene {
    opened: Opened,
    /// The study's rows with this scene's parameters.
    pub(crate) rows: Vec<Row>,
    /// The scene at other moments of its sequence, by the distance in frames, as far as rows look at them.
    beside: BTreeMap<i64, Scene>,
    source: Source,
}

/// What is known of it before anything is rendered or decoded can be asked of itself.
impl Deref for Scene {
    type Target = Opened;

    fn deref(&self) -> &Opened {
        &self.opened
    }
}

enum Source {
    Rendered(Box<Rendered>),
    /// With the optional statistics that its frames get.
    Synthetic(SyntheticScene, Vec<Statistic>),
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
            SceneSource::Builtin(_) | SceneSource::Gltf(_) => {
                let (opened, rendered) = rendered::open(study, spec, size, recorded)?;
                Ok(Self::of(opened, Source::Rendered(Box::new(rendered))))
            }
            SceneSource::Synthetic(scene) => {
                let (opened, scene) = synthetic::open(study, spec, scene, size)?;
                Ok(Self::of(opened, Source::Synthetic(scene, study.optional_statistics())))
            }
            SceneSource::Folder(path) => {
                let (opened, imported) = folder::open(spec, path)?;
                Ok(Self::of(opened, Source::Imported(imported)))
            }
        }
    }

    fn of(opened: Opened, source: Source) -> Self {
        Self { opened, rows: Vec::new(), beside: BTreeMap::new(), source }
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
            (Source::Synthetic(..), RowFrames::KnownVariance, _) => synthetic::with_known_variance(frame),
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
            Source::Synthetic(..) | Source::Imported(_) => 0,
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
        access: Access<'_>,
    ) -> Result<Checked, HarnessError> {
        let Access { cache, observer, laboratory } = access;
        let (mut frame, fidelity, name) = match &self.source {
            Source::Rendered(rendered) => {
                let frame = rendered.frame(spec, row, cache, observer)?;
                (frame, Fidelity::Rounded, self.name_of(spec, row))
            }
            Source::Synthetic(scene, statistics) => {
                let frame = synthetic::frame((scene, statistics), spec, cache, observer)?;
                (frame, Fidelity::Rounded, self.name_of(spec, row))
            }
            Source::Imported(folder) => {
                let (file, name) = folder.frame(spec)?;
                // What its header shows was told with the scene.
                (file.frame, file.fidelity, format!("{}: {name}", self.id))
            }
        };
        laboratory.pass_frame(&self.id, (spec.spp, spec.replicate), &mut frame);
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
            (FrameKind::KnownVariance, _) => format!("{name}, with its law's variance"),
            (FrameKind::Samples(spp), _) => format!("{name}, frame of {spp} samples"),
            _ => name,
        }
    }

    /// Renders or reads the reference, with what was found about it.
    ///
    /// # Errors
    /// [`HarnessError::Image`] also for one that contradicts itself.
    pub(crate) fn reference(&self, access: Access<'_>) -> Result<(Reference, Vec<Finding>), HarnessError> {
        let (mut reference, findings) = self.reference_of_source(access.cache, access.observer)?;
        access.laboratory.pass_reference(&self.id, &mut reference);
        Ok((reference, findings))
    }

    fn reference_of_source(
        &self,
        cache: &Cache,
        observer: &dyn Observer,
    ) -> Result<(Reference, Vec<Finding>), HarnessError> {
        match &self.source {
            Source::Rendered(rendered) => Ok((rendered.reference(&self.id, cache, observer)?, Vec::new())),
            Source::Synthetic(scene, _) => Ok((scene.truth(), Vec::new())),
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
            Source::Synthetic(scene, _) => Ok(PixelClasses::from(scene.classes())),
            Source::Imported(_) => Ok(PixelClasses::from_reference(reference)),
        }
    }
}
