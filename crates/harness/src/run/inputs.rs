//! Frames against their reference and against each other, once per frame.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Finding, Frame, Maps};
use noisefloor_inputs::{Against, Mean, Sketch, among};
use serde::{Deserialize, Serialize};

use crate::error::HarnessError;
use crate::source::{FrameKind, FrameSpec, Scene};
use crate::store::{Layout, read_json, write_json};
use noisefloor_study::Key;
use noisefloor_study::context::SceneContext;
use noisefloor_study::files;

/// Raise when sketches of before cannot be held against new ones.
const VERSION: u32 = 1;

/// What is kept of the frames of a scene, so that those of an earlier run can be held against new ones.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Book {
    version: u32,
    /// Hash of what determines the reference that the sketches are about.
    reference: Key,
    /// By [`place`].
    frames: BTreeMap<String, Page>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Page {
    spp: u32,
    replicate: u32,
    sketch: Sketch,
}

impl Page {
    fn name(&self) -> String {
        format!("{} spp, replicate {}", self.spp, self.replicate)
    }
}

/// What tells a frame from others: two replicates may be the same file.
fn place(spec: &FrameSpec) -> String {
    format!("{} {} {}", spec.key, spec.samples(), spec.replicate)
}

/// The checks of a scene that runs.
pub(super) struct Inputs<'a> {
    scene: &'a Scene,
    layout: &'a Layout,
    against: Against<'a>,
    book: Book,
    /// What was found without looking at frames.
    before: Vec<Finding>,
}

impl<'a> Inputs<'a> {
    /// `context` is the scene as it was just prepared; what is wrong with the reference alone is put into it.
    pub(super) fn open(
        scene: &'a Scene,
        layout: &'a Layout,
        reference: &'a noisefloor_frame::Reference,
        context: &mut SceneContext,
    ) -> Self {
        let spp = (scene.reference_spp > 0).then_some(scene.reference_spp as f64);
        let against = Against::new(reference, spp);
        let kept: Option<Book> = read_json(&layout.root().join(files::sketches(&scene.id))).ok();
        let mut book = kept
            .filter(|book| book.version == VERSION && book.reference == scene.reference_key)
            .unwrap_or_default();
        (book.version, book.reference) = (VERSION, scene.reference_key.clone());
        let planned: BTreeSet<String> = scene
            .frames
            .iter()
            .flat_map(|frame| scene.rows.iter().map(move |row| place(&scene.frame_of(frame, row))))
            .collect();
        book.frames.retain(|key, _| planned.contains(key));
        let of_reference = format!("{}: reference", scene.id);
        context.findings.extend(against.alone().into_iter().map(|found| found.within(&of_reference)));
        Self { scene, layout, against, book, before: context.findings.clone() }
    }

    /// Looks at a frame; what is found about it belongs into the records of its rows, what is found about it and others
    /// into the scene, which is on disk when this returns.
    pub(super) fn frame(
        &mut self,
        spec: &FrameSpec,
        frame: &Frame,
        invalid: &[bool],
        context: &mut SceneContext,
    ) -> Result<Vec<Finding>, HarnessError> {
        let fresh = frame.provenance.maps() == Some(Maps::Fresh);
        let placed = matches!(spec.kind, FrameKind::Adaptive(_)) || frame.provenance.rounds.is_some();
        let mean = if fresh || placed { Mean::Biased } else { Mean::OfTheReference };
        let check = self.against.frame(frame, invalid, mean);
        // Rounds begin with the samples of the uniform frame of the same seed: their rows are never compared as if they
        // were independent.
        // A frame with its law's variance is the study's own otherwise.
        if !placed && spec.kind != FrameKind::KnownVariance {
            let page = Page { spp: spec.samples(), replicate: spec.replicate, sketch: check.sketch };
            self.book.frames.insert(place(spec), page);
            self.together(context)?;
        }
        let subject = format!("{} at {} spp, replicate {}", self.scene.id, spec.samples(), spec.replicate);
        Ok(check.findings.into_iter().map(|found| found.within(&subject)).collect())
    }

    fn together(&self, context: &mut SceneContext) -> Result<(), HarnessError> {
        let mut pages: Vec<&Page> = self.book.frames.values().collect();
        pages.sort_by_key(|page| (page.spp, page.replicate));
        let frames: Vec<(String, Sketch)> =
            pages.iter().map(|page| (page.name(), page.sketch.clone())).collect();
        let found = among(&self.against, &frames);
        context.findings.clone_from(&self.before);
        context.findings.extend(found.into_iter().map(|found| found.within(&self.scene.id)));
        write_json(&self.layout.ready(&files::sketches(&self.scene.id))?, &self.book)?;
        write_json(&self.layout.ready(&files::scene(&self.scene.id))?, context)
    }
}
