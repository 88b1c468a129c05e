//! Claims and what the data say of them.

use noisefloor_stats::{Needed, Region, Verdict};
use serde::{Deserialize, Serialize};

use super::Interval;

/// The scale on which an effect and the region of its claim are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// A share, in percent.
    Share,
    /// A ratio, where 1 is equality.
    Ratio,
    /// A number.
    Number,
}

/// Which claim of which question it is: no two of a summary are the same.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ClaimId {
    /// Id of the question that judged it.
    pub question: String,
    /// What is claimed, among the claims of one row on one scene at one level, such as `95 %`.
    pub what: String,
    /// Scene id.
    pub scene: String,
    /// Samples per pixel, if it is about one level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spp: Option<u32>,
    /// Label of the row that it is about; that of the input for claims about it.
    pub label: String,
}

/// A claim with its evidence and verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClaimSummary {
    /// Which it is.
    #[serde(flatten)]
    pub id: ClaimId,
    /// The claim in a sentence without its subject, such as "intervals cover 95 %".
    pub sentence: String,
    /// What was measured.
    pub effect: Interval,
    /// The same without the allowance for the reference's noise, where that matters: the truth lies between the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncorrected: Option<Interval>,
    /// Scale of effect and region.
    pub scale: Scale,
    /// Where the effect must lie; none where it cannot be judged.
    pub region: Option<Region>,
    /// Part of the standard error that all replicates share, such as the reference's; of a ratio on its logarithm.
    #[serde(default, skip_serializing_if = "none_shared")]
    pub common: f64,
    /// Independent trials behind a share: pixels, whose channels are one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trials: Option<u64>,
    /// Replicates behind each value of the effect: 2 where a value is of a pair of them.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub replicates_per_value: u32,
    /// By its own interval.
    pub alone: Verdict,
    /// Beside all other claims of the report: a refutation counts only after Holm's rule.
    pub verdict: Verdict,
    /// p-value of the claim by itself.
    pub p: Option<f64>,
    /// The same after Holm's rule over the report.
    pub p_adjusted: Option<f64>,
    /// What would decide it.
    pub needed: Needed,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "what serde asks for")]
fn none_shared(common: &f64) -> bool {
    *common == 0.0
}

fn one() -> u32 {
    1
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "what serde asks for")]
fn is_one(count: &u32) -> bool {
    *count == 1
}

/// All claims of a report together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ClaimFamily {
    /// Claims that have an interval.
    pub tested: usize,
    /// Of those: refuted if each is taken alone.
    pub refuted_alone: usize,
    /// As many as that by chance, if all claims held at the edge of their regions.
    pub by_chance: f64,
}
