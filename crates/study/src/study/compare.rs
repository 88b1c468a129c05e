//! `[[compare]]`: numbers that the source work reports, beside which ours are set.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// One statement of the source work about the ratio of two rows' errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperComparison {
    /// What is compared, for people.
    pub what: String,
    /// Label of the row whose error is above the fraction line.
    pub row: String,
    /// Label of the row whose error is below it.
    pub over: String,
    /// Id of a metric that is an error.
    pub metric: String,
    /// Levels; all if empty.
    pub spp: Vec<u32>,
    /// Scene ids; if empty all that the source's numbers are about.
    pub scenes: Vec<String>,
    /// The source's ratio, for scenes without one of their own.
    pub paper: Option<PaperRatio>,
    /// The source's ratios of single scenes, by scene id.
    pub paper_by_scene: BTreeMap<String, PaperRatio>,
    /// Where the source says it, such as `Fig. 7`.
    pub source: String,
}

/// A ratio as the source reports it; low and high are equal for one number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperRatio {
    /// Smallest ratio, positive.
    pub low: f64,
    /// Largest ratio.
    pub high: f64,
}

impl PaperComparison {
    /// The source's ratio for a scene, if the comparison is about it.
    #[must_use]
    pub fn paper(&self, scene: &str) -> Option<PaperRatio> {
        let listed = self.scenes.is_empty() || self.scenes.iter().any(|id| id == scene);
        self.paper_by_scene.get(scene).copied().or(self.paper).filter(|_| listed)
    }
}

/// One table as it stands in a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCompare {
    what: String,
    row: String,
    over: String,
    metric: Option<String>,
    #[serde(default)]
    spp: Vec<u32>,
    #[serde(default, alias = "scenes")]
    scene: Vec<String>,
    paper: Option<RawRatio>,
    #[serde(default)]
    paper_by_scene: BTreeMap<String, RawRatio>,
    #[serde(default)]
    source: String,
}

/// `0.36` or `[0.0082, 0.36]`.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number, or a range like [0.1, 0.4]")]
enum RawRatio {
    Number(f64),
    Range([f64; 2]),
}

impl From<RawRatio> for PaperRatio {
    fn from(raw: RawRatio) -> Self {
        let [low, high] = match raw {
            RawRatio::Number(value) => [value, value],
            RawRatio::Range(ends) => ends,
        };
        Self { low, high }
    }
}

impl RawCompare {
    pub(super) fn resolve(self, primary: &str) -> PaperComparison {
        PaperComparison {
            what: self.what,
            row: self.row,
            over: self.over,
            metric: self.metric.unwrap_or_else(|| primary.to_owned()),
            spp: self.spp,
            scenes: self.scene,
            paper: self.paper.map(Into::into),
            paper_by_scene: self.paper_by_scene.into_iter().map(|(id, raw)| (id, raw.into())).collect(),
            source: self.source,
        }
    }
}
