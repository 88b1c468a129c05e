//! Rows that get as much time as another: the samples that they had, and those that this run's times imply.

use crate::records::Index;
use crate::records::median;
use noisefloor_study::RowFrames;
use noisefloor_study::summary::{EqualTime, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.equal_time = equal_time(index);
}

/// One per scene × level × row of equal time that ran together with its other row.
fn equal_time(index: &Index<'_>) -> Vec<EqualTime> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let RowFrames::EqualTime { with } = &row.summary.frames else { continue };
                let (own, other) =
                    (index.records(scene, spp, &row.summary.label), index.records(scene, spp, with));
                let (Some(first), Some(denoise)) =
                    (own.first(), median(other.iter().filter_map(|r| r.seconds.denoise)))
                else {
                    continue;
                };
                let used = first.frame_spp.unwrap_or(spp);
                // The plain rendering's own time per sample: the other row's frames also record features.
                let per_sample =
                    median(own.iter().filter_map(|r| r.seconds.render)).map(|s| s / f64::from(used));
                let render = median(other.iter().filter_map(|r| r.seconds.render));
                let per_sample = per_sample.filter(|s| *s > 0.0);
                // The same samples, and as many as the filter's time buys. Of an adaptive row all its time: choosing
                // pixels is in it.
                let adaptive = other.iter().any(|r| r.adaptive.is_some());
                let implied = per_sample.and_then(|per_sample| {
                    let spent = if adaptive { denoise + render? } else { denoise };
                    let before = if adaptive { 0.0 } else { f64::from(spp) };
                    Some(before + spent / per_sample)
                });
                out.push(EqualTime {
                    scene: scene.id.clone(),
                    spp,
                    label: row.summary.label.clone(),
                    with: with.clone(),
                    used,
                    implied,
                    denoise_seconds: denoise,
                    seconds_per_sample: per_sample,
                });
            }
        }
    }
    out
}
