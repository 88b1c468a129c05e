//! Metrics of a cell, and how sure they are within one image.

use noisefloor_frame::Image;
use noisefloor_metrics::{Measurer, MetricError, block_bootstrap};
use noisefloor_study::record::Record;
use noisefloor_study::{BASELINE, seed_of};

use super::ratio::ratio_within_se;
use crate::cell::{Cell, MeasureError};

/// Resampled images of the block bootstrap.
pub const BOOTSTRAP_IMAGES: usize = 200;

/// Random seed of a cell's bootstrap: the same for all rows of a frame, and whenever it is computed again.
#[must_use]
pub fn bootstrap_seed(record: &Record) -> u64 {
    seed_of(&serde_json::json!({
        "purpose": "bootstrap", "scene": record.scene, "spp": record.spp, "replicate": record.replicate
    }))
}

/// Puts the metrics of an image into its record; with their standard errors within this one image where `single` says
/// that there is no second replicate.
///
/// # Errors
/// If no pixel can be measured, or the image does not fit the truth.
pub fn measure_metrics(
    measurer: &Measurer<'_>,
    image: &Image,
    single: bool,
    record: &mut Record,
) -> Result<(), MetricError> {
    record.take(measurer.measure(image)?);
    if single {
        record.metrics_within_se =
            block_bootstrap(measurer, image, BOOTSTRAP_IMAGES, bootstrap_seed(record))?;
    }
    Ok(())
}

pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    measure_metrics(cell.measurer, cell.image, cell.single, record)?;
    // Of the same noisy input only: the ratio is to that.
    if cell.single && cell.method != BASELINE && cell.shared_frame {
        record.ratio_within_se = ratio_within_se(cell.image, &cell.frame.color.mean, cell.reference)?;
    }
    Ok(())
}
