//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;

use super::analyse::{Finding, id_of};
use super::level::ID;
use crate::answers;
use crate::cell::ALL;
use crate::shown;
use crate::view::View;

const NOTE: &str = "How often a pixel is told apart from the same pixel of another replicate, whose mean is the same whatever the light \
    (shift 0: false alarms), and from one whose mean was moved up by so many estimated standard errors (power). Beside it the rate of \
    normal samples with equal errors, where it is known exactly. Pixels with s > 0, channel by channel; in colour, a pixel is told apart \
    if one of its channels is.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found: Vec<Finding> = answers::read(&view.summary.answers, ID).unwrap_or_default();
    if found.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![Part::Note(NOTE.into())];
    for (scene, name) in view.named_scenes() {
        let here = |all: bool| found.iter().filter(move |f| f.scene == scene.id && (f.class == ALL) == all);
        let rows: Vec<TableRow> = here(true).map(|f| row(view, f, false)).collect();
        if rows.is_empty() {
            continue;
        }
        parts.push(Part::Heading(scene.title.clone()));
        parts.push(Part::Table(table(format!("membership-{name}"), false, rows)));
        let rows: Vec<TableRow> =
            here(false).filter(|f| f.shift == 0.0).map(|f| row(view, f, true)).collect();
        if !rows.is_empty() {
            let table = table(format!("membership-{name}-classes"), true, rows);
            parts.push(Part::folded("False alarms by pixel class", vec![Part::Table(table)]));
        }
    }
    let title = "Tests of membership: false alarms and power".into();
    vec![Exhibit { id: ID.into(), name: "Membership".into(), title, parts }]
}

fn table(id: String, by_class: bool, rows: Vec<TableRow>) -> Table {
    let mut columns = vec![Column::text("Test"), Column::number("spp").unit("spp")];
    columns.extend(by_class.then(|| Column::text("Class")));
    columns.extend(["level", "shift", "told apart", "of normal samples", "in colour"].map(Column::number));
    Table { id, columns, rows, ..Table::default() }
}

fn row(view: &View<'_>, f: &Finding, by_class: bool) -> TableRow {
    let mut cells = vec![TableCell::text(&f.test), TableCell::count(f.spp.into())];
    cells.extend(by_class.then(|| TableCell::text(&f.class)));
    cells.push(TableCell::text(format::percent_short(f.confidence)).number(Number::exact(f.confidence)));
    cells.push(TableCell::text(format::significant(f.shift, 1)).number(Number::exact(f.shift)));
    let rejected = shown::fraction(&f.rejected);
    let claim = view.claim(&id_of(f, view.baseline().unwrap_or_default()));
    let judged = !by_class && f.shift == 0.0;
    cells.push(if judged { shown::judged(rejected, claim) } else { rejected });
    cells.push(f.normal.map_or_else(TableCell::none, shown::share));
    cells.push(shown::share(f.joint));
    TableRow::new(cells)
}
