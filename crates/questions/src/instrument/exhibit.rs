//! What a reader sees.

use noisefloor_study::check::CheckKind;
use noisefloor_study::exhibit::{Answer, Column, Exhibit, Number, Part, Table, TableCell, TableRow, Tone};
use noisefloor_study::format;

use super::analyse::{ALPHA, Check, checks, sentence};
use super::id::ID;
use crate::shown;
use crate::view::View;

const NOTE: &str = "The instrument checks itself: intervals on samples whose coverage is known (I1, I2), the spread of half buffers \
    against the stated variance (I3), brightness of frames against their reference (I4) and of a scene that is known in closed form (I6), \
    independence of frames and reference (I5), estimates of the own error where the variance is known (I7). One family: a report without a \
    fault fails in at most 1 of 100.";

pub(super) fn answer(view: &View<'_>) -> Option<Answer> {
    let all = checks(view.summary);
    if all.is_empty() {
        return None;
    }
    let failed: Vec<&Check> = all.iter().filter(|check| check.failed).collect();
    let silent = all.iter().filter(|check| check.adjusted.is_none()).count();
    let mut sentences = Vec::new();
    if failed.is_empty() {
        sentences.push(format!("{} found no fault.", format::plural(all.len() - silent, "check")));
    } else {
        sentences.push(format!(
            "{} of {} found a fault.",
            failed.len(),
            format::plural(all.len() - silent, "check")
        ));
        sentences.extend(CheckKind::ALL.into_iter().filter_map(|kind| largest(kind, &failed)));
    }
    sentences.extend((silent > 0).then(|| format!("{silent} could not tell, for the reasons below.")));
    // No fault found is not the same as none being there: nothing is green.
    let tone = if failed.is_empty() { Tone::Plain } else { Tone::Bad };
    Some(Answer { question: "Does the instrument work?".into(), sentences, tone })
}

/// The largest fault that a kind of check found, and how many more: no kind hides behind another that finds many.
fn largest(kind: CheckKind, failed: &[&Check]) -> Option<String> {
    let of_kind = || failed.iter().filter(|check| check.record.kind == kind);
    let size = |check: &Check| check.record.found.map_or(0.0, |found| found.z.abs());
    let worst = of_kind().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let more = match of_kind().count() - 1 {
        0 => String::new(),
        more => format!(" (and {more} more)"),
    };
    Some(format!("{}{more}.", sentence(worst)))
}

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let all = checks(view.summary);
    if all.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![Part::Note(NOTE.into())];
    let failed: Vec<&Check> = all.iter().filter(|check| check.failed).collect();
    if !failed.is_empty() {
        parts.push(Part::Heading("Faults".into()));
        parts.push(Part::Table(table("instrument-faults", failed.into_iter())));
    }
    parts.push(Part::Table(overview(&all)));
    parts.push(Part::folded("Every check", vec![Part::Table(table("instrument", all.iter()))]));
    vec![Exhibit {
        id: ID.into(),
        name: "Instrument".into(),
        title: "Checks of the instrument".into(),
        parts,
    }]
}

/// One line per kind: how many, the largest deviation, how many found a fault.
fn overview(all: &[Check]) -> Table {
    let rows = CheckKind::ALL.into_iter().map(|kind| {
        let of_kind = || all.iter().filter(move |check| check.record.kind == kind);
        let count = of_kind().count();
        let tested = of_kind().filter(|check| check.adjusted.is_some()).count();
        let least = of_kind().filter_map(|check| check.adjusted).reduce(f64::min);
        let failed = of_kind().filter(|check| check.failed).count();
        let word = match (failed, tested) {
            // Such as half buffers, which frames have only where a row needs them.
            (0, 0) if count == 0 => TableCell::text("not made: nothing here to make it of"),
            (0, 0) => TableCell::text("could not tell"),
            (0, _) => TableCell::text("no fault found"),
            _ => TableCell::text(format!("{failed} found a fault")).tone(Tone::Bad),
        };
        TableRow::new(vec![
            TableCell::text(format!("{} {}", kind.id(), kind.name())),
            TableCell::count(count as u64),
            TableCell::count((count - tested) as u64),
            least.map_or_else(TableCell::none, |p| {
                TableCell::text(shown::probability(p)).number(Number::exact(p))
            }),
            word,
        ])
    });
    Table {
        id: "instrument-kinds".into(),
        columns: vec![
            Column::text("Check"),
            Column::number("Tests"),
            Column::number("Could not tell"),
            Column::number("Least p (Holm)"),
            Column::text("Result"),
        ],
        rows: rows.collect(),
        notes: vec![format!("A fault is told where p after Holm's rule over all checks is at most {ALPHA}.")],
        ..Table::default()
    }
}

fn table<'a>(id: &str, checks: impl Iterator<Item = &'a Check>) -> Table {
    let row = |check: &Check| {
        let record = &check.record;
        let number = |v: Option<f64>| {
            v.filter(|v| *v < f64::MAX).map_or_else(TableCell::none, |v| {
                TableCell::text(format::significant(v, 4)).number(Number::exact(v))
            })
        };
        let word = match (check.failed, check.adjusted) {
            (true, _) => TableCell::text("fault").tone(Tone::Bad),
            (false, Some(_)) => TableCell::text("no fault found"),
            (false, None) => TableCell::text("could not tell"),
        };
        TableRow::new(vec![
            TableCell::text(record.kind.id()),
            TableCell::text(&record.scene),
            record.spp.map_or_else(TableCell::none, |spp| TableCell::count(spp.into())),
            TableCell::text(&record.what).aside(record.note.clone()),
            number(record.found.map(|f| f.value)),
            number(record.found.map(|f| f.expected)),
            number(record.found.map(|f| f.z)),
            check.adjusted.map_or_else(TableCell::none, |p| {
                TableCell::text(shown::probability(p)).number(Number::exact(p))
            }),
            word,
        ])
    };
    Table {
        id: id.into(),
        columns: vec![
            Column::text("Check"),
            Column::text("Scene"),
            Column::number("spp").unit("spp"),
            Column::text("What"),
            Column::number("Found"),
            Column::number("Expected"),
            Column::number("Standard errors"),
            Column::number("p (Holm)"),
            Column::text("Result"),
        ],
        rows: checks.map(row).collect(),
        ..Table::default()
    }
}
