use noisefloor_study::exhibit::{Column, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::Interval;

use super::super::analyse::{Finding, Shown};
use crate::cell::ALL;
use crate::shown;
use crate::view::View;

/// Of one scene: relative errors, and behind lines those of classes and without weights.
pub(super) fn parts(view: &View<'_>, name: &str, here: &[&Finding]) -> Vec<Part> {
    let of = |id: &str, keep: &dyn Fn(&Finding) -> bool| {
        let rows: Vec<TableRow> = here.iter().filter(|f| keep(f)).map(|f| row(view, f)).collect();
        Table { id: format!("{id}-{name}"), columns: columns(), rows, ..Table::default() }
    };
    let mut parts = vec![Part::Table(of("bias-variance", &|f| f.relative && f.class == ALL))];
    for (line, id, keep) in [
        ("Classes", "bias-variance-classes", (|f| f.class != ALL) as fn(&Finding) -> bool),
        ("Without weights (MSE)", "bias-variance-mse", |f| !f.relative),
    ] {
        let table = of(id, &keep);
        parts.extend((!table.rows.is_empty()).then(|| Part::folded(line, vec![Part::Table(table)])));
    }
    parts
}

fn columns() -> Vec<Column> {
    vec![
        Column::number("spp").unit("spp"),
        Column::text("Row"),
        Column::text("Class"),
        Column::number("Bias²"),
        Column::number("Variance"),
        Column::number("Share of bias"),
        Column::number("Mean bias, signed"),
        Column::text("In words"),
    ]
}

fn row(view: &View<'_>, f: &Finding) -> TableRow {
    let share = |i: &Interval| {
        let bracket = format::bracket(i, format::percent);
        TableCell::text(format::percent(i.value)).aside(bracket).number(Number::from(i))
    };
    TableRow::new(vec![
        TableCell::count(f.spp.into()),
        view.row_cell(&f.label),
        TableCell::text(&f.class),
        f.squared_bias.as_ref().map_or_else(TableCell::none, shown::value),
        shown::value(&f.variance),
        f.share.as_ref().map_or_else(TableCell::none, share),
        f.bias.as_ref().map_or_else(TableCell::none, shown::value),
        TableCell::text(word(f.shown)),
    ])
}

fn word(shown: Shown) -> &'static str {
    match shown {
        Shown::Biased => "biased",
        Shown::BelowReference => "below what the reference shows",
        Shown::BelowReplicates => "below what the replicates show",
        Shown::Unknown => "the reference states no noise",
    }
}
