//! Plain text tables, columns aligned by character count.

use noisefloor_harness::summary::{Interval, PaperResult, Summary};

/// The short table that ends a run: the primary metric of every row at the top level of every scene.
pub fn summary_table(summary: &Summary) -> String {
    let metric = &summary.study.primary_metric;
    let name = summary.study.metrics.iter().find(|m| m.id == *metric).map_or(metric.as_str(), |m| &m.name);
    let mut out = String::new();
    for finding in &summary.findings {
        out.push_str(&format!("! {finding}\n"));
    }
    for warning in &summary.warnings {
        out.push_str(&format!("! {warning}\n"));
    }
    for scene in &summary.scenes {
        let levels = summary.cells.iter().filter(|c| c.scene == scene.id).map(|c| c.spp);
        let (Some(low), Some(top)) = (levels.clone().min(), levels.max()) else { continue };
        out.push_str(&format!(
            "\n{}, {}×{}, reference {} samples per pixel ({:.0} × the top level)\n",
            scene.id, scene.width, scene.height, scene.reference.spp, scene.reference.ratio_to_top
        ));
        let shown = if low == top { vec![top] } else { vec![low, top] };
        let heads = shown.iter().flat_map(|spp| [format!("{name} at {spp}"), "of mc".into()]);
        let mut rows: Vec<Vec<String>> =
            vec![std::iter::once("method".into()).chain(heads).chain(["denoise".into()]).collect()];
        for method in &summary.methods {
            let cell = |spp| {
                summary.cells.iter().find(|c| c.scene == scene.id && c.spp == spp && c.label == method.label)
            };
            if shown.iter().all(|spp| cell(*spp).is_none()) {
                rows.push(vec![method.label.clone(), "skipped".into()]);
                continue;
            }
            let value = |c: Option<&noisefloor_harness::summary::CellSummary>, ratio: bool| {
                let of =
                    c.and_then(|c| if ratio { c.ratio_to_mc.get(metric) } else { c.metrics.get(metric) });
                of.map_or_else(|| "–".into(), with_interval)
            };
            let values = shown.iter().flat_map(|spp| [value(cell(*spp), false), value(cell(*spp), true)]);
            let time = cell(top).and_then(|c| c.denoise_seconds);
            let time = time.map_or_else(|| "–".into(), |s| format!("{:.1} ms", s * 1e3));
            rows.push(std::iter::once(method.label.clone()).chain(values).chain([time]).collect());
        }
        out.push_str(&aligned(&rows));
    }
    let skipped: Vec<String> = summary
        .skipped
        .iter()
        .map(|s| format!("{} {} on {}: {}", s.status, s.label, s.scene, s.reason))
        .collect();
    if !skipped.is_empty() {
        out.push_str(&format!("\n{}\n", skipped.join("\n")));
    }
    out
}

/// Our ratios beside the source work's; empty if the study compares nothing with a source.
pub fn paper_table(summary: &Summary) -> String {
    if summary.paper.is_empty() {
        return String::new();
    }
    let heads = ["beside the source work", "scene", "spp", "ours", "paper", "in words"];
    let mut rows: Vec<Vec<String>> = vec![heads.map(String::from).into()];
    rows.extend(summary.paper.iter().map(|r| {
        let [low, high] = r.paper;
        let paper = if low == high { low.to_string() } else { format!("{low} to {high}") };
        vec![r.what.clone(), r.scene.clone(), r.spp.to_string(), ratio(r), paper, words(r)]
    }));
    aligned(&rows)
}

/// Ratios have lopsided intervals: both ends.
fn ratio(r: &PaperResult) -> String {
    match r.ours.as_ref().map(|ours| (number(ours.value), ours.low, ours.high)) {
        Some((value, Some(low), Some(high))) => format!("{value} [{}, {}]", number(low), number(high)),
        Some((value, ..)) => value,
        None => "–".into(),
    }
}

fn words(r: &PaperResult) -> String {
    r.reason.as_ref().map_or_else(|| r.verdict.clone(), |reason| format!("{}: {reason}", r.verdict))
}

fn with_interval(interval: &Interval) -> String {
    match (interval.below, interval.low, interval.high) {
        (Some(limit), ..) => format!("< {}", number(limit)),
        (None, Some(low), Some(high)) => {
            format!("{} ± {}", number(interval.value), number(0.5 * (high - low)))
        }
        _ => number(interval.value),
    }
}

/// Aligns rows: the first column to the left, the others to the right.
pub fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| {
        rows.iter().filter_map(|row| row.get(c)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for row in rows {
        let line: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(c, cell)| {
                let pad = " ".repeat(widths[c] - cell.chars().count());
                if c == 0 { format!("{cell}{pad}") } else { format!("{pad}{cell}") }
            })
            .collect();
        out.push_str(line.join("  ").trim_end());
        out.push('\n');
    }
    out
}

/// Four significant digits, in scientific notation outside 0.001 … 99999.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.3e}")
    } else {
        let digits = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let rows = [vec!["é".into(), "1".into()], vec!["long".into(), "12345".into()]];
        assert_eq!(aligned(&rows), "é         1\nlong  12345\n");
    }

    #[test]
    fn a_ratio_shows_both_ends_and_a_missing_one_its_reason() {
        let mut result = PaperResult {
            what: "a over b".into(),
            scene: "nave".into(),
            spp: 32,
            row: "a".into(),
            over: "b".into(),
            metric: "mse".into(),
            ours: Some(Interval {
                value: 0.25,
                standard_error: None,
                low: Some(0.125),
                high: Some(0.5),
                confidence: 0.95,
                n: 4,
                source: noisefloor_harness::summary::Source::Replicates,
                below: None,
            }),
            paper: [0.3, 0.3],
            source: "Fig. 7".into(),
            verdict: "agrees".into(),
            reason: None,
        };
        assert_eq!((ratio(&result).as_str(), words(&result).as_str()), ("0.2500 [0.1250, 0.5000]", "agrees"));
        result.ours = None;
        result.verdict = "no number".into();
        result.reason = Some("`b` did not run here".into());
        assert_eq!(
            (ratio(&result).as_str(), words(&result).as_str()),
            ("–", "no number: `b` did not run here")
        );
    }

    #[test]
    fn numbers_keep_four_digits() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(1.23456), "1.235");
        assert_eq!(number(1234.56), "1235");
        assert_eq!(number(0.00012345), "1.234e-4");
        assert_eq!(number(-0.5), "-0.5000");
    }
}
