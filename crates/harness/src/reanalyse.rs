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
/// that was stopped is analysed as far as it went.
///
/// `recompute` computes the metrics again from the kept images and references, as after a change of their definitions,
/// and replaces them in the records. Coverage, bounds, estimates of a method's own error and times stay as they were
/// recorded.
///
/// # Errors
/// [`HarnessError::Io`] or [`HarnessError::Kept`] if the folder is none of a study or a file of it is damaged,
/// [`HarnessError::Image`] for an image that cannot be read, [`HarnessError::Locked`] while the study is running.
pub fn reanalyse(dir: &Path, recompute: bool) -> Result<Summary, HarnessError> {
    let layout = Layout::new(dir);
    // First of all, so that a folder that is none of ours stays as it is.
    let study: Study = read_json(&layout.study())?;
    let _lock = Lock::take(&layout)?;
    let mut context: Context = read_json(&layout.context())?;
    for scene in &study.scenes {
        let path = dir.join(Layout::scene(&scene.id));
        if path.exists() {
            context.scenes.push(read_json(&path)?);
        }
    }
    let mut records = Records::open(&layout.records())?;
    if recompute {
        let mut all = records.all().to_vec();
        for scene in &context.scenes {
            measure_again(dir, scene, all.iter_mut().filter(|record| record.scene == scene.id))?;
        }
        records.replace(all)?;
    }
    let summary = analyse(&study, &context, records.all(), dir);
    write_json(&layout.summary(), &summary)?;
    Ok(summary)
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
