use noisefloor_study::exhibit::{Axis, Chart, Form, Guide, Look, Panel, Point, Scale, Series};
use noisefloor_study::format;
use noisefloor_study::summary::{CoverageSummary, SceneSummary};

use crate::charts::{distinct, distinct_values, levels_axis};
use crate::view::View;

/// All nominal levels of one scene over all pixels; nothing if coverage was not measured there.
pub(super) fn chart(view: &View<'_>, scene: &SceneSummary, name: &str) -> Option<Chart> {
    let of_scene: Vec<&CoverageSummary> =
        view.summary.coverage.iter().filter(|c| c.scene == scene.id && c.class == "all").collect();
    let levels = distinct(of_scene.iter().map(|c| c.spp));
    let nominal = distinct_values(of_scene.iter().map(|c| c.confidence));
    let (lowest, highest) = (nominal.first().copied()?, nominal.last().copied()?);
    let lowest_seen = of_scene
        .iter()
        .flat_map(|c| [Some(c.covered.value), c.covered.low, Some(1.0 - c.missed)])
        .flatten()
        .fold(lowest, f64::min);
    let mut guides = Vec::new();
    let ceiling = ceiling(&of_scene, &levels);
    if ceiling.iter().any(|&(_, c)| c < 1.0) {
        guides.push(Guide::Above { line: ceiling, name: "out of reach: events that no sample met".into() });
    }
    let level = |(k, y): (usize, &f64)| Guide::Level {
        y: *y,
        label: String::new(),
        name: String::new(),
        own: Some(k),
    };
    guides.extend(nominal.iter().enumerate().map(level));
    let series = |(k, level): (usize, &f64)| Series {
        name: format!("nominal {} (dashed) and measured", format::percent_short(*level)),
        look: Look::own(k),
        points: of_scene.iter().filter(|c| c.confidence == *level).map(|c| point(c)).collect(),
        band: true,
    };
    let panel = Panel {
        title: String::new(),
        x: levels_axis(&levels),
        y: Axis {
            title: "pixel-channels covered".into(),
            scale: Scale::Miss,
            values: vec![lowest_seen, highest],
        },
        form: Form::Lines,
        guides,
        series: nominal.iter().enumerate().map(series).collect(),
    };
    Some(Chart {
        id: format!("coverage-{name}"),
        kind: "coverage".into(),
        title: format!("{} · coverage", scene.title),
        panels: vec![panel],
    })
}

fn point(c: &CoverageSummary) -> Point {
    let mark = c.mark.as_deref().map(|m| format!(" ({m})")).unwrap_or_default();
    Point {
        x: f64::from(c.spp),
        y: c.covered.value,
        low: c.covered.low,
        high: c.covered.high,
        about: format!(
            "{} spp: {} of nominal {}{mark}",
            c.spp,
            format::percent_interval(&c.covered).line(),
            format::percent(c.confidence)
        ),
        ..Point::default()
    }
}

/// One minus the fraction of missed events per level: no interval of this kind can cover more.
fn ceiling(of_scene: &[&CoverageSummary], levels: &[u32]) -> Vec<(f64, f64)> {
    let at = |n: &u32| Some((f64::from(*n), 1.0 - of_scene.iter().find(|c| c.spp == *n)?.missed));
    levels.iter().filter_map(at).collect()
}
