//! Our ratios beside those of the source work.

use noisefloor_harness::summary::PaperResult;
use serde::Serialize;

use super::table::Texts;
use crate::format;
use crate::index::Index;

/// One comparison on one scene at one level.
#[derive(Debug, Serialize)]
pub(crate) struct PaperRow {
    pub what: String,
    /// Which rows and metric the ratio is of.
    pub details: String,
    pub scene: String,
    pub spp: u32,
    pub ours: Texts,
    pub paper: String,
    pub source: String,
    pub verdict: String,
    /// Class of the verdict's tag.
    pub tone: &'static str,
    /// Why there is no number; empty if there is one.
    pub reason: String,
}

/// The table's rows in the order of the summary; empty if the study compares nothing with a source.
pub(crate) fn paper(index: &Index<'_>) -> Vec<PaperRow> {
    index.summary.paper.iter().map(|result| row(index, result)).collect()
}

fn row(index: &Index<'_>, r: &PaperResult) -> PaperRow {
    let metric = index.metric_name(&r.metric);
    let ours = r.ours.as_ref().map(format::interval);
    PaperRow {
        what: r.what.clone(),
        details: format!("{metric} of {} over {metric} of {}", r.row, r.over),
        scene: index.scene_title(&r.scene),
        spp: r.spp,
        ours: ours.map_or_else(|| Texts { value: "–".into(), spread: String::new() }, Into::into),
        paper: range(r.paper),
        source: r.source.clone(),
        verdict: r.verdict.clone(),
        tone: match r.verdict.as_str() {
            "agrees" => "consistent",
            "opposite sign" => "plateaus",
            _ => "undecided",
        },
        reason: r.reason.clone().unwrap_or_default(),
    }
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
