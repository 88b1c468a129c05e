//! What a reader sees: claim, evidence, verdict, what would change it.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::{ClaimSummary, Scale};

use super::ID;
use crate::shown;
use crate::view::View;

const NOTE: &str = "Shown: the 95 % interval of the effect lies where the claim says. Refuted: it lies outside, and stays there beside \
    all other claims of this page (Holm's rule). Not shown: neither, so nothing is proved either way; the last column says what would \
    decide it. The unit of evidence is the replicate: one alone proves nothing. Every claim is judged at 95 % (the instrument's checks, \
    which are no claims, at 99 %).";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    if view.summary.claims.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![Part::Note(NOTE.into()), Part::Note(family(view))];
    for (question, title) in KINDS {
        let of_question = view.summary.claims.iter().filter(|claim| claim.id.question == question);
        let claims: Vec<&ClaimSummary> = of_question.collect();
        if !claims.is_empty() {
            parts.push(Part::Heading(title.into()));
            parts.push(Part::Table(table(view, question, &claims)));
        }
    }
    let title = "Statistics: claims, evidence, verdicts".into();
    vec![Exhibit { id: ID.into(), name: "Statistics".into(), title, parts }]
}

/// Questions whose claims are judged, in the order of the page, with their headings.
const KINDS: [(&str, &str); 9] = [
    ("coverage", "The input's confidence intervals"),
    ("reference_free", "The input's confidence intervals, without a reference"),
    ("pit", "Uniformity of the input's probability integral transform"),
    ("intervals", "Other intervals"),
    ("bounds", "Error bounds"),
    ("membership", "Tests of membership"),
    ("own_error", "Methods' estimates of their own error"),
    ("convergence", "Convergence of the input"),
    ("paper", "What the source work reports"),
];

fn family(view: &View<'_>) -> String {
    let family = view.summary.family;
    format!(
        "{} of {} claims with an interval are refuted if each is taken alone; at most {} would be by chance, if all held.",
        family.refuted_alone,
        family.tested,
        format::significant(family.by_chance, 2)
    )
}

/// One table per question; a row of the study is named where the claims are of several.
fn table(view: &View<'_>, question: &str, claims: &[&ClaimSummary]) -> Table {
    let of_several = claims.iter().any(|claim| claim.id.label != claims[0].id.label);
    let mut columns = vec![Column::text("Scene"), Column::number("spp").unit("spp")];
    columns.extend(of_several.then(|| Column::text("Row")));
    columns.extend([
        Column::text("Claim"),
        Column::text("Claimed"),
        Column::number("Measured"),
        Column::number("Replicates"),
        Column::text("Verdict"),
        Column::number("p (Holm)"),
        Column::text("What would change it"),
    ]);
    let rows = claims.iter().map(|claim| row(view, claim, of_several)).collect();
    Table { id: format!("claims-{question}"), columns, rows, ..Table::default() }
}

fn row(view: &View<'_>, claim: &ClaimSummary, of_several: bool) -> TableRow {
    let spp = claim.id.spp.map_or_else(TableCell::none, |spp| TableCell::count(spp.into()));
    let p = claim.p_adjusted.map_or_else(TableCell::none, |p| {
        let alone = claim.p.map_or_else(String::new, |p| format!("alone {}", shown::probability(p)));
        TableCell::text(shown::probability(p)).number(Number::exact(p)).about(alone)
    });
    let mut cells = vec![TableCell::text(view.scene_title(&claim.id.scene)), spp];
    cells.extend(of_several.then(|| view.row_cell(&claim.id.label)));
    cells.extend([
        TableCell::text(&claim.sentence),
        TableCell::text(shown::region(claim)),
        measured(claim),
        TableCell::count(u64::from(claim.effect.n) * u64::from(claim.replicates_per_value)),
        shown::word(Some(claim)),
        p,
        TableCell::text(shown::changed_by(claim)),
    ]);
    TableRow::new(cells)
}

/// The effect with its interval; where the reference's noise matters, what it would be without the allowance.
fn measured(claim: &ClaimSummary) -> TableCell {
    let cell = match claim.scale {
        Scale::Share => shown::fraction(&claim.effect),
        Scale::Ratio => shown::ratio(&claim.effect),
        Scale::Number => shown::value(&claim.effect),
    };
    match &claim.uncorrected {
        Some(raw) => {
            let number = |v: f64| shown::number(claim.scale, v);
            let lowest = raw.low.into_iter().chain(claim.effect.low).reduce(f64::min);
            let highest = raw.high.into_iter().chain(claim.effect.high).reduce(f64::max);
            let judged = lowest.zip(highest).map_or_else(String::new, |(low, high)| {
                format!("; judged is all from {} to {}", number(low), number(high))
            });
            let raw = format!("{} without the allowance for the reference{judged}", number(raw.value));
            TableCell { aside: shown::joined(&[&cell.aside, &raw], "; "), ..cell }
        }
        None => cell,
    }
}
