//! What all cells of a scene have in common.

use std::collections::BTreeMap;

use noisefloor_frame::{Frame, Sampling};
use noisefloor_questions::measuring;
use noisefloor_study::record::{NonFinite, Outcome, RECORD_SCHEMA, Record, Seconds};

use crate::access::Access;
use crate::cache::Cache;
use crate::error::HarnessError;
use crate::machine;
use crate::plan::{CellPlan, Plan};
use crate::run::request::StudyRun;
use crate::run::settle::Owners;
use crate::source::Scene;
use crate::store::Layout;

/// Runs the cells of a scene.
pub(super) struct Runner<'a> {
    pub(super) request: &'a StudyRun<'a>,
    pub(super) plan: &'a Plan,
    pub(super) layout: &'a Layout,
    pub(super) cache: &'a Cache,
    /// Place of the scene in the plan.
    pub(super) place: usize,
    pub(super) owners: &'a Owners,
}

impl Runner<'_> {
    pub(super) fn scene(&self) -> &Scene {
        &self.plan.scenes[self.place]
    }

    pub(super) fn access(&self) -> Access<'_> {
        Access { cache: self.cache, laboratory: &self.request.laboratory, observer: self.request.observer }
    }

    /// The record of a cell before it has run.
    pub(super) fn blank(&self, cell: &CellPlan, sampling: Sampling) -> Record {
        let (row, spec) = (self.plan.row(cell), &cell.frame);
        Record {
            schema: RECORD_SCHEMA,
            cell: cell.key.clone(),
            build: machine::build_id(),
            measuring: measuring().to_owned(),
            frames: cell.frames().cloned().collect(),
            study: self.request.study.name.clone(),
            scene: self.scene().id.clone(),
            sampling,
            photon_maps: None,
            spp: spec.spp,
            replicate: spec.replicate,
            frame_spp: (spec.samples() != spec.spp).then_some(spec.samples()),
            adaptive: None,
            method: row.method.id.clone(),
            label: row.label.clone(),
            params: row.method.params.clone(),
            outcome: Outcome::Done,
            metrics: BTreeMap::new(),
            metrics_reference_se: BTreeMap::new(),
            reference: BTreeMap::new(),
            class_reference: BTreeMap::new(),
            metrics_within_se: BTreeMap::new(),
            ratio_within_se: BTreeMap::new(),
            pixels: 0,
            pixels_of: 0,
            classes: BTreeMap::new(),
            coverage: Vec::new(),
            bounds: Vec::new(),
            enclosures: Vec::new(),
            error_estimate: None,
            answers: BTreeMap::new(),
            non_finite: NonFinite::default(),
            findings: Vec::new(),
            figures: BTreeMap::new(),
            seconds: Seconds { threads: rayon::current_num_threads() as u32, ..Seconds::default() },
            peak_memory_bytes: None,
            image: None,
            diagnostics: BTreeMap::new(),
            log: None,
            files: BTreeMap::new(),
        }
    }

    /// The neighbouring frames that some of the rows look at, by their distance.
    pub(super) fn beside(&self, cells: &[&CellPlan]) -> Result<BTreeMap<i64, Frame>, HarnessError> {
        let mut frames = BTreeMap::new();
        for (distance, spec) in cells.iter().flat_map(|cell| &cell.beside) {
            if let Some(moment) = self.scene().moment(*distance).filter(|_| !frames.contains_key(distance)) {
                let checked = moment.frame(spec, None, self.access())?;
                frames.insert(*distance, checked.frame);
            }
        }
        Ok(frames)
    }
}
