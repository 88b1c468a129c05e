//! What a reader sees.

mod chart;
mod enclosures;
mod guard;
mod table;

use noisefloor_study::exhibit::{Exhibit, Part};

pub(super) use table::{Promises, promises};

use crate::view::View;

const NOTE: &str = "Share of pixel-channels whose error exceeds the method's bound, beside the rate α that the bound promises. \
    Filled marks: a proof covers the procedure, given independent normal samples. Open marks: the bound as printed in the source, \
    without a proof for this procedure.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let mut tables = Vec::new();
    let mut charts = Vec::new();
    for (scene, name) in view.named_scenes() {
        if let Some(promises) = promises(view, &scene.id) {
            tables.push(Part::Heading(scene.title.clone()));
            tables.extend(table::parts(view, &promises, &name));
            charts.extend(chart::chart(view, scene, &name).filter(|_| view.draws("bounds")));
        }
    }
    let mut parts = Vec::new();
    if !tables.is_empty() {
        parts.push(Part::Note(NOTE.into()));
        parts.extend((!charts.is_empty()).then_some(Part::Charts(charts)));
        parts.extend(tables);
    }
    parts.extend(enclosures::parts(view));
    if parts.is_empty() {
        return Vec::new();
    }
    vec![Exhibit {
        id: "bounds".into(),
        name: "Bounds".into(),
        title: "Error bounds: promised and measured".into(),
        parts,
    }]
}
