use noisefloor_study::exhibit::{Column, Exhibit, Part, Table, TableCell, TableRow};
use noisefloor_study::summary::{MethodSummary, MetricInfo, SceneSummary};

use super::facts;
use crate::view::View;

/// Rows, metrics and scenes, explained.
pub(super) fn methods(view: &View<'_>) -> Exhibit {
    let summary = view.summary;
    let mut parts: Vec<Part> = summary.methods.iter().enumerate().map(|(k, m)| method(k, m)).collect();
    if !summary.study.metrics.is_empty() {
        parts.push(Part::Heading("Metrics".into()));
        parts.push(Part::Table(metrics(&summary.study.metrics)));
    }
    parts.push(Part::Heading("Scenes".into()));
    parts.extend(summary.scenes.iter().map(scene));
    Exhibit {
        id: "methods".into(),
        name: "Methods".into(),
        title: "Methods, metrics and scenes".into(),
        parts,
    }
}

fn method(row: usize, m: &MethodSummary) -> Part {
    let mut parts = Vec::new();
    parts.extend((!m.reference.is_empty()).then(|| Part::Note(m.reference.clone())));
    parts.extend((!m.notes.is_empty()).then(|| Part::List(m.notes.clone())));
    parts.extend((m.label != m.method).then(|| Part::Note(format!("Method {}", m.method))));
    let params = facts::parameters(&m.params);
    parts.extend((!params.is_empty()).then_some(Part::Facts(params)));
    let cited = match m.citation.as_str() {
        "" => String::new(),
        key => format!(" [{key}]"),
    };
    Part::Folded { title: m.label.clone(), row: Some(row), aside: format!("{}{cited}", m.name), parts }
}

fn metrics(metrics: &[MetricInfo]) -> Table {
    let row = |m: &MetricInfo| {
        let unit = if m.unit.is_empty() { String::new() } else { format!(" ({})", m.unit) };
        TableRow::new(vec![
            TableCell::text(&m.name).aside(&m.id),
            TableCell::text(format!("{}{unit}", m.formula)),
            TableCell::text(better(m)),
            TableCell::text(if m.reference_noise_removed { "taken out" } else { "not corrected" }),
        ])
    };
    Table {
        id: "metrics".into(),
        columns: ["Metric", "Formula", "Better", "Reference's noise"].map(Column::text).to_vec(),
        rows: metrics.iter().map(row).collect(),
        ..Table::default()
    }
}

/// Which values are good, in words.
fn better(metric: &MetricInfo) -> String {
    match (metric.ideal, metric.lower_is_better) {
        (Some(ideal), _) => format!("closer to {ideal}"),
        (None, true) => "lower".into(),
        (None, false) => "higher".into(),
    }
}

fn scene(s: &SceneSummary) -> Part {
    let parts = vec![
        Part::Note(s.about.clone()),
        Part::Facts(facts::scene(s)),
        Part::Heading("Reference".into()),
        Part::Facts(facts::reference(&s.reference)),
    ];
    Part::Folded { title: s.title.clone(), row: None, aside: s.id.clone(), parts }
}
