use noisefloor_stats::{Region, family, replicate_interval};
use noisefloor_study::context::SceneContext;
use noisefloor_study::format;
use noisefloor_study::record::{CoverageCount, Record};
use noisefloor_study::summary::{ClaimId, Interval, Scale, Source, Summary};
use serde::{Deserialize, Serialize};

use super::measure::{ID, OfFamily};
use crate::answers;
use crate::cell::ALL;
use crate::claims::{Claim, push};
use crate::coverage::{Part, bracketed};
use crate::records::{Index, LEVEL, told};

/// A family at one confidence, over the replicates of a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Finding {
    pub(super) scene: String,
    pub(super) spp: u32,
    pub(super) family: String,
    pub(super) confidence: f64,
    /// Pixel class or `all`.
    pub(super) class: String,
    /// Share covered of pixel-channels with s > 0 or missed events.
    pub(super) covered: Interval,
    /// Share with the truth above, of those with s > 0.
    pub(super) above: f64,
    /// Share with the truth below.
    pub(super) below: f64,
    /// Missed events of all pixel-channels.
    pub(super) missed: f64,
    /// Its widths over those of Student's t; none for one-sided limits.
    pub(super) width: Option<Interval>,
}

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    let Some(baseline) = index.baseline() else { return };
    let label = &baseline.summary.label;
    let mut out = Vec::new();
    for scene in index.scenes() {
        for spp in index.levels_of(scene) {
            of_level(scene, spp, label, index.records(scene, spp, label), (&mut out, summary));
        }
    }
    if !out.is_empty() {
        answers::keep(&mut summary.answers, ID, &out);
    }
}

fn of_level(
    scene: &SceneContext,
    spp: u32,
    label: &str,
    records: &[&Record],
    (out, summary): (&mut Vec<Finding>, &mut Summary),
) {
    let read = |record: &&Record| answers::read::<Vec<OfFamily>>(&record.answers, ID);
    let all: Vec<OfFamily> = records.iter().filter_map(read).flatten().collect();
    let mut kinds: Vec<(&str, f64, &str)> = Vec::new();
    for (of, count) in all.iter().flat_map(|of| of.counts.iter().map(move |count| (of, count))) {
        let kind = (of.family.as_str(), count.confidence, count.class.as_str());
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    for (id, confidence, class) in kinds {
        let own = || all.iter().filter(|of| of.family == id);
        let same = |count: &&CoverageCount| count.confidence == confidence && count.class == class;
        let counts: Vec<&CoverageCount> = own().flat_map(|of| &of.counts).filter(same).collect();
        let Some(([covered, raw], trials)) = Part::Lit.share(&counts) else { continue };
        let widths: Vec<f64> = own()
            .flat_map(|of| &of.widths)
            .filter(|(of, _)| *of == confidence)
            .filter_map(|(_, width)| *width)
            .collect();
        let sum = |part: fn(&CoverageCount) -> u64| counts.iter().map(|c| part(c)).sum::<u64>() as f64;
        // At least one, or there were no share.
        let (varying, every) = (sum(|c| c.total), sum(|c| c.total + c.constant + c.missed).max(1.0));
        if class == ALL {
            let which = (id, confidence);
            claim(scene, spp, label, which, (covered.clone(), raw, trials), summary);
        }
        out.push(Finding {
            scene: scene.id.clone(),
            spp,
            family: id.to_owned(),
            confidence,
            class: class.to_owned(),
            covered,
            above: sum(|c| c.truth_above) / varying.max(1.0),
            below: sum(|c| c.truth_below) / varying.max(1.0),
            missed: sum(|c| c.missed) / every,
            width: replicate_interval(&widths, 0.0, LEVEL).map(|i| told(i, Source::Replicates, None)),
        });
    }
}

/// Which claim it is.
pub(super) fn id_of(scene: &str, spp: u32, label: &str, family: &str, confidence: f64) -> ClaimId {
    ClaimId {
        question: ID.into(),
        what: format!("{family} at {}", format::percent_short(confidence)),
        scene: scene.to_owned(),
        spp: Some(spp),
        label: label.to_owned(),
    }
}

fn claim(
    scene: &SceneContext,
    spp: u32,
    label: &str,
    (id, confidence): (&str, f64),
    (effect, raw, trials): (Interval, Interval, u64),
    summary: &mut Summary,
) {
    let Some(family) = family(id) else { return };
    let shown = format::percent_short(confidence);
    let (region, often) = match family.at_least() {
        true => (Region::guarantee(confidence), "at least as often as they say"),
        false => (Region::coverage(confidence), "as often as they say"),
    };
    let claim = Claim {
        id: id_of(&scene.id, spp, label, id, confidence),
        sentence: format!(
            "{} of {shown} cover {often} among pixels with s > 0 or missed events",
            family.name()
        ),
        effect,
        uncorrected: bracketed(scene, spp).then_some(raw),
        scale: Scale::Share,
        region: Some(region),
        common: 0.0,
        trials: Some(trials),
        replicates_per_value: 1,
    };
    push(summary, claim);
}
