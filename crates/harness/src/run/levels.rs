//! What is measured over all replicates of a level, once its cells are done.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_questions::{
    LevelCell, LevelFound, LevelFrame, MeasureError, Outputs, PixelClasses, measure_level,
    measuring_of_levels,
};
use noisefloor_study::context::{LevelContext, SceneContext};
use noisefloor_study::record::{Outcome, Record};
use noisefloor_study::{Key, files, key_of};
use serde_json::json;

use crate::error::HarnessError;
use crate::plan::CellPlan;
use crate::run::prepare::truth;
use crate::run::runner::Runner;
use crate::source::{FrameKind, FrameSpec, Scene};
use crate::store::{Layout, Records, hash_of, read_json, whole, write_json};
use noisefloor_frame::Reference;

/// A level as it should be measured now.
struct Level<'a> {
    spp: u32,
    key: Key,
    frames: Vec<&'a FrameSpec>,
    /// Records with an image, by label.
    outputs: BTreeMap<String, Vec<Record>>,
}

/// Brings the scene's levels up to date: what is kept of the right frames and outputs stays, the others are measured.
/// `prepared` are reference and classes, if they are in memory.
pub(super) fn settle(
    runner: &Runner<'_>,
    records: &Records,
    prepared: Option<(&Reference, &PixelClasses)>,
    earlier: Vec<LevelContext>,
    context: &mut SceneContext,
) -> Result<(), HarnessError> {
    let levels = levels(runner, records);
    let (mut done, mut open) = (BTreeMap::new(), Vec::new());
    for level in levels {
        let same = earlier.iter().find(|kept| kept.key == level.key && kept.spp == level.spp);
        match same.filter(|kept| paths(kept).all(|path| whole(runner.layout.root(), path, &context.files))) {
            Some(kept) => drop(done.insert(level.spp, kept.clone())),
            None => open.push(level),
        }
    }
    if !open.is_empty() {
        let read;
        let (reference, classes) = match prepared {
            Some(prepared) => prepared,
            None => {
                read = truth(runner.scene(), runner.layout, runner.access())?.0;
                (&read.reference, &read.classes)
            }
        };
        for level in open {
            let measured = measure(runner, &level, (reference, classes), context)?;
            done.insert(level.spp, measured);
        }
    }
    let changed = context.levels.iter().map(|level| &level.key).ne(done.values().map(|level| &level.key));
    context.levels = done.into_values().collect();
    if changed {
        write_json(&runner.layout.ready(&files::scene(&context.id))?, context)?;
    }
    Ok(())
}

/// What an earlier run measured of the scene's levels, with the hashes of its pictures.
pub(super) fn earlier(layout: &Layout, scene: &Scene) -> (Vec<LevelContext>, BTreeMap<String, String>) {
    let Ok(kept) = read_json::<SceneContext>(&layout.root().join(files::scene(&scene.id))) else {
        return Default::default();
    };
    let of_maps: BTreeSet<&str> = kept.levels.iter().flat_map(paths).collect();
    let hashes = kept.files.iter().filter(|(path, _)| of_maps.contains(path.as_str()));
    (kept.levels.clone(), hashes.map(|(path, hash)| (path.clone(), hash.clone())).collect())
}

fn paths(level: &LevelContext) -> impl Iterator<Item = &str> {
    level.maps.values().flat_map(BTreeMap::values).map(String::as_str)
}

fn levels<'a>(runner: &Runner<'a>, records: &Records) -> Vec<Level<'a>> {
    let (plan, study) = (runner.plan, runner.request.study);
    let scene = &plan.scenes[runner.place];
    let cells = plan.cells.iter().filter(|cell| cell.scene == runner.place);
    let of_scene: BTreeMap<&str, &CellPlan> = cells.map(|cell| (cell.key.as_str(), cell)).collect();
    let mut outputs: BTreeMap<u32, BTreeMap<String, Vec<Record>>> = BTreeMap::new();
    for record in records.all() {
        let planned = of_scene.contains_key(record.cell.as_str());
        if planned && record.outcome == Outcome::Done && record.image.is_some() {
            let level = outputs.entry(record.spp).or_default();
            level.entry(record.label.clone()).or_default().push(record.clone());
        }
    }
    let mut by_level: BTreeMap<u32, Vec<&FrameSpec>> = BTreeMap::new();
    for frame in scene.frames.iter().filter(|frame| frame.kind == FrameKind::Uniform) {
        by_level.entry(frame.spp).or_default().push(frame);
    }
    let level = |(spp, frames): (u32, Vec<&'a FrameSpec>)| {
        let mut outputs = outputs.remove(&spp).unwrap_or_default();
        outputs.values_mut().for_each(|records| records.sort_by_key(|record| record.replicate));
        let cells: Vec<&str> = outputs.values().flatten().map(|record| record.cell.as_str()).collect();
        let key = key_of(&json!({
            "level": measuring_of_levels(),
            "reference": scene.reference_key,
            "known_mean": scene.known_mean,
            "frames": frames.iter().map(|frame| &frame.key).collect::<Vec<_>>(),
            "cells": cells,
            // A row may get another name and keep its cells.
            "rows": outputs.keys().collect::<Vec<_>>(),
            "coverage": study.coverage,
            "membership": study.membership,
            "viewer": study.viewer_spp.is_empty() || study.viewer_spp.contains(&spp),
        }));
        Level { spp, key, frames, outputs }
    };
    by_level.into_iter().map(level).collect()
}

fn measure(
    runner: &Runner<'_>,
    level: &Level<'_>,
    (reference, classes): (&Reference, &PixelClasses),
    context: &mut SceneContext,
) -> Result<LevelContext, HarnessError> {
    let scene = runner.scene();
    let mut frames = Vec::new();
    for spec in &level.frames {
        let checked = match scene.frame(spec, None, runner.access()) {
            // A frame that contradicts itself ended its own cells, and was told with them.
            Err(HarnessError::Unsound { .. }) => continue,
            checked => checked?,
        };
        let invalid = checked.hygiene.without_statistics();
        frames.push(LevelFrame { replicate: spec.replicate, frame: checked.frame, invalid });
    }
    let rows: Vec<String> =
        scene.rows.iter().map(|row| row.label.clone()).filter(|l| level.outputs.contains_key(l)).collect();
    let outputs = |label: &str| -> Outputs {
        let records = level.outputs.get(label).into_iter().flatten();
        let image = |record: &Record| {
            let path = runner.layout.root().join(record.image.as_ref()?);
            match noisefloor_io::read_color(&path) {
                Ok(image) => Some((record.replicate, image)),
                Err(error) => {
                    runner.request.observer.warning(&format!("{error}; the level is measured without it"));
                    None
                }
            }
        };
        records.filter_map(image).collect()
    };
    let cell = LevelCell {
        study: runner.request.study,
        scene: &scene.id,
        spp: level.spp,
        reference,
        reference_spp: scene.reference_spp,
        known_mean: scene.known_mean,
        classes,
        frames: &frames,
        intervals: runner.request.laboratory.intervals,
        rows: &rows,
        outputs: &outputs,
    };
    let found = measure_level(runner.request.laboratory.questions, &cell).map_err(|error| match error {
        MeasureError::Metric(source) => HarnessError::Metric { scene: scene.id.clone(), source },
        MeasureError::Shape(source) => HarnessError::Shape { scene: scene.id.clone(), source },
    })?;
    keep(runner, level, found, context)
}

/// Writes the pictures; numbers and paths are the level's.
fn keep(
    runner: &Runner<'_>,
    level: &Level<'_>,
    found: LevelFound,
    context: &mut SceneContext,
) -> Result<LevelContext, HarnessError> {
    let scene = runner.scene();
    let mut maps: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for map in found.maps {
        let slug = scene.rows.iter().find(|row| row.label == map.label).map_or("input", |row| &row.slug);
        let plain: String =
            map.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let relative = files::map(&scene.id, slug, level.spp, &plain);
        let path = runner.layout.ready(&relative)?;
        noisefloor_io::write_image(&path, &map.image, &BTreeMap::new())?;
        context.files.insert(relative.clone(), hash_of(&path)?);
        maps.entry(map.label).or_default().insert(map.name, relative);
    }
    Ok(LevelContext { spp: level.spp, key: level.key.clone(), answers: found.answers, maps })
}
