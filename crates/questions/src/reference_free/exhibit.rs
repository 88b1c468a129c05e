//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::{BASELINE, format};

use super::ID;
use super::analyse::{Finding, id_of};
use crate::answers;
use crate::cell::ALL;
use crate::shown;
use crate::view::View;

const NOTE: &str = "Each replicate's intervals, widened for it, against the mean of the other replicates, among pixel-channels with \
    s > 0: no reference takes part. Beside it the coverage of the reference. What is lost between the two is the centre: a bias that \
    all replicates share, the reference's noise, or a dependence of both. Intervals that fail in both have a wrong width.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found: Vec<Finding> = answers::read(&view.summary.answers, ID).unwrap_or_default();
    let mut parts = vec![Part::Note(NOTE.into())];
    for (scene, name) in view.named_scenes() {
        let here = || found.iter().filter(|f| f.scene == scene.id);
        let all = table(view, format!("reference-free-{name}"), here().filter(|f| f.class == ALL));
        if all.rows.is_empty() {
            continue;
        }
        parts.push(Part::Heading(scene.title.clone()));
        parts.push(Part::Table(all));
        let classes =
            table(view, format!("reference-free-{name}-classes"), here().filter(|f| f.class != ALL));
        parts.extend((!classes.rows.is_empty()).then(|| Part::folded("Classes", vec![Part::Table(classes)])));
    }
    if parts.len() == 1 {
        return Vec::new();
    }
    vec![Exhibit {
        id: ID.into(),
        name: "Coverage without a reference".into(),
        title: "Coverage of the input's intervals without a reference".into(),
        parts,
    }]
}

fn table<'a>(view: &View<'_>, id: String, found: impl Iterator<Item = &'a Finding>) -> Table {
    Table {
        id,
        columns: vec![
            Column::number("spp").unit("spp"),
            Column::text("Class"),
            Column::number("Nominal"),
            Column::number("Without a reference"),
            Column::number("Against the reference"),
            Column::number("Lost to the centre"),
            Column::number("Constant"),
            Column::number("Missed events"),
        ],
        rows: found.map(|f| row(view, f)).collect(),
        ..Table::default()
    }
}

fn row(view: &View<'_>, f: &Finding) -> TableRow {
    let label = view.baseline().unwrap_or(BASELINE);
    let sided = f.above.map_or_else(String::new, |above| {
        format!("{} of the misses lie below the others' mean", format::percent(above))
    });
    let covered = TableCell { about: sided, ..shown::fraction(&f.covered) };
    let claim = view.claim(&id_of(f, label)).filter(|_| f.class == ALL);
    let share = |v: Option<f64>| v.map_or_else(TableCell::none, shown::share);
    let lost = f.lost.as_ref().map_or_else(TableCell::none, |lost| {
        TableCell::text(format::percent(lost.value))
            .aside(format::bracket(lost, format::percent))
            .number(Number::from(lost))
    });
    TableRow::new(vec![
        TableCell::count(f.spp.into()),
        TableCell::text(&f.class),
        shown::share(f.confidence),
        shown::judged(covered, claim),
        share(f.against),
        lost,
        shown::share(f.constant),
        shown::share(f.missed),
    ])
}
