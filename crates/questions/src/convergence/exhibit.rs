//! What a reader sees.

mod chart;
mod slopes;

use noisefloor_study::exhibit::{Chart, Exhibit, Form, Part};

pub(crate) use chart::chart;

use crate::view::View;

const LINES: &str = "Logarithmic axes. Bars are the intervals of the tables; rows are moved sideways a little so that bars do not hide \
    each other. An arrow is an upper limit: the estimate is below the noise of the reference.";
const BARS: &str = "Scenes with a single level of samples: one bar per row, on a logarithmic axis, with the interval of the tables at its \
    end. An arrow is an upper limit: the estimate is below the noise of the reference.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    errors(view).into_iter().chain(slopes::exhibit(view)).collect()
}

/// Charts of the study's first metric.
fn errors(view: &View<'_>) -> Option<Exhibit> {
    let metric = view.summary.study.primary_metric.as_str();
    let of = |metric: &str| -> Vec<Chart> {
        let scenes = view.named_scenes().filter(|_| view.draws("convergence"));
        scenes.filter_map(|(scene, name)| chart(view, scene, &name, metric)).collect()
    };
    let charts = of(metric);
    if charts.is_empty() {
        return None;
    }
    let has = |form: Form| charts.iter().flat_map(|chart| &chart.panels).any(|panel| panel.form == form);
    let (lines, bars) = (has(Form::Lines), has(Form::Bars));
    let mut parts = Vec::new();
    parts.extend(lines.then(|| Part::Note(LINES.into())));
    parts.extend(bars.then(|| Part::Note(BARS.into())));
    parts.push(Part::Charts(charts));
    if metric == "relmse" && view.metric("relmse_trimmed").is_some() {
        let trimmed = of("relmse_trimmed");
        let note = "Not comparable with the plots above: each row leaves out its own worst pixels.";
        let folded = vec![Part::Note(note.into()), Part::Charts(trimmed.clone())];
        parts
            .extend((!trimmed.is_empty()).then(|| Part::folded("Without the worst 0.1 % of pixels", folded)));
    }
    let (name, title) = match lines {
        true => ("Convergence", "Convergence: error against samples"),
        false => ("Errors", "Errors at a single level of samples"),
    };
    Some(Exhibit { id: "convergence".into(), name: name.into(), title: title.into(), parts })
}
