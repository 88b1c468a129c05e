use crate::claims::{Claim, push};
use crate::records::Index;
use crate::records::{by_replicate, error_ratio};
use noisefloor_stats::Region;
use noisefloor_study::context::SceneContext;
use noisefloor_study::summary::{Agreement, ClaimId, Interval, PaperResult, Scale, Summary};
use noisefloor_study::{PaperComparison, PaperRatio};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.paper = paper(index);
    let all = summary.paper.clone();
    all.iter().for_each(|result| claim(result, summary));
}

/// Which claim a comparison with the source is.
pub(super) fn id(result: &PaperResult) -> ClaimId {
    ClaimId {
        question: "paper".into(),
        what: format!("{}: {} of {} over {}", result.what, result.metric, result.row, result.over),
        scene: result.scene.clone(),
        spp: Some(result.spp),
        label: result.row.clone(),
    }
}

/// That our ratio is the source's, or in its range, to within a tenth.
fn claim(result: &PaperResult, summary: &mut Summary) {
    let Some(effect) = result.ours.clone() else { return };
    let [low, high] = result.paper;
    // Rows over other frames or fewer pixels are no evidence.
    let region = result.reason.is_none().then(|| Region::source(low, high));
    let claim = Claim {
        id: id(result),
        sentence: format!("{}: as in {}, to within a tenth", result.what, result.source),
        effect,
        uncorrected: None,
        scale: Scale::Ratio,
        region,
        common: 0.0,
        trials: None,
        replicates_per_value: 1,
    };
    push(summary, claim);
}

/// Ratios beside the source work's, in the order of the study's comparisons, scenes and levels.
fn paper(index: &Index<'_>) -> Vec<PaperResult> {
    let mut out = Vec::new();
    for compare in &index.study.compare {
        for scene in index.scenes() {
            let Some(paper) = compare.paper(&scene.id) else { continue };
            let asked = |spp: &u32| compare.spp.is_empty() || compare.spp.contains(spp);
            out.extend(
                index.levels_of(scene).filter(asked).map(|spp| one(index, compare, scene, spp, paper)),
            );
        }
    }
    out
}

fn one(
    index: &Index<'_>,
    compare: &PaperComparison,
    scene: &SceneContext,
    spp: u32,
    paper: PaperRatio,
) -> PaperResult {
    let own = index.records(scene, spp, &compare.row);
    let other = index.records(scene, spp, &compare.over);
    // What is known within one image is the ratio to the noisy input on the same frame.
    let over_input = index.baseline().is_some_and(|row| row.summary.label == compare.over);
    let within = match own {
        [only] if over_input => only.ratio_within_se.get(&compare.metric).copied(),
        _ => None,
    };
    let ours = error_ratio(own, other, None, &compare.metric, within);
    let reason = || {
        let absent = [(&compare.row, own), (&compare.over, other)].into_iter().find(|(_, r)| r.is_empty());
        if let Some((label, _)) = absent {
            return format!("`{label}` did not run here");
        }
        let [a, b] = [own, other].map(|records| by_replicate(records, None, &compare.metric));
        if a.iter().zip(&b).any(|(a, b)| a.is_some() && b.is_some()) {
            "an error is not positive: it is below what the reference can show".into()
        } else {
            "no replicate has a number for both rows".into()
        }
    };
    // Other frames or fewer pixels than the other row's may turn a ratio into anything.
    let left_out = [&compare.row, &compare.over]
        .into_iter()
        .find_map(|label| Some(format!("`{label}`: {}", index.left_out(scene, spp, label)?)));
    let verdict = match &ours {
        Some(_) if left_out.is_some() => Agreement::Undecided,
        Some(ours) => verdict(ours, paper),
        None => Agreement::NoNumber,
    };
    PaperResult {
        what: compare.what.clone(),
        scene: scene.id.clone(),
        spp,
        row: compare.row.clone(),
        over: compare.over.clone(),
        metric: compare.metric.clone(),
        verdict,
        reason: if ours.is_none() { Some(reason()) } else { left_out },
        ours,
        paper: [paper.low, paper.high],
        source: compare.source.clone(),
    }
}

/// Our interval against the source's range. Without an interval nothing is said: a single number can be anywhere by
/// chance.
fn verdict(ours: &Interval, paper: PaperRatio) -> Agreement {
    let (Some(low), Some(high)) = (ours.low, ours.high) else { return Agreement::Undecided };
    if high < paper.low {
        match (paper.low > 1.0, high < 1.0) {
            (true, true) => Agreement::Opposite,
            (true, false) => Agreement::SmallerLoss,
            (false, _) => Agreement::LargerGain,
        }
    } else if low > paper.high {
        match (paper.high < 1.0, low > 1.0) {
            (true, true) => Agreement::Opposite,
            (true, false) => Agreement::SmallerGain,
            (false, _) => Agreement::LargerLoss,
        }
    } else if (low..=high).contains(&1.0) && !(paper.low..=paper.high).contains(&1.0) {
        // An effect is not confirmed by numbers that cannot tell it from none.
        Agreement::Undecided
    } else {
        Agreement::Agrees
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefloor_study::summary::Source;

    fn told(low: f64, high: f64, paper: [f64; 2]) -> Agreement {
        let ours = Interval {
            value: 0.5 * (low + high),
            standard_error: None,
            low: Some(low),
            high: Some(high),
            confidence: 0.95,
            n: 4,
            source: Source::Replicates,
            below: None,
        };
        verdict(&ours, PaperRatio { low: paper[0], high: paper[1] })
    }

    #[test]
    fn words_follow_from_where_the_interval_lies() {
        assert_eq!(told(0.3, 0.5, [0.4, 0.4]), Agreement::Agrees);
        assert_eq!(told(0.3, 0.5, [0.5, 0.9]), Agreement::Agrees);
        assert_eq!(told(0.1, 0.2, [0.3, 0.4]), Agreement::LargerGain);
        assert_eq!(told(0.5, 0.9, [0.3, 0.4]), Agreement::SmallerGain);
        assert_eq!(told(0.8, 1.2, [0.3, 0.4]), Agreement::SmallerGain, "1 is not excluded");
        assert_eq!(
            told(0.003, 1.1, [0.034, 0.034]),
            Agreement::Undecided,
            "neither the gain nor none is excluded"
        );
        assert_eq!(told(0.9, 1.1, [0.95, 1.05]), Agreement::Agrees, "none is what the source says");
        assert_eq!(told(1.1, 1.2, [0.3, 0.4]), Agreement::Opposite);
        assert_eq!(told(0.1, 0.9, [1.5, 1.5]), Agreement::Opposite);
        assert_eq!(told(0.9, 1.2, [1.5, 1.5]), Agreement::SmallerLoss);
        assert_eq!(told(1.8, 2.0, [1.5, 1.5]), Agreement::LargerLoss);
        assert_eq!(told(1.8, 2.0, [0.8, 1.2]), Agreement::LargerLoss);
        assert_eq!(told(0.2, 0.3, [0.8, 1.2]), Agreement::LargerGain);
    }

    #[test]
    fn a_number_without_an_interval_is_undecided() {
        let ours = Interval {
            value: 2.0,
            standard_error: None,
            low: None,
            high: None,
            confidence: 0.95,
            n: 1,
            source: Source::None,
            below: None,
        };
        assert_eq!(verdict(&ours, PaperRatio { low: 2.0, high: 2.0 }), Agreement::Undecided);
    }
}
