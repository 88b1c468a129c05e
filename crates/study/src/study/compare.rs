//! `[[compare]]`: numbers that the source work reports, beside which ours are set.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::error::StudyError;
use crate::study::check::Lines;
use crate::study::{SceneSource, SceneSpec, Study};

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

/// Refuses comparisons that name what the study does not have, or ratios that are none.
pub(super) fn check_comparisons(study: &Study, lines: &Lines<'_>) -> Result<(), StudyError> {
    study.compare.iter().enumerate().try_for_each(|(index, compare)| {
        check_one(study, compare).map_err(|(field, value, allowed)| StudyError::Field {
            place: lines.place(lines.compare.get(index).copied()),
            field: format!("compare[{index}].{field}"),
            value,
            allowed,
        })
    })
}

/// Field, value and what is allowed instead.
type Wrong = (String, String, String);

fn check_one(study: &Study, compare: &PaperComparison) -> Result<(), Wrong> {
    let wrong = |field: &str, value: String, allowed: String| Err((field.to_owned(), value, allowed));
    let quoted = |text: &str| format!("`{text}`");
    if compare.what.trim().is_empty() {
        return wrong("what", quoted(&compare.what), "some text".into());
    }
    let labels = || study.methods.iter().map(|row| row.label.as_str());
    for (field, label) in [("row", &compare.row), ("over", &compare.over)] {
        if !labels().any(|known| known == label) {
            let allowed = format!("the label of a row: {}", labels().collect::<Vec<_>>().join(", "));
            return wrong(field, quoted(label), allowed);
        }
    }
    if compare.row == compare.over {
        return wrong("over", quoted(&compare.over), "another row than `row`".into());
    }
    if !study.metrics.contains(&compare.metric) || !crate::metric::lower_is_better(&compare.metric) {
        let errors = study.metrics.iter().filter(|id| crate::metric::lower_is_better(id));
        let allowed = format!("an error: {}", errors.cloned().collect::<Vec<_>>().join(", "));
        return wrong("metric", quoted(&compare.metric), allowed);
    }
    let ids = || study.scenes.iter().map(|scene| scene.id.as_str());
    let of_study = || format!("ids of scenes: {}", ids().collect::<Vec<_>>().join(", "));
    if let Some(bad) = compare.scenes.iter().find(|id| !ids().any(|known| known == **id)) {
        return wrong("scene", quoted(bad), of_study());
    }
    if let Some(bad) = compare.paper_by_scene.keys().find(|id| !ids().any(|known| known == **id)) {
        return wrong("paper_by_scene", quoted(bad), of_study());
    }
    let listed = &compare.scenes;
    if let Some(bad) = compare.paper_by_scene.keys().find(|id| !listed.is_empty() && !listed.contains(id)) {
        return wrong(
            "paper_by_scene",
            quoted(bad),
            format!("scenes that `scene` lists: {}", listed.join(", ")),
        );
    }
    let single = compare.paper_by_scene.values().map(|ratio| ("paper_by_scene", ratio));
    for (field, PaperRatio { low, high }) in compare.paper.iter().map(|r| ("paper", r)).chain(single) {
        if !(*low > 0.0 && low <= high && high.is_finite()) {
            let value = if low == high { low.to_string() } else { format!("[{low}, {high}]") };
            return wrong(field, value, "a positive ratio of errors, or a range [low, high] of them".into());
        }
    }
    if compare.paper.is_none()
        && let Some(bare) = listed.iter().find(|id| !compare.paper_by_scene.contains_key(*id))
    {
        let allowed = format!("`paper`, or a number for `{bare}` in `paper_by_scene`");
        return wrong("paper", "absent".into(), allowed);
    }
    if compare.paper.is_none() && compare.paper_by_scene.is_empty() {
        return wrong("paper", "absent".into(), "the source's ratio, or `paper_by_scene`".into());
    }
    let concerned = || study.scenes.iter().filter(|scene| compare.paper(&scene.id).is_some());
    // Folders know their own levels.
    let open = |scene: &SceneSpec| scene.spp.is_none() && matches!(scene.source, SceneSource::Folder(_));
    if let Some(bad) = compare
        .spp
        .iter()
        .find(|spp| concerned().all(|scene| !open(scene) && !study.levels(scene).contains(spp)))
    {
        return wrong("spp", bad.to_string(), "levels of the scenes that are compared".into());
    }
    Ok(())
}
