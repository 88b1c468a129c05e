use noisefloor_study::exhibit::{Axis, Chart, Form, Guide, Look, Panel, Point, Scale, Series};
use noisefloor_study::summary::{CellSummary, SceneSummary};
use noisefloor_study::{BASELINE, format};

use super::front::front;
use crate::charts::{log_axis, point};
use crate::view::View;

/// Which seconds count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Time {
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

    fn name(self) -> &'static str {
        match self {
            Self::Denoise => "denoise",
            Self::Total => "total",
        }
    }
}

/// Error against seconds with the Pareto front; nothing if no cell has both numbers.
pub(super) fn chart(
    view: &View<'_>,
    scene: &SceneSummary,
    name: &str,
    metric: &str,
    time: Time,
) -> Option<Chart> {
    let methods = view.summary.methods.iter();
    let shown = methods.filter(|m| time == Time::Total || m.method != BASELINE);
    let mut rows: Vec<(Series, Vec<u32>)> = shown
        .map(|m| {
            let at = |spp| Some((of_cell(view.cell(&scene.id, spp, &m.label)?, metric, time)?, spp));
            let (points, levels) = view.levels(&scene.id).filter_map(at).unzip();
            let look = Look::of_row(view.row(&m.label));
            (Series { name: m.label.clone(), look, points, band: false }, levels)
        })
        .filter(|(series, _)| !series.points.is_empty())
        .collect();
    if rows.is_empty() {
        return None;
    }
    name_levels(&mut rows, time);
    let series: Vec<Series> = rows.into_iter().map(|(series, _)| series).collect();
    let all = || series.iter().flat_map(|series| &series.points);
    let fastest = all().map(|p| p.x).fold(f64::INFINITY, f64::min);
    // Room for the sample counts left of the fastest row.
    let room = (time == Time::Denoise).then_some(0.6 * fastest);
    let guide =
        Guide::Front { points: front(all(), view.lower_is_better(metric)), name: "Pareto front".into() };
    let panel = Panel {
        title: String::new(),
        x: Axis {
            title: time.title().into(),
            scale: Scale::Seconds,
            values: all().map(|p| p.x).chain(room).collect(),
        },
        y: log_axis(view.metric_label(metric), all().map(|p| p.y)),
        form: Form::Lines,
        guides: vec![guide],
        series,
    };
    Some(Chart {
        id: format!("speed-{name}-{}", time.name()),
        kind: "speed".into(),
        title: format!("{} · {} against time", scene.title, view.metric_name(metric)),
        panels: vec![panel],
    })
}

/// Sample counts beside the points of the first row, or of the fastest where only denoising counts: there the other
/// rows' points lie beside them, at about the same error or the same time.
fn name_levels(rows: &mut [(Series, Vec<u32>)], time: Time) {
    let slowest = |series: &Series| series.points.iter().map(|p| p.x).fold(0.0, f64::max);
    let row = match time {
        Time::Total => rows.first_mut(),
        Time::Denoise => rows.iter_mut().min_by(|(a, _), (b, _)| slowest(a).total_cmp(&slowest(b))),
    };
    if let Some((series, levels)) = row {
        for (k, (point, spp)) in series.points.iter_mut().zip(levels).enumerate() {
            point.label = if k == 0 { format!("{spp} spp") } else { spp.to_string() };
        }
    }
}

fn of_cell(cell: &CellSummary, metric: &str, time: Time) -> Option<Point> {
    let interval = cell.metrics.get(metric)?;
    let seconds = time.of(cell)?;
    let about = format!(
        "{}, {} spp: {} in {}",
        cell.label,
        cell.spp,
        format::interval(interval).line(),
        format::duration(seconds)
    );
    Some(Point { doubtful: cell.left_out.is_some(), ..point(seconds, interval, about)? })
}
