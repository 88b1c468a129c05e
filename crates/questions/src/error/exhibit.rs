//! What a reader sees.

mod absent;
mod answer;
mod board;
mod cards;
mod forest;
mod level;
mod metrics;
mod row;
mod uncertainty;

use noisefloor_study::exhibit::{Exhibit, Part};

pub(super) use answer::answer;
pub(crate) use board::board;
pub(crate) use cards::cards;

use crate::view::View;

/// Tables by scene and level.
pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let (metric, metric_name) = view.primary();
    let mut note = format!(
        "{} Ratio to mc: below 1 is better than the unfiltered input.",
        uncertainty::sentences(view.summary)
    );
    if view.metric(metric).is_some_and(|m| m.order.is_some()) {
        note += " Equal error: how many times more samples plain Monte Carlo needs for the same error; “ext.” reaches beyond the \
                 rendered levels.";
    }
    let mut parts = vec![Part::Note(note.trim_start().to_owned())];
    parts.extend((!view.summary.study.spp.is_empty()).then_some(Part::LevelSwitch));
    for (scene, name) in view.named_scenes() {
        parts.push(Part::Heading(scene.title.clone()));
        for &spp in &view.summary.study.spp {
            parts.push(Part::Level { spp, parts: level::parts(view, scene, &name, spp) });
        }
    }
    parts.extend(absent::parts(view));
    vec![Exhibit {
        id: "tables".into(),
        name: "Tables".into(),
        title: format!("{metric_name} by scene and method"),
        parts,
    }]
}
