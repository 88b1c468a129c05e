use noisefloor_study::exhibit::{Chart, Form, Guide, Look, Panel, Point, Series};
use noisefloor_study::format;
use noisefloor_study::summary::SceneSummary;

use crate::charts::{distinct, heights, levels_axis, log_axis, point};
use crate::view::View;

/// One metric on one scene: against samples per pixel or, where there is a single level, one bar per row. Nothing if no
/// cell has it.
pub(crate) fn chart(view: &View<'_>, scene: &SceneSummary, name: &str, metric: &str) -> Option<Chart> {
    let labels = view.summary.methods.iter().map(|m| m.label.as_str());
    let series: Vec<Series> = labels
        .map(|label| Series {
            name: label.to_owned(),
            look: Look::of_row(view.row(label)),
            points: points(view, scene, label, metric),
            band: false,
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    let all = || series.iter().flat_map(|series| &series.points);
    let levels = distinct(all().map(|p| p.x as u32));
    let form = match levels.as_slice() {
        [] => return None,
        [_] => Form::Bars,
        _ => Form::Lines,
    };
    let floor = scene.reference.floor.get(metric).copied().filter(|f| *f > 0.0);
    let (mut values, least) = heights(all());
    values.extend(floor.filter(|f| *f >= least));
    let mut guides = Vec::new();
    guides.extend(floor.map(|y| Guide::Below { y, name: "noise of the reference".into() }));
    guides.extend(law(view, scene, metric));
    let metric_name = view.metric_name(metric);
    let title = match levels.as_slice() {
        [spp] => format!("{} · {metric_name} at {spp} spp", scene.title),
        _ => format!("{} · {metric_name}", scene.title),
    };
    let y = log_axis(view.metric_label(metric), values);
    let panel = Panel { title: String::new(), x: levels_axis(&levels), y, form, guides, series };
    Some(Chart {
        id: format!("convergence-{name}-{metric}"),
        kind: "convergence".into(),
        title,
        panels: vec![panel],
    })
}

fn points(view: &View<'_>, scene: &SceneSummary, label: &str, metric: &str) -> Vec<Point> {
    let unit = view.metric(metric).map_or("", |m| m.unit.as_str());
    let at = |spp: u32| {
        let cell = view.cell(&scene.id, spp, label)?;
        let interval = cell.metrics.get(metric)?;
        let shown = format::interval(interval).line();
        let why = cell.left_out.as_ref().map_or_else(String::new, |why| format!(" (not ranked: {why})"));
        let about = format!("{label}, {spp} spp: {shown} {unit}").trim_end().to_owned() + &why;
        let point = point(f64::from(spp), interval, about)?;
        Some(Point { doubtful: cell.left_out.is_some(), ..point })
    };
    view.levels(&scene.id).filter_map(at).collect()
}

/// Plain Monte Carlo's law through its own points: c/n for squared errors, c/√n for their root. Nothing for metrics
/// without a rate, nor where the frames do not obey it.
fn law(view: &View<'_>, scene: &SceneSummary, metric: &str) -> Option<Guide> {
    let power = match view.metric(metric)?.order? {
        2 => 1.0,
        _ => 0.5,
    };
    let baseline = view.baseline()?;
    let constant = |spp: u32| {
        let cell = view.cell(&scene.id, spp, baseline)?;
        // The analysis fitted c where it means something.
        let interval = cell.metrics.get(metric).filter(|_| cell.equal_error.contains_key(metric))?;
        let positive = interval.below.is_none() && interval.value > 0.0;
        positive.then(|| (interval.value * f64::from(spp).powf(power)).ln())
    };
    let logs: Vec<f64> = view.levels(&scene.id).filter_map(constant).collect();
    if logs.len() < 2 {
        return None;
    }
    let c = (logs.iter().sum::<f64>() / logs.len() as f64).exp();
    let points = view.levels(&scene.id).map(|n| (f64::from(n), c / f64::from(n).powf(power))).collect();
    let name = if power == 1.0 { "c / n, fitted to mc" } else { "c / √n, fitted to mc" };
    Some(Guide::Line { points, name: name.into() })
}
