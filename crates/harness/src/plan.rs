//! Everything that will be done, as one list, made once before anything is done.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_denoiser::Registry;
use noisefloor_questions::{measuring, measuring_of, measuring_of_intervals};
use noisefloor_study::plan::{Item, PLAN_SCHEMA, PlannedCell, PlannedFrame};
use noisefloor_study::record::RECORD_SCHEMA;
use noisefloor_study::{BASELINE, Key, Place, Study, StudyError, key_of, metric};
use serde_json::json;

use crate::error::HarnessError;
use crate::fingerprint::Fingerprints;
use crate::row::{Row, rows};
use crate::source::{FrameSpec, Scene, recorded};

/// Scenes, rows and cells: scene × spp × replicate × row, in the order in which they run.
pub(crate) struct Plan {
    pub(crate) scenes: Vec<Scene>,
    pub(crate) rows: Vec<Row>,
    pub(crate) cells: Vec<CellPlan>,
}

/// A row on a frame.
pub(crate) struct CellPlan {
    /// Place of the scene.
    pub(crate) scene: usize,
    /// Place of the row, in the scene's rows as in the study's.
    pub(crate) row: usize,
    /// Place of the study's own frame, whose level and replicate it has, among the scene's.
    pub(crate) of: usize,
    /// The frame that the row gets.
    pub(crate) frame: FrameSpec,
    /// Frames at neighbouring moments that the row looks at, by their distance.
    pub(crate) beside: Vec<(i64, FrameSpec)>,
    /// Hash of all that determines the cell's numbers.
    pub(crate) key: Key,
}

impl CellPlan {
    /// Keys of its frame and of the neighbouring ones.
    pub(crate) fn frames(&self) -> impl Iterator<Item = &Key> {
        std::iter::once(&self.frame.key).chain(self.beside.iter().map(|(_, frame)| &frame.key))
    }
}

/// A frame with the cells that are to run on it.
pub(crate) type FrameWork<'a> = (&'a FrameSpec, Vec<&'a CellPlan>);

impl Plan {
    /// Looks up every name, so that a mistake is told before any work.
    pub(crate) fn new(
        study: &Study,
        registry: &Registry,
        size: Option<(usize, usize)>,
    ) -> Result<Self, HarnessError> {
        let mut fingerprints = Fingerprints::default();
        let all = rows(study, registry, None, &mut fingerprints)?;
        let recorded = recorded(all.iter().map(|row| &row.card));
        let mut scenes = Vec::new();
        for spec in &study.scenes {
            let mut scene = Scene::open(study, spec, size, &recorded)?;
            scene.rows = rows(study, registry, Some(spec), &mut fingerprints)?;
            known_features(study, &scene)?;
            scene.open_beside(study, spec, size, &recorded)?;
            scenes.push(scene);
        }
        same_sizes(study, &scenes)?;
        let cells = scenes.iter().enumerate().flat_map(|(place, scene)| cells(study, place, scene)).collect();
        Ok(Self { scenes, rows: all, cells })
    }

    /// The row of a cell, with the parameters that it has on the cell's scene.
    pub(crate) fn row(&self, cell: &CellPlan) -> &Row {
        &self.scenes[cell.scene].rows[cell.row]
    }

    /// Frames of a scene with the cells that are still to run on them: the study's own frames first, then each row's own.
    pub(crate) fn work(&self, scene: usize, kept: &BTreeSet<Key>) -> Vec<FrameWork<'_>> {
        let mut out: Vec<FrameWork<'_>> = Vec::new();
        // In the order of the scenes.
        let first = self.cells.partition_point(|cell| cell.scene < scene);
        let of_scene = self.cells[first..].iter().take_while(|cell| cell.scene == scene);
        for cell in of_scene.filter(|cell| !kept.contains(&cell.key)) {
            let mut near = out.iter_mut().rev().take_while(|(_, cells)| cells[0].of == cell.of);
            match near.find(|(frame, _)| frame.key == cell.frame.key) {
                Some((_, cells)) => cells.push(cell),
                None => out.push((&cell.frame, vec![cell])),
            }
        }
        out
    }

    /// The list for others to read, in the order in which it is worked off.
    pub(crate) fn items(&self, study: &Study) -> Vec<Item> {
        let mut items = Vec::new();
        let mut seen = BTreeSet::new();
        for (place, scene) in self.scenes.iter().enumerate() {
            items.extend(scene.reference_ranges().into_iter().map(Item::Reference));
            for (frame, cells) in self.work(place, &BTreeSet::new()) {
                if seen.insert(frame.key.clone()) {
                    items.push(Item::Frame(planned_frame(scene, frame)));
                }
                for cell in cells {
                    for (distance, beside) in &cell.beside {
                        if let Some(moment) =
                            scene.moment(*distance).filter(|_| seen.insert(beside.key.clone()))
                        {
                            items.push(Item::Frame(planned_frame(moment, beside)));
                        }
                    }
                    items.push(Item::Cell(planned_cell(study, scene, self.row(cell), cell)));
                }
            }
        }
        let head = Item::Study { schema: PLAN_SCHEMA, study: study.name.clone(), items: items.len() };
        std::iter::once(head).chain(items).collect()
    }

    /// Where each cell stands in the list.
    pub(crate) fn places(&self) -> BTreeMap<&str, usize> {
        self.cells.iter().enumerate().map(|(place, cell)| (cell.key.as_str(), place)).collect()
    }
}

fn cells(study: &Study, place: usize, scene: &Scene) -> Vec<CellPlan> {
    let mut out = Vec::new();
    for (of, frame) in scene.frames.iter().enumerate() {
        for (index, row) in scene.rows.iter().enumerate() {
            let frame = scene.frame_of(frame, row);
            let beside: Vec<(i64, FrameSpec)> = scene.beside(&frame, row).collect();
            let key = cell_key(study, scene, &frame, row, &beside);
            out.push(CellPlan { scene: place, row: index, of, frame, beside, key });
        }
    }
    out
}

/// Content hash of all that determines the numbers of a cell. Methods and metrics are in it by what they give, so that
/// neither a program that is built again nor one that gives other numbers is taken for the other.
fn cell_key(study: &Study, scene: &Scene, frame: &FrameSpec, row: &Row, beside: &[(i64, FrameSpec)]) -> Key {
    let mut all = json!({
        "record": RECORD_SCHEMA,
        // What a record says it is of, even where two cells have equal frames.
        "cell": json!([scene.id, frame.spp, frame.replicate]),
        "measuring": measuring(),
        "frame": frame.key,
        "reference": scene.reference_key,
        "method": row.method.id,
        "fingerprint": row.fingerprint,
        "params": row.method.params,
        "label": row.label,
        "coverage": study.coverage,
        "timing": study.timing,
        "diagnostics": wants_diagnostics(study, frame).then(|| json!([study.probe])),
        "within": scene.single(),
    });
    // Cells without neighbouring frames keep the keys that they had when there were none.
    if !beside.is_empty() {
        all["beside"] = json!(beside.iter().map(|(_, frame)| &frame.key).collect::<Vec<_>>());
    }
    // Other families of intervals are measured of the input alone.
    if !study.intervals.is_empty() && row.method.id == BASELINE {
        let families = study.interval_families();
        let found: BTreeMap<&str, Key> =
            families.iter().map(|family| (family.id(), measuring_of_intervals(*family))).collect();
        all["intervals"] = json!(found);
    }
    // Nor does a metric change the keys of studies that do not list it, unless it is always measured.
    let asked = metric::asked(&study.metrics);
    let asked: BTreeMap<&str, Key> = asked.iter().map(|asked| (asked.id, measuring_of(asked))).collect();
    if !asked.is_empty() {
        all["metrics"] = json!(asked);
    }
    key_of(&all)
}

fn planned_frame(scene: &Scene, frame: &FrameSpec) -> PlannedFrame {
    PlannedFrame {
        scene: scene.id.clone(),
        spp: frame.spp,
        replicate: frame.replicate,
        placed: frame.kind.placed(),
        key: frame.key.clone(),
        seed: frame.seed,
        samples: scene.camera_samples(u64::from(frame.samples())),
    }
}

fn planned_cell(study: &Study, scene: &Scene, row: &Row, cell: &CellPlan) -> PlannedCell {
    let runs = study.timing.warmup + study.timing.runs.max(1);
    let runs = runs + u32::from(wants_diagnostics(study, &cell.frame));
    let megapixels = (scene.width * scene.height) as f64 * 1e-6;
    PlannedCell {
        scene: scene.id.clone(),
        spp: cell.frame.spp,
        replicate: cell.frame.replicate,
        label: row.label.clone(),
        key: cell.key.clone(),
        frame: cell.frame.key.clone(),
        beside: cell.beside.iter().map(|(_, frame)| frame.key.clone()).collect(),
        seconds: row.card.cost.seconds() * megapixels * f64::from(runs),
    }
}

/// Diagnostics are kept for one replicate at the levels that the viewer shows.
pub(crate) fn wants_diagnostics(study: &Study, frame: &FrameSpec) -> bool {
    frame.replicate == 0 && (study.viewer_spp.is_empty() || study.viewer_spp.contains(&frame.spp))
}

/// Features that rows name must mean something: a misspelt one would run without and say nothing.
fn known_features(study: &Study, scene: &Scene) -> Result<(), HarnessError> {
    for (row, line) in scene.rows.iter().zip(study.methods.iter().map(|row| row.line)) {
        let there = scene.extra_features.iter().map(String::as_str);
        if let Some((name, nearest)) = row.card.unknown_feature(there) {
            return Err(StudyError::Field {
                place: Place::of_study(&study.name, line),
                field: format!("row `{}`: feature on scene `{}`", row.label, scene.id),
                value: format!("`{name}`"),
                allowed: format!(
                    "features with a fixed meaning or in the scene's files; nearest: {}",
                    nearest.join(", ")
                ),
            }
            .into());
        }
    }
    Ok(())
}

/// Frames of a sequence are compared pixel by pixel.
fn same_sizes(study: &Study, scenes: &[Scene]) -> Result<(), HarnessError> {
    for (name, frames) in study.sequences() {
        let of_sequence = scenes.iter().filter(|scene| frames.iter().any(|frame| frame.id == scene.id));
        let sizes: BTreeSet<(usize, usize)> = of_sequence.map(|s| (s.width, s.height)).collect();
        if sizes.len() > 1 {
            let told: Vec<String> = sizes.iter().map(|(w, h)| format!("{w}×{h}")).collect();
            return Err(StudyError::Field {
                place: Place::of_study(&study.name, None),
                field: format!("sequence `{name}`: size"),
                value: told.join(" and "),
                allowed: "one size for all frames".into(),
            }
            .into());
        }
    }
    Ok(())
}
