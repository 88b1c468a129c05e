use noisefloor_study::exhibit::{Chart, Form, Look, Panel, Point, Series};
use noisefloor_study::format;
use noisefloor_study::summary::{Interval, SceneSummary};

use super::super::analyse::Finding;
use crate::cell::ALL;
use crate::charts::{distinct, heights, levels_axis, log_axis, point};
use crate::view::View;

/// Squared bias and variance of one scene, relative, in two panels with one scale; nothing without both.
pub(super) fn chart(view: &View<'_>, scene: &SceneSummary, name: &str, here: &[&Finding]) -> Option<Chart> {
    let all: Vec<&Finding> = here.iter().filter(|f| f.relative && f.class == ALL).copied().collect();
    let levels = distinct(all.iter().map(|f| f.spp));
    let form = if levels.len() > 1 { Form::Lines } else { Form::Bars };
    let bias = series(view, &all, |f| f.squared_bias.as_ref());
    let variance = series(view, &all, |f| Some(&f.variance));
    if bias.is_empty() || variance.is_empty() {
        return None;
    }
    let points: Vec<&Point> = bias.iter().chain(&variance).flat_map(|series| &series.points).collect();
    let (values, _) = heights(points.iter().copied());
    let panel = |title: &str, series: Vec<Series>| Panel {
        title: title.into(),
        x: levels_axis(&levels),
        y: log_axis("relative squared error", values.clone()),
        form,
        guides: Vec::new(),
        series,
    };
    Some(Chart {
        id: format!("bias-{name}"),
        kind: "bias".into(),
        title: format!("{} · bias and variance", scene.title),
        panels: vec![panel("Bias²", bias), panel("Variance", variance)],
    })
}

/// One per row that has anything to draw.
fn series(view: &View<'_>, all: &[&Finding], of: impl Fn(&Finding) -> Option<&Interval>) -> Vec<Series> {
    let rows = view.summary.methods.iter().map(|m| m.label.as_str());
    let series = rows.map(|label| Series {
        name: label.to_owned(),
        look: Look::of_row(view.row(label)),
        points: all
            .iter()
            .filter(|f| f.label == label)
            .filter_map(|f| {
                let interval = of(f)?;
                let about = format!("{label}, {} spp: {}", f.spp, format::interval(interval).line());
                point(f64::from(f.spp), interval, about)
            })
            .collect(),
        band: false,
    });
    series.filter(|series| !series.points.is_empty()).collect()
}
