//! The summary tables: one per scene and level, best row first.

use noisefloor_harness::summary::{CellSummary, Interval, SceneSummary};
use serde::Serialize;

use crate::format::{self, Shown};
use crate::index::Index;

/// All levels of a scene.
#[derive(Debug, Serialize)]
pub(crate) struct SceneTable {
    pub title: String,
    pub reference: String,
    pub levels: Vec<LevelTable>,
}

/// One scene at one level.
#[derive(Debug, Serialize)]
pub(crate) struct LevelTable {
    pub spp: u32,
    pub chosen: bool,
    pub replicates: u32,
    pub render: String,
    pub rows: Vec<Row>,
    /// Whether plain Monte Carlo has a rate in this metric, so that samples for an equal error can be told.
    pub has_equal: bool,
    pub skipped: Vec<(String, String, String)>,
    pub note: String,
    /// Rows that are left out of the ranking, with the reason.
    pub left_out: Vec<(String, String)>,
    pub metrics: Wide,
    /// Which of the metrics cannot be set beside each other.
    pub metrics_note: String,
    pub classes: Option<Wide>,
    pub pairs: Vec<Pair>,
}

/// A method in a table.
#[derive(Debug, Serialize)]
pub(crate) struct Row {
    pub label: String,
    pub swatch: usize,
    /// Cannot be told from the best.
    pub best: bool,
    /// Over how many pixels its numbers are, if not over all.
    pub pixels: String,
    /// `best`, `tied`, `first so far` and the like, with what it means; empty for other rows.
    pub tag: &'static str,
    pub tag_title: &'static str,
    pub value: Texts,
    pub ratio: Texts,
    pub forest: Option<Forest>,
    pub equal: Texts,
    pub extrapolated: bool,
    pub denoise: String,
    pub denoise_range: String,
    pub total: String,
    pub memory: String,
}

/// A number and its spread.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Texts {
    pub value: String,
    pub spread: String,
}

impl From<Shown> for Texts {
    fn from(shown: Shown) -> Self {
        Self { value: shown.value, spread: shown.spread }
    }
}

/// Positions in percent along a small logarithmic axis that all rows of a table share.
#[derive(Debug, Serialize)]
pub(crate) struct Forest {
    pub one: f64,
    pub at: f64,
    pub low: f64,
    pub width: f64,
}

/// A table with many columns.
#[derive(Debug, Serialize)]
pub(crate) struct Wide {
    pub columns: Vec<String>,
    pub rows: Vec<(String, Vec<Texts>)>,
}

/// Two rows compared.
#[derive(Debug, Serialize)]
pub(crate) struct Pair {
    pub a: String,
    pub b: String,
    pub effect: Texts,
    pub is_ratio: bool,
    pub p: String,
    pub distinguishable: bool,
}

/// The tables of a scene.
pub(crate) fn scene(index: &Index<'_>, scene: &SceneSummary) -> SceneTable {
    let chosen = index.default_spp();
    let levels = index.summary.study.spp.iter().map(|&spp| level(index, scene, spp, Some(spp) == chosen));
    SceneTable { title: scene.title.clone(), reference: scene.reference.name(), levels: levels.collect() }
}

fn level(index: &Index<'_>, scene: &SceneSummary, spp: u32, chosen: bool) -> LevelTable {
    let metric = &index.summary.study.primary_metric;
    let ranking = index.ranking(&scene.id, spp, metric);
    let ranked: Vec<&CellSummary> = ranking.iter().filter_map(|l| index.cell(&scene.id, spp, l)).collect();
    let left_out = index.left_out(&scene.id, spp);
    let cells: Vec<&CellSummary> =
        ranked.iter().copied().chain(left_out.iter().map(|(cell, _)| *cell)).collect();
    let comparison = index.comparison(&scene.id, spp, metric);
    let single = index.single(&scene.id, spp);
    let complete = index.complete_at(&scene.id, spp);
    let range = forest_range(&cells, metric);
    let group: &[String] = comparison.filter(|_| !single).map_or(&[], |c| &c.best_group);
    let rows = cells.iter().map(|cell| {
        let tag = match (cell.left_out.is_some(), group.contains(&cell.label), group.len(), complete) {
            (true, ..) => ("not ranked", "Not on the same frames and pixels as the others"),
            (_, false, ..) => ("", ""),
            (_, _, 1, true) => ("best", "The best"),
            (_, _, _, true) => ("tied", "Not distinguishable from the best"),
            (_, _, 1, false) => ("first so far", "The level is unfinished"),
            (_, _, _, false) => {
                ("tied so far", "Not distinguishable from the first; the level is unfinished")
            }
        };
        row(index, cell, metric, tag, range)
    });
    let mut notes = Vec::new();
    if let Some(c) = comparison.filter(|_| !single) {
        let family = match c.family.as_str() {
            "with-best" => "each compared with the best",
            _ => "all pairs compared",
        };
        notes.push(format!("Tied rows are not distinguishable from the best at 95 % ({family}, Holm)."));
    }
    if single {
        notes.push("One replicate: rows cannot be told apart; their order is that of the values.".into());
    }
    let replicates = ranked.first().map_or(0, |cell| cell.replicates);
    let planned = scene.replicates.get(&spp).copied().unwrap_or(0);
    if !ranked.is_empty() && replicates < planned {
        notes.push(format!(
            "Numbers are over {replicates} of {planned} replicates, those that all ranked rows have."
        ));
    }
    let pairs = comparison.map_or_else(Vec::new, |c| c.pairs.iter().map(pair).collect());
    let equal = index.metric(metric).is_some_and(|m| m.order.is_some());
    LevelTable {
        spp,
        chosen,
        replicates: planned,
        render: scene.render_seconds.get(&spp).map_or_else(String::new, |s| format::duration(*s)),
        rows: rows.collect(),
        has_equal: equal || cells.iter().any(|cell| cell.equal_error.contains_key(metric)),
        skipped: skipped(index, &scene.id, spp),
        note: notes.join(" "),
        left_out: left_out.iter().map(|(cell, why)| (cell.label.clone(), (*why).to_owned())).collect(),
        metrics: metrics(index, &cells),
        metrics_note: metrics_note(index),
        classes: classes(&cells, metric),
        pairs,
    }
}

/// Where trimmed and untrimmed values stand side by side: what keeps them from being compared.
fn metrics_note(index: &Index<'_>) -> String {
    let trimmed = index.summary.study.metrics.iter().find(|m| m.id == "relmse_trimmed");
    match (trimmed, index.metric("relmse")) {
        (Some(trimmed), Some(whole)) => {
            let noise = match trimmed.reference_noise_removed == whole.reference_noise_removed {
                true => String::new(),
                false => format!(", and the noise of the reference is taken out of {} only", whole.name),
            };
            format!(
                "† {} and {} cannot be compared with each other: {} leaves out each row's own worst 0.1 % of the pixels{noise}.",
                trimmed.name, whole.name, trimmed.name
            )
        }
        _ => String::new(),
    }
}

fn row(
    index: &Index<'_>,
    cell: &CellSummary,
    metric: &str,
    (tag, tag_title): (&'static str, &'static str),
    range: Option<(f64, f64)>,
) -> Row {
    let is_baseline = Some(cell.label.as_str()) == index.baseline();
    let ratio = cell.ratio_to_mc.get(metric).filter(|_| !is_baseline);
    let equal = cell.equal_error.get(metric).filter(|_| !is_baseline);
    let show_ratio = |i: &Interval| Texts {
        value: i.below.map_or_else(|| format::ratio(i.value), |b| format!("< {}", format::ratio(b))),
        spread: format::bracket(i, format::ratio),
    };
    let total = cell.render_seconds.map(|r| r + cell.denoise_seconds.unwrap_or(0.0));
    let range_text = cell.denoise_seconds_range.filter(|[low, high]| high > low);
    Row {
        label: cell.label.clone(),
        swatch: index.summary.methods.iter().position(|m| m.label == cell.label).unwrap_or(0),
        best: !matches!(tag, "" | "not ranked"),
        pixels: match (cell.pixels, cell.pixels_of) {
            (pixels, all) if pixels < all && pixels > 0 => format!("over {pixels} of {all} pixels"),
            _ => String::new(),
        },
        tag,
        tag_title,
        value: cell.metrics.get(metric).map(format::interval).map(Texts::from).unwrap_or_default(),
        ratio: ratio.map(show_ratio).unwrap_or_default(),
        forest: ratio.zip(range).and_then(|(i, range)| forest(i, range)),
        equal: equal.map(show_ratio).unwrap_or_default(),
        extrapolated: equal.is_some() && cell.equal_error_extrapolated.get(metric) == Some(&true),
        denoise: match cell.denoise_seconds {
            Some(s) if !is_baseline => format::duration(s),
            _ => String::new(),
        },
        denoise_range: range_text.filter(|_| !is_baseline).map_or_else(String::new, |[low, high]| {
            format!("all runs: {} to {}", format::duration(low), format::duration(high))
        }),
        total: total.map_or_else(String::new, format::duration),
        memory: cell.peak_memory_bytes.map_or_else(String::new, format::bytes),
    }
}

/// Smallest and largest end of the ratios, with one in between.
fn forest_range(cells: &[&CellSummary], metric: &str) -> Option<(f64, f64)> {
    let ends = cells
        .iter()
        .filter_map(|c| c.ratio_to_mc.get(metric))
        .flat_map(|i| [Some(i.value), i.low, i.high])
        .flatten()
        .filter(|v| *v > 0.0 && v.is_finite());
    let (low, high) = ends.fold((1.0f64, 1.0f64), |(low, high), v| (low.min(v), high.max(v)));
    (high > low).then(|| (low / 1.1, high * 1.1))
}

fn forest(i: &Interval, (low, high): (f64, f64)) -> Option<Forest> {
    // `high > low > 0` by construction of the range.
    let place = |v: f64| {
        let share = (v.max(low) / low).ln() / (high / low).ln();
        (share.clamp(0.0, 1.0) * 1000.0).round() / 10.0
    };
    (i.value > 0.0 && i.value.is_finite()).then(|| {
        let (from, to) = (place(i.low.unwrap_or(i.value)), place(i.high.unwrap_or(i.value)));
        let width = ((to - from).max(0.0) * 10.0).round() / 10.0;
        Forest { one: place(1.0), at: place(i.value), low: from, width }
    })
}

fn skipped(index: &Index<'_>, scene: &str, spp: u32) -> Vec<(String, String, String)> {
    let here = index.summary.skipped.iter().filter(|s| s.scene == scene && s.spp.contains(&spp));
    here.map(|s| (s.label.clone(), s.status.clone(), s.reason.clone())).collect()
}

fn metrics(index: &Index<'_>, cells: &[&CellSummary]) -> Wide {
    // Records of earlier programs lack metrics that came later.
    let measured = |id: &&str| cells.iter().any(|cell| cell.metrics.contains_key(*id));
    let ids: Vec<&str> = index.summary.study.metrics.iter().map(|m| m.id.as_str()).filter(measured).collect();
    let rows = cells.iter().map(|cell| {
        let show =
            |id: &&str| cell.metrics.get(*id).map(format::interval).map(Texts::from).unwrap_or_default();
        (cell.label.clone(), ids.iter().map(show).collect())
    });
    let column = |id: &&str| {
        let mark = if *id == "relmse_trimmed" { " †" } else { "" };
        format!("{}{mark}", index.metric_label(id))
    };
    Wide { columns: ids.iter().map(column).collect(), rows: rows.collect() }
}

/// The metric per pixel class, with the ratio to plain Monte Carlo.
fn classes(cells: &[&CellSummary], metric: &str) -> Option<Wide> {
    let mut names: Vec<&String> = cells.iter().flat_map(|c| c.classes.keys()).collect();
    names.sort();
    names.dedup();
    if names.is_empty() {
        return None;
    }
    let rows = cells.iter().map(|cell| {
        let show = |class: &&String| {
            let value = cell.classes.get(*class).and_then(|m| m.get(metric)).map(format::interval);
            let ratio = cell.class_ratio_to_mc.get(*class).and_then(|m| m.get(metric));
            Texts {
                value: value.map_or_else(String::new, |v| v.line()),
                spread: ratio.map_or_else(String::new, |r| format!("({} × mc)", format::ratio(r.value))),
            }
        };
        (cell.label.clone(), names.iter().map(show).collect())
    });
    Some(Wide { columns: names.iter().map(|n| (*n).clone()).collect(), rows: rows.collect() })
}

fn pair(p: &noisefloor_harness::summary::PairResult) -> Pair {
    let show = |v: f64| if p.is_ratio { format::ratio(v) } else { format::significant(v, 3) };
    Pair {
        a: p.a.clone(),
        b: p.b.clone(),
        effect: Texts { value: show(p.effect.value), spread: format::bracket(&p.effect, show) },
        is_ratio: p.is_ratio,
        p: if p.p_adjusted < 1e-4 { "< 0.0001".into() } else { format::significant(p.p_adjusted, 2) },
        distinguishable: p.distinguishable,
    }
}
