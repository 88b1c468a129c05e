//! How often error bounds were exceeded, beside the rate that they promise.

use std::collections::BTreeSet;

use noisefloor_harness::summary::{BoundSummary, SceneSummary};

use super::axis::{Axis, Scale, log_range, log_ticks, plain};
use super::chart::{Chart, Datum, Key};
use super::figure::{Figure, Stroke};
use super::style::{INK, Look, Marker};
use crate::format;
use crate::index::Index;

/// Share of the vertical axis that stands for zero.
const ZERO_STRIP: f64 = 0.09;

/// Violation rates over all pixels of one scene; nothing if no row claims a bound there.
pub(crate) fn bounds(index: &Index<'_>, scene: &SceneSummary) -> Option<Figure> {
    let of_scene: Vec<&BoundSummary> =
        index.summary.bounds.iter().filter(|b| b.scene == scene.id && b.class == "all").collect();
    if of_scene.is_empty() {
        return None;
    }
    let mut spp: Vec<u32> = of_scene.iter().map(|b| b.spp).collect();
    spp.sort_unstable();
    spp.dedup();
    let mut alphas: Vec<f64> = of_scene.iter().map(|b| b.alpha).collect();
    alphas.sort_by(f64::total_cmp);
    alphas.dedup();
    let rates = of_scene.iter().flat_map(|b| [Some(b.violations.value), b.violations.high]).flatten();
    let (low, high) = log_range(rates.chain(alphas.iter().copied()).filter(|v| *v > 1e-7), 0.08);
    let high = high.min(1.0);
    let y = Axis {
        scale: Scale::LogWithZero(ZERO_STRIP),
        low,
        high,
        ticks: log_ticks(low, high, &plain),
        title: "violation rate".into(),
    };
    let title = format!("{} · bound violations", scene.title);
    let mut chart = Chart::new(&title, Axis::spp(&spp), y);
    let promised = Stroke { color: INK, width: 0.8, dash: &[3.0, 2.0] };
    for &alpha in &alphas {
        chart.level(alpha, promised, &format!("α = {}", short(alpha)));
    }
    let rows = rows(index, &of_scene);
    let step = (14.0 / rows.len() as f64).min(3.4);
    let mut keys = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let look = look(index, row, &rows);
        let data: Vec<Datum> = of_scene.iter().filter(|b| row.matches(b)).map(|b| datum(b)).collect();
        let shift = (i as f64 - 0.5 * (rows.len() - 1) as f64) * step;
        chart.series(look, &data, shift, true);
        let kind = match row.proven {
            true => " (proven)",
            false if row.claim.contains("as printed") => "",
            false => " (as printed)",
        };
        keys.push(Key::Series(look, format!("{} · {}{kind}", row.label, row.claim)));
    }
    Some(chart.finish(keys, vec![Key::Line(promised, "promised rate α".into())]))
}

/// As many digits as α needs.
fn short(alpha: f64) -> String {
    let text = format::significant(alpha, 2);
    if text.contains('.') { text.trim_end_matches('0').to_owned() } else { text }
}

/// A claim of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Row<'a> {
    position: usize,
    label: &'a str,
    claim: &'a str,
    proven: bool,
}

impl Row<'_> {
    fn matches(&self, b: &BoundSummary) -> bool {
        b.label == self.label && b.claim == self.claim && b.proven == self.proven
    }
}

fn rows<'a>(index: &Index<'_>, bounds: &[&'a BoundSummary]) -> Vec<Row<'a>> {
    let position = |label: &str| index.summary.methods.iter().position(|m| m.label == label);
    let set: BTreeSet<Row<'a>> = bounds
        .iter()
        .map(|b| Row {
            position: position(&b.label).unwrap_or(usize::MAX),
            label: &b.label,
            claim: &b.claim,
            proven: b.proven,
        })
        .collect();
    set.into_iter().collect()
}

/// The row's colour; filled for proven claims, open for claims as printed; further claims change the marker.
fn look(index: &Index<'_>, row: &Row<'_>, rows: &[Row<'_>]) -> Look {
    const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];
    let nth = rows.iter().filter(|r| r.label == row.label).position(|r| r == row).unwrap_or(0);
    Look { open: !row.proven, marker: MARKERS[nth % MARKERS.len()], ..index.looks.get(row.label) }
}

fn datum(b: &BoundSummary) -> Datum {
    let mark = b.mark.as_deref().map(|m| format!(" ({m})")).unwrap_or_default();
    Datum {
        x: f64::from(b.spp),
        y: b.violations.value.max(0.0),
        low: b.violations.low.map(|v| v.max(0.0)),
        high: b.violations.high,
        limit: false,
        doubtful: false,
        spot: format!(
            "{}, {}, {} spp: {} beside α = {}{mark}",
            b.label,
            b.claim,
            b.spp,
            format::percent_interval(&b.violations).line(),
            format::percent(b.alpha)
        ),
    }
}
