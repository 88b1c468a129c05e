//! What a reader sees.

mod chart;

use noisefloor_study::exhibit::{Column, Exhibit, Part, Table, TableCell, TableRow};
use noisefloor_study::{BASELINE, format};

use super::ID;
use super::analyse::{Finding, Findings, id_of};
use crate::answers;
use crate::section::section;
use crate::shown;
use crate::view::View;

const NOTE: &str = "At which of its own quantiles u the t-interval of a pixel has the truth: uniform if intervals are right at every \
    confidence at once. Green channel of at most 1000 pixels on a grid, where the truth is exact or known from 256 times the samples. \
    Drawn is how far the distribution of u, mean over replicates, lies above the diagonal; between the dotted lines one replicate of \
    uniform values stays with 95 % probability. A curve that ends below 0 on the right has too many truths far above the interval: \
    light that most samples missed.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found: Findings = answers::read(&view.summary.answers, ID).unwrap_or_default();
    let (mut tables, mut charts) = (Vec::new(), Vec::new());
    for (scene, name) in view.named_scenes() {
        let here: Vec<&Finding> = found.levels.iter().filter(|f| f.scene == scene.id).collect();
        if here.is_empty() {
            continue;
        }
        charts.extend(chart::chart(scene, &name, &here, &found.bands).filter(|_| view.draws("pit")));
        tables.push(Part::Heading(scene.title.clone()));
        tables.push(Part::Table(Table {
            id: format!("pit-{name}"),
            columns: columns(),
            rows: here.iter().map(|f| row(view, f)).collect(),
            ..Table::default()
        }));
    }
    section([ID, "PIT", "Probability integral transform of the input"], NOTE, charts, tables)
}

fn columns() -> Vec<Column> {
    vec![
        Column::number("spp").unit("spp"),
        Column::number("Values"),
        Column::number("Largest deviation"),
        Column::number("Constant"),
        Column::number("Missed, truth above"),
        Column::number("Missed, truth below"),
        Column::number("Left out"),
    ]
}

fn row(view: &View<'_>, f: &Finding) -> TableRow {
    let claim = view.claim(&id_of(f, view.baseline().unwrap_or(BASELINE)));
    let allowed = claim.and_then(|claim| claim.region);
    let allowed =
        allowed.map_or_else(String::new, |region| format!("up to {}", format::significant(region.high, 2)));
    TableRow::new(vec![
        TableCell::count(f.spp.into()),
        TableCell::count(f.values),
        shown::judged(shown::value(&f.deviation).about(allowed), claim),
        shown::share(f.constant),
        shown::share(f.missed_above),
        shown::share(f.missed_below),
        TableCell::count(f.left_out),
    ])
}
