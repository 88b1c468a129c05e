//! Plan → frames → denoise → measure → records → analysis.

mod cell;
mod denoise;
mod inputs;
mod prepare;
mod settle;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use noisefloor_denoiser::Registry;

use crate::analysis::analyse;
use crate::cache::{Cache, Key, seed_of};
use crate::context::{Context, PlannedScene, Row as RowContext};
use crate::error::HarnessError;
use crate::machine;
use crate::memory::check_memory;
use crate::observer::{Observer, Stage, Workload};
use crate::plan::{Plan, Row};
use crate::record::Record;
use crate::source::{FrameSpec, Scene};
use crate::store::{Layout, Lock, Records, read_json, write_json};
use crate::study::{SceneSource, Study};
use crate::summary::{MethodSummary, Summary};
use settle::Settled;

/// Resampled images of the block bootstrap.
pub(crate) const BOOTSTRAP_IMAGES: usize = 200;

/// Random seed of a cell's bootstrap: the same for all rows of a frame, and whenever it is computed again.
pub(crate) fn bootstrap_seed(record: &Record) -> u64 {
    seed_of(&serde_json::json!({
        "purpose": "bootstrap", "scene": record.scene, "spp": record.spp, "replicate": record.replicate
    }))
}

/// A study to run, with everything it needs from outside.
pub struct StudyRun<'a> {
    /// The study.
    pub study: &'a Study,
    /// The methods that rows may name.
    pub registry: &'a Registry,
    /// Folder for records, images and summary; made if need be.
    pub out_dir: &'a Path,
    /// Folder for rendered frames, shared by all studies; made if need be.
    pub cache_dir: &'a Path,
    /// Columns and rows of rendered and synthetic scenes, instead of the study's.
    pub size: Option<(usize, usize)>,
    /// Labels of rows, or ids of methods, whose cells run again although they are finished.
    pub again: &'a [String],
    /// Command line, for the report.
    pub command: String,
    /// Instruction set that the kernels chose, for the report.
    pub simd: String,
    /// Is told how it goes, and may stop it.
    pub observer: &'a dyn Observer,
}

impl std::fmt::Debug for StudyRun<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("StudyRun")
            .field("study", &self.study.name)
            .field("out_dir", &self.out_dir)
            .field("cache_dir", &self.cache_dir)
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

/// Runs a study, or continues it: finished cells are kept, the others are run one after the other, each is on disk
/// before the next begins. Ends with the analysis, written to `summary.json` and returned.
///
/// Records that are of no use here, because study, size, a method or a metric changed, are set aside in the study's folder
/// and used again when they are asked for again; so are those of [`StudyRun::again`]. Kept files that are not what was
/// written are made again, and told.
///
/// A row whose inputs a frame does not have is skipped, one that ends in an error is failed; both are recorded with the
/// reason and do not stop the study. A violated enclosure does not stop it either, but is the first of
/// [`Summary::warnings`], see [`crate::violations`].
///
/// # Errors
/// Before any work: [`HarnessError::Method`], [`HarnessError::Scene`], [`HarnessError::Folder`] and
/// [`HarnessError::NoRow`] for names that do not exist, [`HarnessError::Memory`], [`HarnessError::Locked`],
/// [`HarnessError::OtherStudy`]. Later: [`HarnessError::Io`] and
/// [`HarnessError::Image`] for a full disk or an unwritable folder, [`HarnessError::Cancelled`]. Finished cells are
/// intact after any of them.
pub fn run(request: &StudyRun<'_>) -> Result<Summary, HarnessError> {
    let study = request.study;
    check_memory(study, request.registry, request.size)?;
    let plan = Plan::new(study, request.registry, request.size)?;
    settle::check_again(request, &plan)?;
    let layout = Layout::new(request.out_dir);
    let _lock = Lock::take(&layout)?;
    claim(&layout, study, request.observer)?;
    let cache = Cache::open(request.cache_dir)?;
    layout.sweep();
    let mut records = open_records(&layout, request.observer)?;
    let Settled { kept, owners } = settle::settle(request, &layout, &plan, &mut records)?;

    let work = workload(study, &plan, &cache, &layout, &kept);
    let mut context = begin(request, &plan, &layout, &work)?;
    request.observer.planned(&work);
    for scene in &plan.scenes {
        let runner =
            cell::Runner { request, plan: &plan, layout: &layout, cache: &cache, scene, owners: &owners };
        context.scenes.push(runner.run(&mut records, &kept)?);
    }
    order(&mut records, study, &plan)?;

    request.observer.stage(&Stage::Analysis);
    let summary = analyse(study, &context, records.all(), layout.root(), false);
    write_json(&layout.summary(), &summary)?;
    Ok(summary)
}

/// Describes machine and rows, on disk before any work. A run that finds everything finished keeps the description of
/// the one that did the work, because the times are from there.
fn begin(
    request: &StudyRun<'_>,
    plan: &Plan,
    layout: &Layout,
    work: &Workload,
) -> Result<Context, HarnessError> {
    let earlier: Option<Context> = read_json(&layout.context()).ok();
    let environment = match earlier {
        Some(context) if work.cells == 0 => context.environment,
        _ => machine::environment(&request.simd),
    };
    let methods = plan.rows.iter().map(describe).collect();
    let planned = |scene: &Scene| PlannedScene { id: scene.id.clone(), replicates: scene.replicates() };
    let context = Context {
        command: request.command.clone(),
        environment,
        methods,
        plan: plan.scenes.iter().map(planned).collect(),
        scenes: Vec::new(),
        flicker: Vec::new(),
    };
    write_json(&layout.context(), &context)?;
    Ok(context)
}

/// Refuses a folder that belongs to another study; writes the study into it.
fn claim(layout: &Layout, study: &Study, observer: &dyn Observer) -> Result<(), HarnessError> {
    let path = layout.study();
    match name_there(layout)? {
        Named::As(found) if found != study.name => {
            return Err(HarnessError::OtherStudy {
                path: layout.root().to_owned(),
                found,
                wanted: study.name.clone(),
            });
        }
        Named::As(_) | Named::Nobody => {}
        Named::Unreadable(why) => observer.warning(&format!("{}: {why}; written again", path.display())),
    }
    // Where a folder of frames stood on this machine says nothing elsewhere, and nothing here reads it again.
    let mut kept = study.clone();
    for scene in &mut kept.scenes {
        if let SceneSource::Folder(folder) = &mut scene.source {
            *folder = folder.file_name().map(PathBuf::from).unwrap_or_default();
        }
    }
    write_json(&path, &kept)
}

/// The records so far. Lines that cannot be read are set aside and told; their cells run again.
fn open_records(layout: &Layout, observer: &dyn Observer) -> Result<Records, HarnessError> {
    let (records, damaged) = Records::open(&layout.records(), &layout.damaged())?;
    for line in damaged {
        observer.warning(&format!(
            "{}, line {}: {}; set aside in {}",
            layout.records().display(),
            line.line,
            line.why,
            file_name(&layout.damaged())
        ));
    }
    Ok(records)
}

/// A file's name without its folder, for a sentence that has named the folder.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whose folder it is.
enum Named {
    Nobody,
    As(String),
    /// The study's description is damaged, and there is no record that would tell.
    Unreadable(String),
}

/// The study that a folder belongs to: what its description says, else what its records say.
fn name_there(layout: &Layout) -> Result<Named, HarnessError> {
    match read_json::<Study>(&layout.study()) {
        Ok(study) => Ok(Named::As(study.name)),
        Err(HarnessError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
            Ok(Named::Nobody)
        }
        Err(HarnessError::Kept { message, .. }) => {
            let record = Records::read(&layout.records())?.records.into_iter().next();
            Ok(record.map_or(Named::Unreadable(message), |record| Named::As(record.study)))
        }
        Err(other) => Err(other),
    }
}

/// All cells in plan order.
fn cells<'a>(
    study: &'a Study,
    plan: &'a Plan,
) -> impl Iterator<Item = ((&'a Scene, FrameSpec, &'a Row), Key)> {
    plan.scenes.iter().flat_map(move |scene| {
        scene.frames.iter().flat_map(move |frame| {
            scene.rows.iter().map(move |row| {
                let own = scene.frame_of(frame, row);
                let key = plan.cell_key(study, scene, &own, row);
                ((scene, own, row), key)
            })
        })
    })
}

fn workload(study: &Study, plan: &Plan, cache: &Cache, layout: &Layout, kept: &BTreeSet<Key>) -> Workload {
    let mut work = Workload { kept: kept.len() as u64, ..Workload::default() };
    // Scenes of one sequence may share frames.
    let mut seen = BTreeSet::new();
    for scene in &plan.scenes {
        let mut open = false;
        for (frame, rows) in cell::frames(study, plan, scene, kept) {
            open = true;
            for (distance, beside) in rows.iter().flat_map(|(row, _)| scene.beside(&frame, row)) {
                if let Some(moment) = scene.moment(distance).filter(|_| seen.insert(beside.key.clone())) {
                    work.samples += moment.samples(cache, std::iter::once(&beside), false);
                }
            }
            if seen.insert(frame.key.clone()) {
                work.samples += scene.samples(cache, std::iter::once(&frame), false);
            }
        }
        let reference = open || prepare::kept_context(layout, scene).is_none();
        work.samples += scene.samples(cache, std::iter::empty(), reference);
    }
    work.cells = cells(study, plan).filter(|(_, key)| !kept.contains(key)).count() as u64;
    work
}

/// Puts the records in plan order, which they leave when cells in the middle are run again.
fn order(records: &mut Records, study: &Study, plan: &Plan) -> Result<(), HarnessError> {
    let place: BTreeMap<Key, usize> =
        cells(study, plan).enumerate().map(|(index, (_, key))| (key, index)).collect();
    let mut all: Vec<Record> = records.all().to_vec();
    all.sort_by_key(|record| place.get(&record.cell).copied());
    records.replace(all)
}

fn describe(row: &Row) -> RowContext {
    let card = &row.card;
    RowContext {
        summary: MethodSummary {
            label: row.label.clone(),
            method: row.method.id.clone(),
            name: card.name.clone(),
            citation: card.citation.key.to_string(),
            reference: card.citation.text.to_string(),
            params: row.method.params.clone(),
            notes: card.notes.clone(),
            frames: row.frames.clone(),
            estimates_error: card.claims.estimates_error,
        },
        consistent: card.claims.consistent,
    }
}
