use noisefloor_stats::Trend;
use noisefloor_study::exhibit::{Column, Exhibit, Part, Table, TableCell, TableRow, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::SlopeSummary;

use crate::shown;
use crate::view::View;

const NOTE: &str = "Slope of log error against log samples, fitted per replicate. Plain Monte Carlo has −1 for squared errors and −½ for \
    their root.";

/// Slopes and verdicts; nothing if none could be fitted.
pub(super) fn exhibit(view: &View<'_>) -> Option<Exhibit> {
    let study = &view.summary.study;
    let primary = study.primary_metric.as_str();
    let others = study.metrics.iter().map(|m| m.id.as_str()).filter(|id| *id != primary);
    let first = tables(view, primary);
    let others: Vec<Part> = others.flat_map(|metric| tables(view, metric)).collect();
    if first.is_empty() && others.is_empty() {
        return None;
    }
    let mut parts = vec![Part::Note(NOTE.into())];
    parts.extend(first);
    parts.extend((!others.is_empty()).then(|| Part::folded("Other metrics", others)));
    Some(Exhibit {
        id: "slopes".into(),
        name: "Consistency".into(),
        title: "Consistency: does the error vanish?".into(),
        parts,
    })
}

/// One table per scene that has slopes of a metric.
fn tables(view: &View<'_>, metric: &str) -> Vec<Part> {
    let of_scene = |(scene, name): (&noisefloor_study::summary::SceneSummary, String)| {
        let here = view.summary.slopes.iter().filter(|s| s.scene == scene.id && s.metric == metric);
        let table = Table {
            id: format!("slopes-{name}-{metric}"),
            caption: format!("{} · {}", scene.title, view.metric_name(metric)),
            columns: vec![
                Column::text("Method"),
                Column::number("Slope"),
                Column::text("Trend"),
                Column::text("In words"),
            ],
            rows: here.map(|s| row(view, s)).collect(),
            notes: Vec::new(),
        };
        (!table.rows.is_empty()).then_some(Part::Table(table))
    };
    view.named_scenes().filter_map(of_scene).collect()
}

fn row(view: &View<'_>, s: &SlopeSummary) -> TableRow {
    let mut sentence = plain(&s.sentence, s.verdict.name());
    // The sentence names the bias itself; without one the number stands alone.
    if let (true, Some(bias)) = (sentence.is_empty(), &s.bias) {
        sentence = format!("levels off at {}", format::interval(bias).line());
    }
    let tone = match s.verdict {
        Trend::Plateaus => Tone::Bad,
        // No sign of a floor on these levels shows nothing for certain.
        Trend::Consistent | Trend::Undecided => Tone::Plain,
    };
    TableRow::new(vec![
        view.row_cell(&s.label),
        shown::value(&s.slope),
        TableCell::text(s.verdict.name()).tone(tone),
        TableCell::text(sentence),
    ])
}

/// The sentence without the verdict that stands beside it, with true minus signs.
fn plain(sentence: &str, verdict: &str) -> String {
    let rest = sentence.strip_prefix(verdict).and_then(|s| s.strip_prefix(": ")).unwrap_or(sentence);
    let mut out = String::with_capacity(rest.len());
    let mut before = ' ';
    for (i, c) in rest.char_indices() {
        let number = rest[i + c.len_utf8()..].starts_with(|d: char| d.is_ascii_digit());
        out.push(if c == '-' && number && !before.is_alphanumeric() { '−' } else { c });
        before = c;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn sentences_lose_the_repeated_verdict_and_gain_minus_signs() {
        assert_eq!(
            plain("consistent: slope -0.99 (-1.01 to -0.97)", "consistent"),
            "slope −0.99 (−1.01 to −0.97)"
        );
        assert_eq!(plain("plateaus at 1e-5, two-step", "undecided"), "plateaus at 1e-5, two-step");
    }
}
