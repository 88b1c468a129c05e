use noisefloor_stats::Family;
use noisefloor_study::exhibit::{Column, Part, RowState, Table, TableCell, TableRow, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::{CellSummary, SceneSummary};

use super::row::{Shown, Standing, row};
use super::{forest, metrics};
use crate::comparison::pairs;
use crate::view::View;

/// The table of a scene at a level, best row first, with everything else that was measured there behind a line.
pub(super) fn parts(view: &View<'_>, scene: &SceneSummary, name: &str, spp: u32) -> Vec<Part> {
    let (metric, _) = view.primary();
    let ranking = view.ranking(&scene.id, spp, metric);
    let ranked: Vec<&CellSummary> = ranking.iter().filter_map(|l| view.cell(&scene.id, spp, l)).collect();
    let left_out = view.left_out(&scene.id, spp);
    let cells: Vec<&CellSummary> =
        ranked.iter().copied().chain(left_out.iter().map(|(cell, _)| *cell)).collect();
    let rated = view.metric(metric).is_some_and(|m| m.order.is_some());
    let shown = Shown {
        metric,
        equal: rated || cells.iter().any(|cell| cell.equal_error.contains_key(metric)),
        range: forest::range(&cells, metric),
    };
    let standings = Standings::of(view, &scene.id, spp);
    let mut rows: Vec<TableRow> =
        cells.iter().map(|cell| row(view, cell, shown, standings.standing(cell))).collect();
    rows.extend(skipped(view, &scene.id, spp));
    let table = Table {
        id: format!("errors-{name}-{spp}"),
        caption: caption(scene, spp),
        columns: columns(view, shown),
        rows,
        notes: notes(view, scene, spp, &ranked),
    };
    let mut parts = vec![Part::Table(table)];
    if !cells.is_empty() {
        let classes = metrics::classes(view, name, spp, &cells);
        let pairs = pairs(view, (&scene.id, name), spp);
        let mut title = "All metrics".to_owned();
        title += if classes.is_some() { ", pixel classes" } else { "" };
        title += if pairs.is_some() { ", comparisons" } else { "" };
        let all = [Some(metrics::all(view, name, spp, &cells)), classes, pairs];
        parts.push(Part::folded(title, all.into_iter().flatten().map(Part::Table).collect()));
    }
    parts
}

fn caption(scene: &SceneSummary, spp: u32) -> String {
    let planned = scene.replicates.get(&spp).copied().unwrap_or(0);
    let mut caption = format!("{spp} spp · {}", format::plural(planned as usize, "replicate"));
    if let Some(seconds) = scene.render_seconds.get(&spp) {
        caption += &format!(" · rendering takes {}", format::duration(*seconds));
    }
    format!("{caption} · {}", scene.reference.name())
}

fn columns(view: &View<'_>, shown: Shown<'_>) -> Vec<Column> {
    let unit = view.metric(shown.metric).map_or("", |m| m.unit.as_str());
    let mut columns = vec![
        Column::text("Method"),
        Column::number(view.metric_name(shown.metric)).unit(unit),
        Column::number("Ratio to mc"),
    ];
    columns.extend(shown.equal.then(|| Column::number("Equal error, × samples")));
    columns.extend(["Denoise", "Render + denoise"].map(|head| Column::number(head).unit("s")));
    columns
}

/// What the replicates of a level can tell.
struct Standings<'a> {
    /// Rows that they cannot tell from the best; empty where they tell nothing.
    group: &'a [String],
    complete: bool,
}

impl<'a> Standings<'a> {
    fn of(view: &View<'a>, scene: &str, spp: u32) -> Self {
        let comparison = view.comparison(scene, spp, view.primary().0);
        let told = comparison.filter(|_| !view.single(scene, spp));
        Self { group: told.map_or(&[], |c| &c.best_group), complete: view.complete_at(scene, spp) }
    }

    fn standing(&self, cell: &CellSummary) -> Standing {
        match (self.group.contains(&cell.label), self.group.len(), self.complete) {
            _ if cell.left_out.is_some() => Standing::LeftOut,
            (false, ..) => Standing::Behind,
            (_, 1, true) => Standing::Best,
            (_, _, true) => Standing::Tied,
            (_, 1, false) => Standing::FirstSoFar,
            (_, _, false) => Standing::TiedSoFar,
        }
    }
}

/// Rows that did not run here; the reason spans the columns of numbers.
fn skipped(view: &View<'_>, scene: &str, spp: u32) -> Vec<TableRow> {
    let here = view.summary.skipped.iter().filter(|s| s.scene == scene && s.spp.contains(&spp));
    here.map(|s| TableRow {
        cells: vec![
            view.row_cell(&s.label),
            TableCell::text(&s.reason).tag(s.status.name(), Tone::Plain, ""),
        ],
        state: RowState::Absent,
    })
    .collect()
}

fn notes(view: &View<'_>, scene: &SceneSummary, spp: u32, ranked: &[&CellSummary]) -> Vec<String> {
    let mut notes = Vec::new();
    if view.single(&scene.id, spp) {
        notes.push("One replicate: rows cannot be told apart; their order is that of the values.".into());
    } else if let Some(comparison) = view.comparison(&scene.id, spp, view.primary().0) {
        let family = match comparison.family {
            Family::WithBest => "each compared with the best",
            Family::AllPairs => "all pairs compared",
        };
        notes.push(format!("Tied rows are not distinguishable from the best at 95 % ({family}, Holm)."));
    }
    let replicates = ranked.first().map_or(0, |cell| cell.replicates);
    let planned = scene.replicates.get(&spp).copied().unwrap_or(0);
    if !ranked.is_empty() && replicates < planned {
        notes.push(format!(
            "Numbers are over {replicates} of {planned} replicates, those that all ranked rows have."
        ));
    }
    for (cell, why) in view.left_out(&scene.id, spp) {
        notes.push(format!("{} is not ranked: {why}.", cell.label));
    }
    notes
}
