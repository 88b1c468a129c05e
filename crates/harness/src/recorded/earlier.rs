//! Recordings of earlier programs: `results.jsonl` beside `summary.json`.

use std::collections::BTreeSet;
use std::path::Path;

use noisefloor_frame::Sampling;

use crate::error::HarnessError;
use crate::recorded::KeptStudy;
use crate::store::{Layout, Records, read_json};
use noisefloor_study::Study;
use noisefloor_study::context::{Context, Files, PlannedScene, ReferenceContext, RowContext, SceneContext};
use noisefloor_study::record::Record;
use noisefloor_study::summary::{SceneSummary, Summary};

/// Reads a recording of a built-in study; what else the study was is not in such a recording.
pub(super) fn read(dir: &Path) -> Result<KeptStudy, HarnessError> {
    let layout = Layout::new(dir);
    let not = |missing: &str, hint: String| HarnessError::NotAStudy {
        path: dir.to_owned(),
        missing: missing.to_owned(),
        hint,
    };
    if !layout.summary().is_file() || !layout.records().is_file() {
        return Err(not(
            "study.json",
            "a study's folder is made by `noisefloor run`, a recorded one by `noisefloor record`".into(),
        ));
    }
    let summary: Summary = read_json(&layout.summary())?;
    let name = &summary.study.name;
    let again =
        format!("run it again with `{}` and record it with `noisefloor record`", summary.study.command);
    let Ok(study) = Study::builtin(name) else {
        let hint = format!(
            "it is a recording of an earlier program of the study `{name}`, which is not built in; {again}"
        );
        return Err(not("study.json", hint));
    };
    let records = Records::read(&layout.records())?.whole_or_error(&layout.records())?;
    if let Some(record) = records.iter().find(|record| !asks_for(&study, record)) {
        let hint = format!(
            "it is a recording of an earlier program, and the built-in study `{name}` does not ask for {} on {} at {} spp any \
             more; {again}",
            record.label, record.scene, record.spp
        );
        return Err(not("study.json", hint));
    }
    Ok(KeptStudy { context: context(&study, &summary, &records), study, records, recorded: true })
}

fn asks_for(study: &Study, record: &Record) -> bool {
    let scene = study.scenes.iter().find(|scene| scene.id == record.scene);
    scene.is_some_and(|scene| {
        study.levels(scene).contains(&record.spp) && record.replicate < study.replicates(scene, record.spp)
    }) && study.methods.iter().any(|row| row.label == record.label)
}

fn context(study: &Study, summary: &Summary, records: &[Record]) -> Context {
    let plan = study.scenes.iter().map(|scene| PlannedScene {
        id: scene.id.clone(),
        replicates: study.levels(scene).iter().map(|&n| (n, study.replicates(scene, n))).collect(),
    });
    let scenes = summary.scenes.iter().filter_map(|scene| {
        let first = records.iter().find(|record| record.scene == scene.id)?;
        Some(of_scene(scene, first.sampling))
    });
    Context {
        command: summary.study.command.clone(),
        environment: summary.environment.clone(),
        // What the card claims about convergence is not in a summary, and the analysis does not ask.
        methods: summary
            .methods
            .iter()
            .map(|m| RowContext { summary: m.clone(), consistent: false })
            .collect(),
        plan: plan.collect(),
        scenes: scenes.collect(),
        self_check: Vec::new(),
        flicker: Vec::new(),
        looks: Vec::new(),
    }
}

fn of_scene(scene: &SceneSummary, sampling: Sampling) -> SceneContext {
    let reference = &scene.reference;
    SceneContext {
        id: scene.id.clone(),
        title: scene.title.clone(),
        about: scene.about.clone(),
        width: scene.width as usize,
        height: scene.height as usize,
        sampling,
        settings: scene.settings.clone(),
        maps: None,
        replicates: scene.replicates.clone(),
        classes: scene.classes.iter().map(|(name, pixels)| (name.clone(), *pixels)).collect(),
        reference: ReferenceContext {
            key: String::new(),
            spp: reference.spp,
            parts: reference.parts,
            sampling: reference.sampling.clone(),
            exact: reference.is_exact(),
            correction: reference.correction.clone(),
            floor: reference.floor.clone(),
        },
        measuring: String::new(),
        files: Files::default(),
        damaged: BTreeSet::new(),
        findings: Vec::new(),
        levels: Vec::new(),
    }
}
