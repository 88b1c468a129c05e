//! The analysis again, from what a study's folder keeps.

use std::collections::BTreeSet;
use std::path::Path;

use noisefloor_frame::{Finding, FindingKind, sorted_findings};
use noisefloor_io::{ReadOptions, read_color, read_image, read_reference};
use noisefloor_metrics::{Classes, Measurer};

use crate::error::HarnessError;
use crate::looks;
use crate::machine;
use crate::recorded::KeptStudy;
use crate::store::{FolderImages, Layout, Lock, Records, Superseded, damaged, read_json, whole, write_json};
use noisefloor_questions::{Kept as Where, PixelClasses, measure_metrics, measuring, summarise};
use noisefloor_study::context::{Context, SceneContext};
use noisefloor_study::files;
use noisefloor_study::record::Record;
use noisefloor_study::summary::Summary;
use noisefloor_study::{Study, metric};

/// Makes the analysis of a study's folder again and writes `summary.json`. Nothing is rendered or denoised; a study
/// that was stopped, or is running, is analysed as far as it went.
///
/// `recompute` computes the metrics again from the kept images and references, as after a change of their definitions,
/// and replaces them in the records. Coverage, bounds, estimates of a method's own error and times stay as they were
/// recorded.
///
/// Kept files that are not what was written, and lines of the records that cannot be read, are among
/// [`Summary::findings`]; what needs them is left out.
///
/// # Errors
/// [`HarnessError::Io`] or [`HarnessError::Kept`] if the folder is none of a study or its description is damaged,
/// [`HarnessError::Locked`] if records are to be replaced while the study is running.
pub fn reanalyse(dir: &Path, recompute: bool) -> Result<Summary, HarnessError> {
    reanalyse_into(dir, dir, recompute)
}

/// Like [`reanalyse`], with `summary.json` written into the folder `out`, which is made if need be. Of the study's folder
/// nothing is changed unless `out` is that very folder: numbers that are computed again are then in the summary alone.
///
/// # Errors
/// As [`reanalyse`]; [`HarnessError::Io`] also if `out` cannot be made or written.
pub fn reanalyse_into(dir: &Path, out: &Path, recompute: bool) -> Result<Summary, HarnessError> {
    let layout = Layout::new(dir);
    if let Some(kept) = KeptStudy::of_recording(dir)? {
        if recompute {
            return Err(HarnessError::NotAStudy {
                path: dir.to_owned(),
                missing: "images".into(),
                hint: "a recorded study keeps numbers only, and metrics cannot be computed again".into(),
            });
        }
        let summary = kept.summary(dir);
        std::fs::create_dir_all(out).map_err(HarnessError::io("make folder", out))?;
        write_json(&Layout::new(out).summary(), &summary)?;
        return Ok(summary);
    }
    // First of all, so that a folder that is none of ours stays as it is.
    let study: Study = read_json(&layout.study())?;
    std::fs::create_dir_all(out).map_err(HarnessError::io("make folder", out))?;
    let here = same_folder(dir, out);
    // Records only ever grow, line by line: reading them needs no lock.
    let _lock = (here && recompute).then(|| Lock::take(&layout)).transpose()?;
    let mut context: Context = read_json(&layout.context())?;
    let mut kept = Kept { dir, findings: Vec::new() };
    context.scenes = study.scenes.iter().filter_map(|scene| kept.scene(&scene.id)).collect();
    let found = Records::read(&layout.records())?;
    for line in &found.damaged {
        kept.tell(
            format!("results.jsonl, line {}", line.line),
            format!("{}: its cell is left out", line.why),
        );
    }
    let mut all = found.records;
    let damaged = kept.images(&all);
    if recompute {
        for scene in &context.scenes {
            let whole = |record: &&mut Record| {
                record.scene == scene.id && !record.image.as_ref().is_some_and(|path| damaged.contains(path))
            };
            measure_again(dir, &study, scene, all.iter_mut().filter(whole))?;
        }
        if here {
            replace(&layout, &all)?;
        }
    }
    for record in &mut all {
        record.image.take_if(|path| damaged.contains(path));
        record.diagnostics.retain(|_, path| !damaged.contains(path));
        record.log.take_if(|path| damaged.contains(path));
    }
    context.looks = if here { looks::noted(&layout, &context, &all)? } else { looks::read(&layout) };
    let images = Where::Images(&FolderImages(dir));
    let mut summary = summarise(&study, &context, &all, &images, machine::now());
    summary.findings = sorted_findings(kept.findings.into_iter().chain(summary.findings));
    write_json(&Layout::new(out).summary(), &summary)?;
    Ok(summary)
}

/// Puts records with other numbers into the place of those that they were made from, which are set aside.
fn replace(layout: &Layout, records: &[Record]) -> Result<(), HarnessError> {
    let (mut old, _) = Records::open(&layout.records(), &layout.damaged())?;
    let changed = old.all().iter().filter(|record| !records.contains(record)).cloned().collect();
    Superseded::read(&layout.superseded())?.add(changed)?;
    old.replace(records.to_vec())
}

/// Damaged images that are named one by one.
const MOST_NAMED: usize = 8;

/// Looks at kept files before they are used.
struct Kept<'a> {
    dir: &'a Path,
    findings: Vec<Finding>,
}

impl Kept<'_> {
    fn tell(&mut self, subject: String, text: String) {
        let text = format!("{text}; a new run makes it again");
        self.findings.push(Finding::new(FindingKind::DamagedFile, subject, text));
    }

    /// A scene's description without the files that are not what was written; `None` where there is none.
    fn scene(&mut self, id: &str) -> Option<SceneContext> {
        let description = files::scene(id);
        let path = self.dir.join(&description);
        if !path.exists() {
            return None;
        }
        let mut scene: SceneContext = match read_json(&path) {
            Ok(scene) => scene,
            Err(error) => {
                self.tell(description, format!("cannot be read ({error}): the scene is left out"));
                return None;
            }
        };
        for file in damaged(self.dir, &scene.files) {
            let lost =
                "is not what was written, or is gone: its picture and what is computed from it are left out";
            scene.files.remove(&file);
            scene.damaged.insert(file.clone());
            self.tell(file, lost.into());
        }
        Some(scene)
    }

    /// The images of records that are not what was written, or gone.
    fn images(&mut self, records: &[Record]) -> BTreeSet<String> {
        let mut out = BTreeSet::new();
        for record in records {
            for path in record.paths().filter(|path| !whole(self.dir, path, &record.files)) {
                out.insert(path.to_owned());
            }
        }
        for path in out.iter().take(MOST_NAMED) {
            self.tell(path.clone(), "is not what was written, or is gone: it is left out".into());
        }
        if let Some(more) = out.len().checked_sub(MOST_NAMED + 1) {
            self.tell("images".into(), format!("{} more are not what was written, or are gone", more + 1));
        }
        out
    }
}

/// Whether two paths lead to one folder; links are followed.
fn same_folder(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}

fn measure_again<'a>(
    dir: &Path,
    study: &Study,
    scene: &SceneContext,
    records: impl Iterator<Item = &'a mut Record>,
) -> Result<(), HarnessError> {
    if !scene.damaged.is_empty() {
        // Told; the numbers stay as they were recorded.
        return Ok(());
    }
    let options = ReadOptions { spp: Some(1), ..ReadOptions::default() };
    let reference = read_reference(dir.join(files::reference(&scene.id)), &options)?;
    let names: Vec<String> = scene.classes.iter().map(|(name, _)| name.clone()).collect();
    let path = dir.join(files::classes(&scene.id));
    let classes = PixelClasses::from_image(names, &read_image(&path)?)
        .map_err(|source| HarnessError::Classes { path: path.clone(), source })?;
    let map = Classes { names: &classes.names, of_pixel: &classes.of_pixel };
    let wrong = |source| HarnessError::Metric { scene: scene.id.clone(), source };
    let measurer = Measurer::new(&reference, Some(map)).map_err(wrong)?;
    let measurer = measurer.with(&metric::asked(&study.metrics));
    let lacks_parts = reference.parts.len() < scene.reference.parts as usize;
    for record in records {
        let Some(relative) = &record.image else { continue };
        let image = read_color(dir.join(relative))?;
        let earlier = std::mem::take(&mut record.metrics_reference_se);
        let single = !record.metrics_within_se.is_empty();
        measure_metrics(&measurer, &image, single, record).map_err(wrong)?;
        record.measuring = measuring().to_owned();
        // Pixels that were invalid on input are marked in the kept image, in all channels.
        let marked = 3 * record.non_finite.input_pixels;
        record.non_finite.output_values = image.count_non_finite().saturating_sub(marked);
        // Earlier versions did not keep the parts that these were made from.
        if lacks_parts && !earlier.is_empty() {
            record.metrics_reference_se = earlier;
        }
    }
    Ok(())
}
