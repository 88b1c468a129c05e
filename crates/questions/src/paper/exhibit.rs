//! What a reader sees.

use noisefloor_study::exhibit::{Column, Exhibit, Number, Part, Table, TableCell, TableRow};
use noisefloor_study::format;
use noisefloor_study::summary::PaperResult;

use super::analyse::id;
use crate::shown;
use crate::view::View;

const NOTE: &str = "Ratio of two rows' errors, geometric mean over replicates on the same frames with its 95 % interval, beside \
    the ratio that the source reports. “Shown”: ours is the source's number or in its range, to within a tenth. “Agrees”: the interval meets the source's number or range. “Opposite sign”: ours and the \
    source's are on different sides of 1. The scenes are analogues of the source's, so agreement is about the effect and not about \
    digits.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    if view.summary.paper.is_empty() {
        return Vec::new();
    }
    let columns = vec![
        Column::text("What"),
        Column::text("Scene"),
        Column::number("spp").unit("spp"),
        Column::number("Ours"),
        Column::number("The paper's"),
        Column::text("Source"),
        Column::text("As the source"),
        Column::text("In words"),
    ];
    let rows = view.summary.paper.iter().map(|result| row(view, result)).collect();
    let table = Table { id: "paper".into(), columns, rows, ..Table::default() };
    vec![Exhibit {
        id: "paper".into(),
        name: "Source work".into(),
        title: "Beside the source work".into(),
        parts: vec![Part::Note(NOTE.into()), Part::Table(table)],
    }]
}

fn row(view: &View<'_>, r: &PaperResult) -> TableRow {
    let metric = view.metric_name(&r.metric);
    let details = format!("{metric} of {} over {metric} of {}", r.row, r.over);
    TableRow::new(vec![
        TableCell::text(&r.what).about(details),
        TableCell::text(view.scene_title(&r.scene)),
        TableCell::count(r.spp.into()),
        ours(r),
        theirs(r),
        TableCell::text(&r.source),
        shown::word(view.claim(&id(r))),
        TableCell::text(r.verdict.name()).aside(r.reason.clone().unwrap_or_default()),
    ])
}

/// Our ratio.
pub(super) fn ours(r: &PaperResult) -> TableCell {
    r.ours.as_ref().map_or_else(TableCell::none, shown::value)
}

/// The source's ratio; a range is no single number.
pub(super) fn theirs(r: &PaperResult) -> TableCell {
    let [low, high] = r.paper;
    TableCell { number: (low == high).then(|| Number::exact(low)), ..TableCell::text(range(r.paper)) }
}

/// `0.36`, or `0.0082 to 0.36`: as many digits as the source gives.
fn range([low, high]: [f64; 2]) -> String {
    let plain = |v: f64| if (1e-4..1e6).contains(&v) { v.to_string() } else { format::significant(v, 3) };
    if low == high { plain(low) } else { format!("{} to {}", plain(low), plain(high)) }
}

#[cfg(test)]
mod tests {
    use super::range;

    #[test]
    fn the_sources_numbers_keep_their_digits() {
        assert_eq!(range([0.36, 0.36]), "0.36");
        assert_eq!(range([0.0082, 0.36]), "0.0082 to 0.36");
        assert_eq!(range([0.000_02, 1.0]), "2.00×10⁻⁵ to 1");
    }
}
