//! A method's estimate of its own squared error against the measured one.

use noisefloor_harness::summary::{EstimateBin, EstimateSummary, SceneSummary};

use super::axis::Axis;
use super::chart::{Chart, Datum, Key};
use super::figure::{Figure, Stroke};
use super::style::MUTED;
use crate::format;
use crate::index::Index;

/// Log-log plot of all rows and levels of a scene, one point per tenth of the pixel-channels by rank of the estimate;
/// nothing if no tenth has a positive estimate.
pub(crate) fn estimates(index: &Index<'_>, scene: &SceneSummary) -> Option<Figure> {
    let of_scene = index.summary.estimates.iter().filter(|e| e.scene == scene.id && e.class == "all");
    let lines: Vec<(&EstimateSummary, Vec<Datum>)> =
        of_scene.map(|e| (e, data(e))).filter(|(_, data)| !data.is_empty()).collect();
    let all = || lines.iter().flat_map(|(_, data)| data);
    let least = all().map(|d| d.y).fold(f64::INFINITY, f64::min);
    // A lower end near zero would stretch the axis over empty decades: at most a factor of 4 below the points.
    let ends = all().flat_map(|d| [Some(d.y), d.high, d.low.filter(|low| *low >= least / 4.0)]).flatten();
    if lines.is_empty() {
        return None;
    }
    let mut chart = Chart::new(
        &format!("{} · own error estimates", scene.title),
        Axis::log("estimated squared error, mean of a tenth", all().map(|d| d.x)),
        Axis::log("measured squared error", ends),
    );
    let stroke = Stroke { color: MUTED, width: 0.7, dash: &[1.0, 1.8] };
    let (low, high) = (chart.x.low.max(chart.y.low), chart.x.high.min(chart.y.high));
    let mut keys = Vec::new();
    if low < high {
        chart.line(&[(low, low), (high, high)], stroke);
        keys.push(Key::Line(stroke, "estimated = measured".into()));
    }
    let mut series = Vec::new();
    let mut named: Vec<&str> = Vec::new();
    for (estimate, data) in &lines {
        let look = index.looks.get(&estimate.label);
        chart.series(look, data, 0.0, true);
        if !named.contains(&estimate.label.as_str()) {
            named.push(&estimate.label);
            series.push(Key::Series(look, estimate.label.clone()));
        }
    }
    // Above all lines, each at the last of its points.
    for (estimate, data) in &lines {
        if let Some(last) = data.last() {
            let color = index.looks.get(&estimate.label).color;
            chart.note(last.x, last.y, (0.0, -8.0), format!("{} spp", estimate.spp), color);
        }
    }
    Some(chart.finish(series, keys))
}

fn data(e: &EstimateSummary) -> Vec<Datum> {
    e.deciles.iter().enumerate().filter_map(|(k, bin)| datum(e, k, bin)).collect()
}

/// A tenth, or nothing where a logarithm has no place for it. A measured error that is not positive is an upper limit
/// at the end of its interval.
fn datum(e: &EstimateSummary, k: usize, bin: &EstimateBin) -> Option<Datum> {
    let (x, measured) = (bin.estimated.value, &bin.measured);
    let limit = measured.value <= 0.0;
    let y = if limit { measured.high? } else { measured.value };
    (x > 0.0 && y > 0.0 && x.is_finite() && y.is_finite()).then(|| Datum {
        x,
        y,
        low: measured.low,
        high: measured.high,
        limit,
        doubtful: false,
        spot: format!(
            "{}, {} spp, tenth {}: estimated {}, measured {}",
            e.label,
            e.spp,
            k + 1,
            format::interval(&bin.estimated).line(),
            format::interval(measured).line()
        ),
    })
}
