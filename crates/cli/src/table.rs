//! Plain text tables, columns aligned by character count.

use noisefloor_study::summary::{CellSummary, Interval, PaperResult, SceneSummary, Status, Summary};

/// The short table that ends a run: the primary metric of every row at the top level of every scene.
pub fn summary_table(summary: &Summary) -> String {
    let metric = &summary.study.primary_metric;
    let name = summary.study.metrics.iter().find(|m| m.id == *metric).map_or(metric.as_str(), |m| &m.name);
    let mut out = String::new();
    out.extend(unfinished(summary).map(|line| format!("! {line}\n")));
    for finding in &summary.findings {
        out.push_str(&format!("! {finding}\n"));
    }
    for warning in &summary.warnings {
        out.push_str(&format!("! {warning}\n"));
    }
    let mut marked = false;
    for scene in &summary.scenes {
        let levels = summary.cells.iter().filter(|c| c.scene == scene.id).map(|c| c.spp);
        let (Some(low), Some(top)) = (levels.clone().min(), levels.max()) else { continue };
        out.push_str(&format!("\n{}, {}×{}, {}\n", scene.id, scene.width, scene.height, reference(scene)));
        let shown = if low == top { vec![top] } else { vec![low, top] };
        let heads = shown.iter().flat_map(|spp| [format!("{name} at {spp}"), "of mc".into()]);
        let mut rows: Vec<Vec<String>> =
            vec![std::iter::once("method".into()).chain(heads).chain(["denoise".into()]).collect()];
        for method in &summary.methods {
            let cell = |spp| {
                summary.cells.iter().find(|c| c.scene == scene.id && c.spp == spp && c.label == method.label)
            };
            if shown.iter().all(|spp| cell(*spp).is_none()) {
                rows.push(vec![method.label.clone(), why_absent(summary, scene, &method.label).into()]);
                continue;
            }
            let value = |c: Option<&CellSummary>| {
                let of = c.and_then(|c| c.metrics.get(metric)).map(with_interval);
                let mark = if c.is_some_and(|c| c.left_out.is_some()) { "*" } else { "" };
                of.map_or_else(|| "–".into(), |text| format!("{text}{mark}"))
            };
            let ratio = |c: Option<&CellSummary>| {
                c.and_then(|c| c.ratio_to_mc.get(metric)).map_or_else(|| "–".into(), ratio_with_interval)
            };
            marked |= shown.iter().any(|spp| cell(*spp).is_some_and(|c| c.left_out.is_some()));
            let values = shown.iter().flat_map(|spp| [value(cell(*spp)), ratio(cell(*spp))]);
            let time = cell(top).and_then(|c| c.denoise_seconds);
            let time = time.map_or_else(|| "–".into(), |s| format!("{:.1} ms", s * 1e3));
            rows.push(std::iter::once(method.label.clone()).chain(values).chain([time]).collect());
        }
        out.push_str(&aligned(&rows));
    }
    if marked {
        out.push_str(
            "\n* not ranked, for the reason given above: over other frames or fewer pixels than the others\n",
        );
    }
    let skipped: Vec<String> = summary
        .skipped
        .iter()
        // Failures are told above.
        .filter(|s| s.status != Status::Failed)
        .map(|s| format!("{} {} on {}: {}", s.status, s.label, s.scene, s.reason))
        .collect();
    if !skipped.is_empty() {
        out.push_str(&format!("\n{}\n", skipped.join("\n")));
    }
    out
}

/// `unfinished: 12 of 18 cells are finished; missing: …`, if so.
pub fn unfinished(summary: &Summary) -> Option<String> {
    let progress = summary.progress.as_ref().filter(|progress| !progress.complete())?;
    Some(format!("unfinished: {progress}"))
}

/// `9 rows failed; the first: …`, if any did.
pub fn failed(summary: &Summary) -> Option<String> {
    let mut failed = summary.skipped.iter().filter(|entry| entry.status == Status::Failed);
    let first = failed.next()?;
    let rows = match failed.count() {
        0 => "a row".to_owned(),
        more => format!("{} rows", more + 1),
    };
    Some(format!("{rows} failed; the first: {} on {}: {}", first.label, first.scene, first.reason))
}

/// The reference in words, and how long it is beside the frames.
fn reference(scene: &SceneSummary) -> String {
    let reference = &scene.reference;
    let name = reference.name();
    match reference.spp {
        0 => name,
        _ if reference.is_exact() => name,
        _ => format!("{name} ({:.0} × the top level)", reference.ratio_to_top),
    }
}

/// Why a row has no numbers at the levels shown.
fn why_absent(summary: &Summary, scene: &SceneSummary, label: &str) -> &'static str {
    let ended = summary.skipped.iter().find(|s| s.scene == scene.id && s.label == label);
    match ended.map(|s| s.status) {
        Some(status) => status.name(),
        None => "did not run",
    }
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

fn ratio(r: &PaperResult) -> String {
    r.ours.as_ref().map_or_else(|| "–".into(), ratio_with_interval)
}

/// Ratios have lopsided intervals, which are those of their logarithms: both ends. Certain ones stand alone.
fn ratio_with_interval(interval: &Interval) -> String {
    match (interval.low, interval.high) {
        (Some(low), Some(high)) if low < high => {
            format!("{} [{}, {}]", number(interval.value), number(low), number(high))
        }
        _ => number(interval.value),
    }
}

fn words(r: &PaperResult) -> String {
    r.reason.as_ref().map_or_else(|| r.verdict.to_string(), |reason| format!("{}: {reason}", r.verdict))
}

fn with_interval(interval: &Interval) -> String {
    match (interval.below, interval.low, interval.high) {
        (Some(limit), ..) => format!("< {}", number(limit)),
        // Cut at zero, or of a logarithm: ± would promise an end that is not there.
        (None, Some(low), Some(high)) if lopsided(interval.value, low, high) => {
            format!("{} [{}, {}]", number(interval.value), number(low), number(high))
        }
        (None, Some(low), Some(high)) => {
            format!("{} ± {}", number(interval.value), number(0.5 * (high - low)))
        }
        _ => number(interval.value),
    }
}

fn lopsided(value: f64, low: f64, high: f64) -> bool {
    ((high - value) - (value - low)).abs() > 0.02 * (high - low)
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
    use noisefloor_study::summary::Agreement;

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
                source: noisefloor_study::summary::Source::Replicates,
                below: None,
            }),
            paper: [0.3, 0.3],
            source: "Fig. 7".into(),
            verdict: Agreement::Agrees,
            reason: None,
        };
        assert_eq!((ratio(&result).as_str(), words(&result).as_str()), ("0.2500 [0.1250, 0.5000]", "agrees"));
        result.ours = None;
        result.verdict = Agreement::NoNumber;
        result.reason = Some("`b` did not run here".into());
        assert_eq!(
            (ratio(&result).as_str(), words(&result).as_str()),
            ("–", "no number: `b` did not run here")
        );
    }

    #[test]
    fn lopsided_intervals_show_both_ends_and_others_their_half_width() {
        let interval = |value: f64, low: f64, high: f64| Interval {
            value,
            standard_error: None,
            low: Some(low),
            high: Some(high),
            confidence: 0.95,
            n: 4,
            source: noisefloor_study::summary::Source::Replicates,
            below: None,
        };
        assert_eq!(ratio_with_interval(&interval(0.38, 0.1, 1.4)), "0.3800 [0.1000, 1.400]");
        assert_eq!(ratio_with_interval(&interval(1.0, 1.0, 1.0)), "1.000", "certain");
        assert_eq!(with_interval(&interval(0.5, 0.4, 0.6)), "0.5000 ± 0.1000");
        // Cut at zero: 0.38 ± 0.63 would promise a negative error.
        assert_eq!(with_interval(&interval(0.38, 0.0, 1.01)), "0.3800 [0, 1.010]");
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
