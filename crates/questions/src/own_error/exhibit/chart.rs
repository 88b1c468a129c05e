use noisefloor_study::exhibit::{Axis, Chart, Form, Guide, Look, Panel, Point, Series};
use noisefloor_study::format;
use noisefloor_study::summary::{EstimateBin, EstimateSummary, SceneSummary};

use crate::charts::{distinct, heights, log_axis};
use crate::view::View;

/// One panel for each row that estimates its own error, all with the same axes; a line per level, one point per tenth of
/// the pixel-channels by rank of the estimate. Nothing if no tenth has a positive estimate.
pub(super) fn chart(view: &View<'_>, scene: &SceneSummary, name: &str) -> Option<Chart> {
    let of_scene = view.summary.estimates.iter().filter(|e| e.scene == scene.id && e.class == "all");
    let lines: Vec<(&EstimateSummary, Vec<Point>)> =
        of_scene.map(|e| (e, points(e))).filter(|(_, points)| !points.is_empty()).collect();
    if lines.is_empty() {
        return None;
    }
    let all = || lines.iter().flat_map(|(_, points)| points);
    let x = log_axis("estimated squared error, mean of a tenth", all().map(|p| p.x));
    let y = log_axis("measured squared error", heights(all()).0);
    let levels = distinct(lines.iter().map(|(e, _)| e.spp));
    let panel = |label: &String| {
        // A level keeps its colour in every panel, also where a row lacks one.
        let of_level = |(k, spp): (usize, &u32)| {
            let (_, points) = lines.iter().find(|(e, _)| e.label == *label && e.spp == *spp)?;
            let name = format!("{spp} spp");
            Some(Series { name, look: Look::own(k), points: points.clone(), band: false })
        };
        let series: Vec<Series> = levels.iter().enumerate().filter_map(of_level).collect();
        (!series.is_empty()).then(|| Panel {
            title: label.clone(),
            x: x.clone(),
            y: y.clone(),
            form: Form::Lines,
            guides: equality(&x, &y).into_iter().collect(),
            series,
        })
    };
    Some(Chart {
        id: format!("estimates-{name}"),
        kind: "estimates".into(),
        title: format!("{} · own error estimates", scene.title),
        panels: view.summary.methods.iter().filter_map(|row| panel(&row.label)).collect(),
    })
}

/// Where both axes have the same values; nothing if they have none in common.
fn equality(x: &Axis, y: &Axis) -> Option<Guide> {
    let least = |axis: &Axis| axis.values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = |axis: &Axis| axis.values.iter().copied().fold(0.0, f64::max);
    let (low, high) = (least(x).max(least(y)), most(x).min(most(y)));
    (low < high)
        .then(|| Guide::Line { points: vec![(low, low), (high, high)], name: "estimated = measured".into() })
}

fn points(e: &EstimateSummary) -> Vec<Point> {
    e.deciles.iter().enumerate().filter_map(|(k, bin)| point(e, k, bin)).collect()
}

/// A tenth, or nothing where a logarithm has no place for it. A measured error that is not positive is an upper limit
/// at the end of its interval.
fn point(e: &EstimateSummary, k: usize, bin: &EstimateBin) -> Option<Point> {
    let (x, measured) = (bin.estimated.value, &bin.measured);
    let limit = measured.value <= 0.0;
    let y = if limit { measured.high? } else { measured.value };
    (x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite()).then(|| Point {
        x,
        y,
        low: measured.low,
        high: measured.high,
        limit,
        about: format!(
            "{}, {} spp, tenth {}: estimated {}, measured {}",
            e.label,
            e.spp,
            k + 1,
            format::interval(&bin.estimated).line(),
            format::interval(measured).line()
        ),
        ..Point::default()
    })
}
