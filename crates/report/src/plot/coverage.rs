//! Coverage of the input's confidence intervals against samples per pixel.

use noisefloor_harness::summary::{CoverageSummary, SceneSummary};

use super::axis::{Axis, Scale, Tick};
use super::chart::{Chart, Datum, Key};
use super::figure::{Figure, Stroke};
use super::style::{SHADE, nth};
use crate::format;
use crate::index::Index;

/// All nominal levels of one scene over all pixels; nothing if coverage was not measured there.
pub(crate) fn coverage(index: &Index<'_>, scene: &SceneSummary) -> Option<Figure> {
    let of_scene: Vec<&CoverageSummary> =
        index.summary.coverage.iter().filter(|c| c.scene == scene.id && c.class == "all").collect();
    let mut spp: Vec<u32> = of_scene.iter().map(|c| c.spp).collect();
    spp.sort_unstable();
    spp.dedup();
    let mut nominal: Vec<f64> = of_scene.iter().map(|c| c.confidence).collect();
    nominal.sort_by(f64::total_cmp);
    nominal.dedup();
    let highest = nominal.last().copied()?;
    let lowest_seen = of_scene
        .iter()
        .flat_map(|c| [Some(c.covered.value), c.covered.low, Some(1.0 - c.missed)])
        .flatten()
        .fold(nominal[0], f64::min);
    let y = miss_axis(lowest_seen, highest);
    let title = format!("{} · coverage", scene.title);
    let mut chart = Chart::new(&title, Axis::spp(&spp), y);
    let mut keys = Vec::new();
    let ceiling = ceiling(&of_scene, &spp);
    if ceiling.iter().any(|&(_, c)| c < 1.0) {
        chart.shade_above(&ceiling, 0.25);
        keys.push(Key::Shade(SHADE, 0.4, "out of reach: events that no sample met".into()));
    }
    let mut series = Vec::new();
    for (i, &level) in nominal.iter().enumerate() {
        let look = nth(i);
        let stroke = Stroke { color: look.color, width: 0.7, dash: &[3.0, 2.0] };
        chart.level(level, stroke, "");
        let data: Vec<Datum> = of_scene.iter().filter(|c| c.confidence == level).map(|c| datum(c)).collect();
        chart.band(look.color, &data);
        chart.series(look, &data, 0.0, true);
        series.push(Key::Series(
            look,
            format!("nominal {} (dashed) and measured", format::percent_short(level)),
        ));
    }
    Some(chart.finish(series, keys))
}

fn datum(c: &CoverageSummary) -> Datum {
    let mark = c.mark.as_deref().map(|m| format!(" ({m})")).unwrap_or_default();
    Datum {
        x: f64::from(c.spp),
        y: c.covered.value,
        low: c.covered.low,
        high: c.covered.high,
        limit: false,
        doubtful: false,
        spot: format!(
            "{} spp: {} of nominal {}{mark}",
            c.spp,
            format::percent_interval(&c.covered).line(),
            format::percent(c.confidence)
        ),
    }
}

/// One minus the fraction of missed events per level: no interval of this kind can cover more.
fn ceiling(of_scene: &[&CoverageSummary], spp: &[u32]) -> Vec<(f64, f64)> {
    spp.iter()
        .filter_map(|&n| {
            let missed = of_scene.iter().find(|c| c.spp == n)?.missed;
            Some((f64::from(n), 1.0 - missed))
        })
        .collect()
}

/// From just under the lowest coverage seen to a little above the highest nominal level.
fn miss_axis(lowest: f64, highest: f64) -> Axis {
    let high = 1.0 - (1.0 - highest).max(1e-6) / 3.0;
    let low = (1.0 - (1.0 - lowest).max(0.05) * 1.25).clamp(0.0, 0.94);
    let values = [0.0, 0.2, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995, 0.9999];
    let mut ticks: Vec<Tick> = Vec::new();
    let axis = Axis { scale: Scale::Miss, low, high, ticks: vec![], title: "pixel-channels covered".into() };
    let mut last = -1.0;
    for value in values.into_iter().filter(|v| (low..=high).contains(v)) {
        let at = axis.position(value);
        if at - last < 0.055 {
            continue;
        }
        last = at;
        let percent = 100.0 * value;
        ticks.push(Tick { value, label: Some(format!("{} %", (percent * 100.0).round() / 100.0)) });
    }
    Axis { ticks, ..axis }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_shows_the_nominal_levels_and_the_lowest_value() {
        let axis = miss_axis(0.62, 0.998);
        let labels: Vec<_> = axis.ticks.iter().filter_map(|t| t.label.as_deref()).collect();
        for expected in ["95 %", "99 %", "99.8 %"] {
            assert!(labels.contains(&expected), "{labels:?}");
        }
        assert!(axis.low < 0.62 && axis.high > 0.998 && axis.high < 1.0);
    }
}
