//! Error against seconds: what an error costs.

use noisefloor_harness::summary::{CellSummary, SceneSummary};

use super::axis::Axis;
use super::chart::{Chart, Datum, Key};
use super::figure::{Figure, Stroke};
use super::style::{MUTED, SHADE};
use crate::format;
use crate::index::Index;

/// Which seconds count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Time {
    /// Denoising alone. The unfiltered input has none and is left out.
    Denoise,
    /// Rendering the input and denoising it.
    Total,
}

impl Time {
    fn of(self, cell: &CellSummary) -> Option<f64> {
        let denoise = cell.denoise_seconds;
        match self {
            Self::Denoise => denoise,
            Self::Total => Some(cell.render_seconds? + denoise.unwrap_or(0.0)),
        }
        .filter(|t| *t > 0.0 && t.is_finite())
    }

    fn title(self) -> &'static str {
        match self {
            Self::Denoise => "denoising time per frame",
            Self::Total => "render + denoise time per frame",
        }
    }
}

/// Log-log plot with the Pareto front; nothing if no cell has both numbers.
pub(crate) fn speed(index: &Index<'_>, scene: &SceneSummary, metric: &str, time: Time) -> Option<Figure> {
    let lower = index.metric(metric).is_none_or(|m| m.lower_is_better);
    let mut rows: Vec<(&str, Vec<(u32, Datum)>)> = Vec::new();
    for method in &index.summary.methods {
        if time == Time::Denoise && method.method == "mc" {
            continue;
        }
        let data: Vec<(u32, Datum)> = index
            .levels(&scene.id)
            .filter_map(|spp| Some((spp, point(index.cell(&scene.id, spp, &method.label)?, metric, time)?)))
            .collect();
        if !data.is_empty() {
            rows.push((&method.label, data));
        }
    }
    let all: Vec<&Datum> = rows.iter().flat_map(|(_, data)| data).map(|(_, d)| d).collect();
    if all.is_empty() {
        return None;
    }
    let least = all.iter().map(|d| d.x).fold(f64::INFINITY, f64::min);
    // Room for the sample counts left of the fastest row.
    let room = (time == Time::Denoise).then_some(0.6 * least);
    let seconds = all.iter().map(|d| d.x).chain(room);
    let mut chart = Chart::new(
        &format!("{} · {} against time", scene.title, index.metric_name(metric)),
        Axis::seconds(time.title(), seconds),
        Axis::log(&index.metric_label(metric), all.iter().map(|d| d.y)),
    );
    // Rows over other frames or fewer pixels are shown, and beat nothing.
    let ranked: Vec<&Datum> = all.iter().copied().filter(|d| !d.doubtful).collect();
    chart.line(&staircase(&pareto(&ranked, lower)), FRONT);
    let mut guides = vec![Key::Line(FRONT, "Pareto front".into())];
    if ranked.len() < all.len() {
        guides.push(Key::Doubtful("other frames or fewer pixels: not ranked".into()));
    }
    let mut keys = Vec::new();
    for (label, data) in &rows {
        let look = index.looks.get(label);
        let points: Vec<Datum> = data.iter().map(|(_, d)| d.clone()).collect();
        chart.series(look, &points, 0.0, true);
        keys.push(Key::Series(look, (*label).to_owned()));
    }
    name_levels(&mut chart, &rows, time);
    Some(chart.finish(keys, guides))
}

/// The border of what is reachable, under everything else.
const FRONT: Stroke = Stroke { color: SHADE, width: 1.8, dash: &[] };

/// Sample counts beside the points of the first row, or of the fastest where only denoising counts: there the other
/// rows' points lie beside them, at about the same error or the same time.
fn name_levels(chart: &mut Chart, rows: &[(&str, Vec<(u32, Datum)>)], time: Time) {
    let fastest = |row: &&(&str, Vec<(u32, Datum)>)| row.1.iter().map(|(_, d)| d.x).fold(0.0, f64::max);
    let row = match time {
        Time::Total => rows.first(),
        Time::Denoise => rows.iter().min_by(|a, b| fastest(a).total_cmp(&fastest(b))),
    };
    let mut last: Option<(f64, f64)> = None;
    for (i, (spp, d)) in row.iter().flat_map(|(_, data)| data).enumerate() {
        let at = chart.at(d.x, d.y);
        // A name needs a line of its own.
        if last.is_some_and(|(x, y)| (at.0 - x).abs() < 14.0 && (at.1 - y).abs() < 7.5) {
            continue;
        }
        last = Some(at);
        let text = if i == 0 { format!("{spp} spp") } else { spp.to_string() };
        let offset = match time {
            Time::Total => (6.0 + 1.9 * text.chars().count() as f64, -4.0),
            Time::Denoise => (-6.0 - 1.9 * text.chars().count() as f64, 0.0),
        };
        chart.note(d.x, d.y, offset, text, MUTED);
    }
}

fn point(cell: &CellSummary, metric: &str, time: Time) -> Option<Datum> {
    let interval = cell.metrics.get(metric)?;
    let seconds = time.of(cell)?;
    let y = interval.below.unwrap_or(interval.value);
    (y > 0.0 && y.is_finite()).then(|| Datum {
        x: seconds,
        y,
        low: interval.low,
        high: interval.high,
        limit: interval.below.is_some(),
        doubtful: cell.left_out.is_some(),
        spot: format!(
            "{}, {} spp: {} in {}",
            cell.label,
            cell.spp,
            format::interval(interval).line(),
            format::duration(seconds)
        ),
    })
}

/// Points that no other point beats in both time and error, from fast to slow. Upper limits count as their limit.
fn pareto(points: &[&Datum], lower_is_better: bool) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> = points.iter().map(|d| (d.x, d.y)).collect();
    let sign = if lower_is_better { 1.0 } else { -1.0 };
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then((sign * a.1).total_cmp(&(sign * b.1))));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for p in sorted {
        if front.last().is_none_or(|last| sign * p.1 < sign * last.1) {
            front.push(p);
        }
    }
    front
}

/// The border of what is reachable: horizontal, then vertical, from point to point.
fn staircase(front: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut line: Vec<(f64, f64)> = Vec::new();
    for &(x, y) in front {
        if let Some(&(_, last)) = line.last() {
            line.push((x, last));
        }
        line.push((x, y));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn datum(x: f64, y: f64) -> Datum {
        Datum { x, y, low: None, high: None, limit: false, doubtful: false, spot: String::new() }
    }

    #[test]
    fn the_front_has_exactly_the_unbeaten_points() {
        let points = [
            datum(1.0, 9.0),
            datum(2.0, 9.5),
            datum(3.0, 4.0),
            datum(3.0, 5.0),
            datum(8.0, 4.0),
            datum(9.0, 1.0),
        ];
        let points: Vec<&Datum> = points.iter().collect();
        assert_eq!(pareto(&points, true), [(1.0, 9.0), (3.0, 4.0), (9.0, 1.0)]);
        assert_eq!(pareto(&points, false), [(1.0, 9.0), (2.0, 9.5)]);
    }

    #[test]
    fn the_staircase_turns_at_right_angles() {
        assert_eq!(staircase(&[(1.0, 9.0), (3.0, 4.0)]), [(1.0, 9.0), (3.0, 9.0), (3.0, 4.0)]);
        assert!(staircase(&[]).is_empty());
    }
}
