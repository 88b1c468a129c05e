//! The analysis again, from what a study's folder keeps.

use std::path::Path;

use noisefloor_io::{ReadOptions, read_color, read_image, read_reference};
use noisefloor_metrics::{Classes, Measurer, block_bootstrap};

use crate::analysis::analyse;
use crate::context::{Context, SceneContext};
use crate::error::HarnessError;
use crate::record::Record;
use crate::source::PixelClasses;
use crate::store::{Layout, Lock, Records, read_json, write_json};
use crate::study::Study;
use crate::summary::Summary;

/// Makes the analysis of a study's folder again and writes `summary.json`. Nothing is rendered or denoised; a study
/// that was stopped, or is running, is analysed as far as it went.
///
/// `recompute` computes the metrics again from the kept images and references, as after a change of their definitions,
/// and replaces them in the records. Coverage, bounds, estimates of a method's own error and times stay as they were
/// recorded.
///
/// # Errors
/// [`HarnessError::Io`] or [`HarnessError::Kept`] if the folder is none of a study or a file of it is damaged,
/// [`HarnessError::Image`] for an image that cannot be read, [`HarnessError::Locked`] if records are to be replaced while
/// the study is running.
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
    // First of all, so that a folder that is none of ours stays as it is.
    let study: Study = read_json(&layout.study())?;
    std::fs::create_dir_all(out).map_err(HarnessError::io("make folder", out))?;
    let here = same_folder(dir, out);
    // Records only ever grow, line by line: reading them needs no lock.
    let _lock = (here && recompute).then(|| Lock::take(&layout)).transpose()?;
    let mut context: Context = read_json(&layout.context())?;
    for scene in &study.scenes {
        let path = dir.join(Layout::scene(&scene.id));
        if path.exists() {
            context.scenes.push(read_json(&path)?);
        }
    }
    let mut all = Records::read(&layout.records())?.records;
    if recompute {
        for scene in &context.scenes {
            measure_again(dir, scene, all.iter_mut().filter(|record| record.scene == scene.id))?;
        }
        if here {
            Records::open(&layout.records())?.replace(all.clone())?;
        }
    }
    let summary = analyse(&study, &context, &all, dir);
    write_json(&Layout::new(out).summary(), &summary)?;
    Ok(summary)
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
    scene: &SceneContext,
    records: impl Iterator<Item = &'a mut Record>,
) -> Result<(), HarnessError> {
    let options = ReadOptions { spp: Some(1) };
    let reference = read_reference(dir.join(Layout::reference(&scene.id)), &options)?;
    let names: Vec<String> = scene.classes.iter().map(|(name, _)| name.clone()).collect();
    let path = dir.join(Layout::classes(&scene.id));
    let classes = PixelClasses::from_image(names, &read_image(&path)?, &path)?;
    let map = Classes { names: &classes.names, of_pixel: &classes.of_pixel };
    let wrong = |source| HarnessError::Metric { scene: scene.id.clone(), source };
    let measurer = Measurer::new(&reference, Some(map)).map_err(wrong)?;
    for record in records {
        let Some(relative) = &record.image else { continue };
        let image = read_color(dir.join(relative))?;
        let measured = measurer.measure(&image).map_err(wrong)?;
        record.metrics = measured.values;
        (record.pixels, record.pixels_of) = (measured.pixels as u64, measured.pixels_of as u64);
        record.classes = measured.classes;
        record.non_finite.output_values = measured.non_finite_values;
        if record.metrics_reference_se.is_empty() {
            record.metrics_reference_se = measured.reference_se;
        }
        if !record.metrics_within_se.is_empty() {
            let images = crate::run::BOOTSTRAP_IMAGES;
            record.metrics_within_se =
                block_bootstrap(&measurer, &image, images, crate::run::bootstrap_seed(record))
                    .map_err(wrong)?;
        }
    }
    Ok(())
}
