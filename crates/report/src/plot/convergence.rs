//! Error against samples per pixel.

use noisefloor_harness::summary::{Interval, SceneSummary};

use super::axis::Axis;
use super::chart::{Chart, Datum, Key};
use super::figure::{Figure, Stroke};
use super::style::{MUTED, SHADE};
use crate::format;
use crate::index::Index;

/// Log-log plot of one metric on one scene; nothing if no cell has it.
pub(crate) fn convergence(index: &Index<'_>, scene: &SceneSummary, metric: &str) -> Option<Figure> {
    let summary = index.summary;
    let rows: Vec<(&str, Vec<Datum>)> = summary
        .methods
        .iter()
        .map(|m| (m.label.as_str(), data(index, scene, &m.label, metric)))
        .filter(|(_, data)| !data.is_empty())
        .collect();
    if rows.is_empty() {
        return None;
    }
    let floor = scene.reference.floor.get(metric).copied().filter(|f| *f > 0.0);
    let values = rows.iter().flat_map(|(_, data)| data).flat_map(|d| [Some(d.y), d.high, d.low]).flatten();
    // A lower end near zero would stretch the axis over empty decades: at most a factor of 4 below the points.
    let least = rows.iter().flat_map(|(_, d)| d).map(|d| d.y).fold(f64::INFINITY, f64::min) / 4.0;
    let mut values: Vec<f64> = values.filter(|v| *v >= least).collect();
    values.extend(floor.filter(|f| *f >= least));
    let name = index.metric_name(metric);
    let mut chart = Chart::new(
        &format!("{} · {name}", scene.title),
        Axis::spp(&levels(&rows)),
        Axis::log(&index.metric_label(metric), values),
    );
    let mut keys: Vec<Key> = Vec::new();
    if let Some(floor) = floor {
        chart.shade_below(floor, 0.22);
        keys.push(Key::Shade(SHADE, 0.4, "noise of the reference".into()));
    }
    if let Some((points, text)) = guide(index, scene, metric) {
        let stroke = Stroke { color: MUTED, width: 0.7, dash: &[1.0, 1.8] };
        chart.line(&points, stroke);
        keys.push(Key::Line(stroke, text));
    }
    if rows.iter().flat_map(|(_, data)| data).any(|d| d.doubtful) {
        keys.push(Key::Doubtful("other frames or fewer pixels: not ranked".into()));
    }
    let step = (6.0 / rows.len() as f64).min(1.2);
    let mut series = Vec::new();
    for (i, (label, data)) in rows.iter().enumerate() {
        let look = index.looks.get(label);
        let shift = (i as f64 - 0.5 * (rows.len() - 1) as f64) * step;
        chart.series(look, data, shift, true);
        series.push(Key::Series(look, (*label).to_owned()));
    }
    Some(chart.finish(series, keys))
}

fn levels(rows: &[(&str, Vec<Datum>)]) -> Vec<u32> {
    let mut levels: Vec<u32> = rows.iter().flat_map(|(_, data)| data).map(|d| d.x as u32).collect();
    levels.sort_unstable();
    levels.dedup();
    levels
}

fn data(index: &Index<'_>, scene: &SceneSummary, label: &str, metric: &str) -> Vec<Datum> {
    let unit = index.metric(metric).map_or("", |m| m.unit.as_str());
    index
        .levels(&scene.id)
        .filter_map(|spp| {
            let cell = index.cell(&scene.id, spp, label)?;
            let interval = cell.metrics.get(metric)?;
            let shown = format::interval(interval).line();
            let why = cell.left_out.as_ref().map_or_else(String::new, |why| format!(" (not ranked: {why})"));
            let spot = format!("{label}, {spp} spp: {shown} {unit}").trim_end().to_owned() + &why;
            Some(Datum { doubtful: cell.left_out.is_some(), ..datum(spp, interval, spot)? })
        })
        .collect()
}

/// The point of an interval at a level, or nothing where a logarithm has no place for it.
fn datum(spp: u32, interval: &Interval, spot: String) -> Option<Datum> {
    let limit = interval.below;
    let y = limit.unwrap_or(interval.value);
    (y > 0.0 && y.is_finite()).then(|| Datum {
        x: f64::from(spp),
        y,
        low: interval.low,
        high: interval.high,
        limit: limit.is_some(),
        doubtful: false,
        spot,
    })
}

/// Plain Monte Carlo's law through its own points: c/n for squared errors, c/√n for their root. Nothing for metrics
/// without a rate, nor where the frames do not obey it.
fn guide(index: &Index<'_>, scene: &SceneSummary, metric: &str) -> Option<(Vec<(f64, f64)>, String)> {
    let power = match index.metric(metric)?.order? {
        2 => 1.0,
        _ => 0.5,
    };
    let baseline = index.baseline()?;
    let logs: Vec<f64> = index
        .levels(&scene.id)
        .filter_map(|spp| {
            let cell = index.cell(&scene.id, spp, baseline)?;
            // The analysis fitted c where it means something.
            let interval = cell.metrics.get(metric).filter(|_| cell.equal_error.contains_key(metric))?;
            (interval.below.is_none() && interval.value > 0.0)
                .then(|| (interval.value * f64::from(spp).powf(power)).ln())
        })
        .collect();
    if logs.len() < 2 {
        return None;
    }
    let c = (logs.iter().sum::<f64>() / logs.len() as f64).exp();
    let points = index.levels(&scene.id).map(|n| (f64::from(n), c / f64::from(n).powf(power))).collect();
    Some((points, if power == 1.0 { "c / n, fitted to mc".into() } else { "c / √n, fitted to mc".into() }))
}
