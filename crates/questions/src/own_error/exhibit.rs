//! What a reader sees.

mod chart;
mod table;

use noisefloor_study::exhibit::{Exhibit, Part};

pub(super) use table::effect;

use crate::section::section;
use crate::view::View;

const NOTE: &str = "Mean over the image of the squared error that a method says it has, beside the mean that was measured with the \
    reference's noise taken out. A ratio below 1 is too optimistic, above 1 too pessimistic; claimed is that its \
    interval lies within 0.8 to 1.25. Where a mean is not positive, which an unbiased estimate may be, the difference stands instead. Plots: one point per \
    tenth of the pixel-channels by rank of the estimate. An estimate that is noisy itself spreads wider than the error it estimates: \
    its lowest tenths are too low and its highest too high even if the mean is right.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let mut tables = Vec::new();
    let mut charts = Vec::new();
    for (scene, name) in view.named_scenes() {
        let parts = table::parts(view, scene, &name);
        if !parts.is_empty() {
            tables.push(Part::Heading(scene.title.clone()));
            tables.extend(parts);
        }
        charts.extend(chart::chart(view, scene, &name).filter(|_| view.draws("estimates")));
    }
    section(["estimates", "Own estimates", "Own error estimates: told and measured"], NOTE, charts, tables)
}
