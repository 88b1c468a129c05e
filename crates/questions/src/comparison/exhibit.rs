//! What a reader sees.

use noisefloor_study::exhibit::{Column, Number, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::PairResult;

use crate::view::View;

/// The pairs that were compared on a scene at a level; nothing if none were.
pub(crate) fn pairs(view: &View<'_>, (scene, name): (&str, &str), spp: u32) -> Option<Table> {
    let (metric, metric_name) = view.primary();
    let comparison = view.comparison(scene, spp, metric).filter(|c| !c.pairs.is_empty())?;
    Some(Table {
        id: format!("pairs-{name}-{spp}"),
        caption: format!("Paired comparisons of {metric_name}"),
        columns: vec![
            Column::text("First"),
            Column::text("Second"),
            Column::number("Effect"),
            Column::number("p (Holm)"),
            Column::text(""),
        ],
        rows: comparison.pairs.iter().map(|pair| row(view, pair)).collect(),
        notes: Vec::new(),
    })
}

fn row(view: &View<'_>, p: &PairResult) -> TableRow {
    let show = |v: f64| if p.is_ratio { format::ratio(v) } else { format::significant(v, 3) };
    let effect = TableCell::text(show(p.effect.value))
        .aside(format::bracket(&p.effect, show))
        .number(Number::from(&p.effect));
    let tiny = p.p_adjusted < 1e-4;
    let probability = if tiny { "< 0.0001".into() } else { format::significant(p.p_adjusted, 2) };
    let words = if p.distinguishable { "different" } else { "not distinguishable" };
    TableRow::new(vec![
        view.row_cell(&p.a),
        view.row_cell(&p.b),
        crate::shown::effect(effect, p.is_ratio),
        TableCell::text(probability).number(Number::exact(p.p_adjusted)),
        TableCell::text(words),
    ])
}
