use noisefloor_study::exhibit::{Column, Number, Part, Table, TableCell, TableRow, Tone};

use crate::view::View;

const NOTE: &str = "Largest |D − x̄| over its limit, over all pixels, channels, levels and replicates. At most 1 if the promise held.";

/// Worst |D − x̄| over the half-width, per row and scene; nothing if no row claims an enclosure.
pub(super) fn parts(view: &View<'_>) -> Vec<Part> {
    let summary = view.summary;
    let worst = |scene: &str, label: &str| {
        let here = summary.cells.iter().filter(|c| c.scene == scene && c.label == label);
        here.filter_map(|c| c.enclosure_worst_ratio).reduce(f64::max)
    };
    let mut rows = Vec::new();
    for method in &summary.methods {
        let ratios: Vec<Option<f64>> = summary.scenes.iter().map(|s| worst(&s.id, &method.label)).collect();
        if ratios.iter().any(Option::is_some) {
            let cells = ratios.into_iter().map(|ratio| ratio.map_or_else(TableCell::none, cell));
            rows.push(TableRow::new(std::iter::once(view.row_cell(&method.label)).chain(cells).collect()));
        }
    }
    if rows.is_empty() {
        return Vec::new();
    }
    let scenes = summary.scenes.iter().map(|scene| Column::number(&scene.title));
    let table = Table {
        id: "enclosures".into(),
        columns: std::iter::once(Column::text("Method")).chain(scenes).collect(),
        rows,
        ..Table::default()
    };
    vec![
        Part::Heading("The certain half: no output outside its interval".into()),
        Part::Note(NOTE.into()),
        Part::Table(table),
    ]
}

fn cell(ratio: f64) -> TableCell {
    let (word, tone) = if ratio <= 1.0 { ("held", Tone::Plain) } else { ("violated", Tone::Bad) };
    TableCell::text(format!("{ratio:.6}")).number(Number::exact(ratio)).tag(word, tone, "").tone(tone)
}
