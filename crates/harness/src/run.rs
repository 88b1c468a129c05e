//! Plan → frames → denoise → measure → records → analysis.

mod cell;
mod claim;
mod denoise;
mod inputs;
mod levels;
mod prepare;
mod request;
mod runner;
mod scene;
mod self_check;
mod settle;

use std::collections::BTreeSet;

use noisefloor_questions::{Kept, summarise};
use noisefloor_study::Key;
use noisefloor_study::context::{Context, PlannedScene};
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;

use crate::cache::Cache;
use crate::error::HarnessError;
use crate::looks;
use crate::machine;
use crate::memory::check_memory;
use crate::observer::{Stage, Workload};
use crate::plan::Plan;
use crate::row::Row;
use crate::source::Scene;
use crate::store::{FolderImages, Layout, Lock, Records, read_json, write_json, write_json_lines};
use claim::{claim, open_records};
pub use request::StudyRun;
use settle::Settled;

/// Runs a study, or continues it: finished cells are kept, the others are run one after the other, each is on disk
/// before the next begins. Ends with the analysis, written to `summary.json` and returned.
///
/// Records that are of no use here, because study, size, a method or a metric changed, are set aside in the study's folder
/// and used again when they are asked for again; so are those of [`StudyRun::again`]. Kept files that are not what was
/// written are made again, and told.
///
/// A row whose inputs a frame does not have is skipped, one that ends in an error is failed; both are recorded with the
/// reason and do not stop the study. A violated enclosure does not stop it either, but is the first of
/// [`Summary::warnings`].
///
/// # Errors
/// Before any work: [`HarnessError::Method`], [`HarnessError::Study`], [`HarnessError::Folder`] and
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

    write_json_lines(&layout.plan(), &plan.items(study))?;
    let work = workload(&plan, &cache, &layout, &kept);
    let mut context = begin(request, &plan, &layout, &work)?;
    request.observer.planned(&work);
    context.self_check = self_check::self_check(request, run)?;
    write_json(&layout.context(), &context)?;
    for place in 0..plan.scenes.len() {
        let runner =
            runner::Runner { request, plan: &plan, layout: &layout, cache: &cache, place, owners: &owners };
        context.scenes.push(scene::run(&runner, &mut records, &kept)?);
    }
    order(&mut records, &plan)?;

    request.observer.stage(&Stage::Analysis);
    context.looks = looks::noted(&layout, &context, records.all())?;
    let images = FolderImages(layout.root());
    let summary = summarise(study, &context, records.all(), &Kept::Images(&images), machine::now());
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
    let methods = plan.rows.iter().map(Row::describe).collect();
    let planned = |scene: &Scene| PlannedScene { id: scene.id.clone(), replicates: scene.replicates() };
    let context = Context {
        command: request.command.clone(),
        environment,
        methods,
        plan: plan.scenes.iter().map(planned).collect(),
        scenes: Vec::new(),
        self_check: Vec::new(),
        flicker: Vec::new(),
        looks: Vec::new(),
    };
    write_json(&layout.context(), &context)?;
    Ok(context)
}

fn workload(plan: &Plan, cache: &Cache, layout: &Layout, kept: &BTreeSet<Key>) -> Workload {
    let mut work = Workload { kept: kept.len() as u64, ..Workload::default() };
    // Scenes of one sequence may share frames.
    let mut seen = BTreeSet::new();
    for (place, scene) in plan.scenes.iter().enumerate() {
        let mut open = false;
        for (frame, cells) in plan.work(place, kept) {
            open = true;
            for (distance, beside) in cells.iter().flat_map(|cell| &cell.beside) {
                if let Some(moment) = scene.moment(*distance).filter(|_| seen.insert(beside.key.clone())) {
                    work.samples += moment.samples(cache, std::iter::once(beside), false);
                }
            }
            if seen.insert(frame.key.clone()) {
                work.samples += scene.samples(cache, std::iter::once(frame), false);
            }
        }
        let reference = open || prepare::kept_context(layout, scene).is_none();
        work.samples += scene.samples(cache, std::iter::empty(), reference);
    }
    work.cells = plan.cells.iter().filter(|cell| !kept.contains(&cell.key)).count() as u64;
    work
}

/// Puts the records in plan order, which they leave when cells in the middle are run again.
fn order(records: &mut Records, plan: &Plan) -> Result<(), HarnessError> {
    let places = plan.places();
    let mut all: Vec<Record> = records.all().to_vec();
    all.sort_by_key(|record| places.get(record.cell.as_str()).copied());
    records.replace(all)
}
