//! What a reader sees.

use noisefloor_stats::family;
use noisefloor_study::exhibit::{
    Axis, Chart, Column, Exhibit, Form, Guide, Look, Number, Panel, Part, Point, Scale, Series, Table,
    TableCell, TableRow,
};
use noisefloor_study::format;
use noisefloor_study::summary::{Interval, SceneSummary};

use super::analyse::{Finding, id_of};
use super::measure::ID;
use crate::answers;
use crate::cell::ALL;
use crate::charts::{distinct, distinct_values, levels_axis};
use crate::section::section;
use crate::shown;
use crate::view::View;

const NOTE: &str = "How often intervals around the noisy mean contain the truth, among pixels with s > 0 or missed events, and how wide \
    they are beside Student's t (sum of widths over sum of widths). A limit has one end, so that its misses lie on one side and it has no \
    width. Truth above: the whole interval lies below the truth, as where rare bright events were met too seldom.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let found = findings(view);
    let drawn = view.named_scenes().filter(|_| view.draws("intervals"));
    let charts = drawn.filter_map(|(scene, name)| chart(view, scene, &name, &found)).collect();
    let mut parts = Vec::new();
    for (scene, name) in view.named_scenes() {
        let here = |all: bool| found.iter().filter(move |f| f.scene == scene.id && (f.class == ALL) == all);
        let rows: Vec<TableRow> = here(true).map(|f| row(view, f, false)).collect();
        if rows.is_empty() {
            continue;
        }
        parts.push(Part::Heading(scene.title.clone()));
        parts.push(Part::Table(table(format!("intervals-{name}"), false, rows)));
        let rows: Vec<TableRow> = here(false).map(|f| row(view, f, true)).collect();
        if !rows.is_empty() {
            let table = table(format!("intervals-{name}-classes"), true, rows);
            parts.push(Part::folded("By pixel class", vec![Part::Table(table)]));
        }
    }
    section([ID, "Intervals", "Families of intervals: coverage and width"], NOTE, charts, parts)
}

fn findings(view: &View<'_>) -> Vec<Finding> {
    answers::read(&view.summary.answers, ID).unwrap_or_default()
}

/// What a family covers at a level among pixels with s > 0 or missed events, if that was measured.
pub(crate) fn coverage_of(
    view: &View<'_>,
    scene: &str,
    spp: u32,
    family: &str,
    confidence: f64,
) -> Option<Interval> {
    let same = |f: &Finding| {
        f.scene == scene
            && f.spp == spp
            && f.family == family
            && f.class == ALL
            && (f.confidence - confidence).abs() < 1e-12
    };
    findings(view).into_iter().find(same).map(|f| f.covered)
}

fn name(id: &str) -> &str {
    family(id).map_or(id, |family| family.name())
}

fn table(id: String, by_class: bool, rows: Vec<TableRow>) -> Table {
    let mut columns = vec![Column::text("Family"), Column::number("spp").unit("spp")];
    columns.extend(by_class.then(|| Column::text("Class")));
    columns.push(Column::number("nominal"));
    columns.extend(
        ["covered", "truth above", "truth below", "missed events", "width over t"].map(Column::number),
    );
    Table { id, columns, rows, ..Table::default() }
}

fn row(view: &View<'_>, f: &Finding, by_class: bool) -> TableRow {
    let source = family(&f.family).map_or("", |family| family.source());
    let mut cells = vec![TableCell::text(name(&f.family)).about(source), TableCell::count(f.spp.into())];
    cells.extend(by_class.then(|| TableCell::text(&f.class)));
    cells.push(TableCell::text(format::percent_short(f.confidence)).number(Number::exact(f.confidence)));
    let covered = shown::fraction(&f.covered);
    let label = view.baseline().unwrap_or_default();
    let claim = view.claim(&id_of(&f.scene, f.spp, label, &f.family, f.confidence));
    cells.push(if by_class { covered } else { shown::judged(covered, claim) });
    cells.extend([f.above, f.below, f.missed].map(shown::share));
    cells.push(f.width.as_ref().map_or_else(TableCell::none, |width| {
        TableCell::text(format::ratio(width.value)).number(Number::from(width))
    }));
    TableRow::new(cells)
}

/// Coverage at the lowest confidence against samples, one line per family.
fn chart(view: &View<'_>, scene: &SceneSummary, scene_name: &str, found: &[Finding]) -> Option<Chart> {
    let of_scene = || found.iter().filter(|f| f.scene == scene.id && f.class == ALL);
    let nominal = *distinct_values(of_scene().map(|f| f.confidence)).first()?;
    let here: Vec<&Finding> = of_scene().filter(|f| f.confidence == nominal).collect();
    let mut families: Vec<&str> = Vec::new();
    for f in &here {
        if !families.contains(&f.family.as_str()) {
            families.push(&f.family);
        }
    }
    let t = view
        .summary
        .coverage
        .iter()
        .filter(|c| c.scene == scene.id && c.class == ALL && c.confidence == nominal);
    let t: Vec<Point> = t
        .filter_map(|c| {
            let lit = c.lit.as_ref()?;
            Some(Point {
                x: f64::from(c.spp),
                y: lit.value,
                low: lit.low,
                high: lit.high,
                about: format!("Student's t, {} spp: {}", c.spp, format::percent_interval(lit).line()),
                ..Point::default()
            })
        })
        .collect();
    let of_family = |(k, id): (usize, &&str)| Series {
        name: name(id).into(),
        look: Look::own(k + 1),
        points: here.iter().filter(|f| f.family == **id).map(|f| point(f)).collect(),
        band: false,
    };
    let first = Series { name: "Student's t".into(), look: Look::own(0), points: t, band: false };
    let series: Vec<Series> =
        std::iter::once(first).chain(families.iter().enumerate().map(of_family)).collect();
    let least = series.iter().flat_map(|s| &s.points).map(|p| p.low.unwrap_or(p.y)).fold(nominal, f64::min);
    let most = series.iter().flat_map(|s| &s.points).map(|p| p.y).fold(nominal, f64::max);
    let panel = Panel {
        title: String::new(),
        x: levels_axis(&distinct(here.iter().map(|f| f.spp))),
        y: Axis { title: "pixel-channels covered".into(), scale: Scale::Miss, values: vec![least, most] },
        form: Form::Lines,
        guides: vec![Guide::Level {
            y: nominal,
            label: format!("nominal {}", format::percent_short(nominal)),
            name: "nominal".into(),
            own: None,
        }],
        series,
    };
    Some(Chart {
        id: format!("intervals-{scene_name}"),
        kind: "intervals".into(),
        title: format!("{} · coverage of families", scene.title),
        panels: vec![panel],
    })
}

fn point(f: &Finding) -> Point {
    Point {
        x: f64::from(f.spp),
        y: f.covered.value,
        low: f.covered.low,
        high: f.covered.high,
        about: format!("{}, {} spp: {}", name(&f.family), f.spp, format::percent_interval(&f.covered).line()),
        ..Point::default()
    }
}
