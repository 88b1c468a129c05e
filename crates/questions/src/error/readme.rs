use noisefloor_study::exhibit::{Table, TableCell};
use noisefloor_study::format;
use noisefloor_study::summary::{CellSummary, Interval, SceneSummary};

use crate::readme::{Block, Chosen, Kind, Show, headed, push};

const KEYS: &[&str] = &["metric", "show", "scenes", "spp", "rows"];

pub(super) const KINDS: &[Kind] = &[
    Kind { name: "levels", keys: KEYS, make: |chosen| chosen.per_scene(|scene| Some(levels(chosen, scene))) },
    Kind { name: "methods", keys: KEYS, make: methods },
];

fn levels(chosen: &Chosen<'_>, scene: &SceneSummary) -> Table {
    let rows = shown_rows(chosen, &[scene]);
    let names = rows.iter().map(|row| format!("`{row}`"));
    let mut out =
        headed(format!("levels-{}", scene.id), std::iter::once("samples per pixel".to_owned()).chain(names));
    for &spp in chosen.spp.iter().filter(|n| scene.replicates.contains_key(n)) {
        let cells = rows.iter().map(|row| cell(chosen, &scene.id, spp, row));
        push(&mut out, std::iter::once(TableCell::count(spp.into())).chain(cells).collect());
    }
    out
}

fn methods(chosen: &Chosen<'_>) -> Vec<Block> {
    let levels = |scene: &'_ SceneSummary| -> Vec<u32> {
        chosen.spp.iter().copied().filter(|n| scene.replicates.contains_key(n)).collect()
    };
    let places: Vec<(&str, u32)> =
        chosen.scenes.iter().flat_map(|s| levels(s).into_iter().map(|n| (s.id.as_str(), n))).collect();
    let names = places.iter().map(|(scene, spp)| format!("{scene}, {spp} spp"));
    let mut out = headed("methods".into(), std::iter::once("row".to_owned()).chain(names));
    for row in shown_rows(chosen, &chosen.scenes) {
        let cells = places.iter().map(|&(scene, spp)| cell(chosen, scene, spp, row));
        push(&mut out, std::iter::once(TableCell::text(format!("`{row}`"))).chain(cells).collect());
    }
    vec![Block::Table(out)]
}

fn cell(chosen: &Chosen<'_>, scene: &str, spp: u32, label: &str) -> TableCell {
    let Some(cell) = chosen.view.cell(scene, spp, label) else { return TableCell::none() };
    let shown = number(chosen, cell).unwrap_or_else(TableCell::none);
    match cell.left_out.is_some() {
        true => TableCell { text: format!("{} \\*", shown.text), ..shown },
        false => shown,
    }
}

fn number(chosen: &Chosen<'_>, cell: &CellSummary) -> Option<TableCell> {
    let metric = chosen.metric;
    let ratio = |i: &Interval| {
        let spread = if i.low < i.high { format::bracket(i, format::ratio) } else { String::new() };
        TableCell::text(format!("{} {spread}", format::ratio(i.value)).trim_end()).number(i.into())
    };
    match chosen.show {
        Show::Value => {
            cell.metrics.get(metric).map(|i| TableCell::text(format::interval(i).line()).number(i.into()))
        }
        Show::Ratio => cell.ratio_to_mc.get(metric).map(ratio),
        Show::Multiplier => {
            let beyond = cell.equal_error_extrapolated.get(metric) == Some(&true);
            let shown = cell.equal_error.get(metric).map(ratio)?;
            let text = if beyond { format!("{} (extrapolated)", shown.text) } else { shown.text.clone() };
            Some(TableCell { text, ..shown })
        }
    }
}

/// Rows that have a number at one of the chosen places; the ratio of the baseline to itself says nothing.
fn shown_rows<'a>(chosen: &Chosen<'a>, scenes: &[&SceneSummary]) -> Vec<&'a str> {
    let plain = chosen.view.baseline().filter(|_| chosen.show != Show::Value);
    let has = |label: &str| {
        let at = |scene: &SceneSummary, spp: u32| cell(chosen, &scene.id, spp, label) != TableCell::none();
        scenes.iter().any(|scene| chosen.spp.iter().any(|&spp| at(scene, spp)))
    };
    chosen.rows.iter().copied().filter(|label| Some(*label) != plain && has(label)).collect()
}
