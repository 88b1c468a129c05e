//! What a reader sees.

mod chart;
mod table;

use noisefloor_study::exhibit::{Exhibit, Part};

pub(super) use table::{Covered, covered};

use crate::section::section;
use crate::view::View;

const NOTE: &str = "How often Student's interval around the noisy mean contains the truth, allowing for the noise of the reference. \
    The verdict is about pixel-channels with s > 0, and so are the sides on which the truth lies where \
    it is missed. Pixels whose samples are all equal have no interval: they count as covered if their value is right (“constant”), else as “missed \
    events”.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let mut tables = Vec::new();
    let mut charts = Vec::new();
    for (scene, name) in view.named_scenes() {
        if let Some(covered) = covered(view, &scene.id) {
            tables.push(Part::Heading(scene.title.clone()));
            tables.extend(table::parts(&covered, &name));
            charts.extend(chart::chart(view, scene, &name).filter(|_| view.draws("coverage")));
        }
    }
    section(["coverage", "Coverage", "Coverage of the input's confidence intervals"], NOTE, charts, tables)
}
