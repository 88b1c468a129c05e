use crate::analysis::index::Index;
use crate::analysis::series::{by_replicate, error_ratio};
use crate::context::SceneContext;
use crate::study::{PaperComparison, PaperRatio};
use crate::summary::{Interval, PaperResult};

/// Ratios beside the source work's, in the order of the study's comparisons, scenes and levels.
pub(super) fn paper(index: &Index<'_>) -> Vec<PaperResult> {
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
        Some(_) if left_out.is_some() => "undecided",
        Some(ours) => verdict(ours, paper),
        None => "no number",
    };
    PaperResult {
        what: compare.what.clone(),
        scene: scene.id.clone(),
        spp,
        row: compare.row.clone(),
        over: compare.over.clone(),
        metric: compare.metric.clone(),
        verdict: verdict.into(),
        reason: if ours.is_none() { Some(reason()) } else { left_out },
        ours,
        paper: [paper.low, paper.high],
        source: compare.source.clone(),
    }
}

/// Our interval against the source's range. Without an interval nothing is said: a single number can be anywhere by
/// chance.
fn verdict(ours: &Interval, paper: PaperRatio) -> &'static str {
    let (Some(low), Some(high)) = (ours.low, ours.high) else { return "undecided" };
    if high < paper.low {
        match (paper.low > 1.0, high < 1.0) {
            (true, true) => "opposite sign",
            (true, false) => "smaller loss than the paper's",
            (false, _) => "larger gain than the paper's",
        }
    } else if low > paper.high {
        match (paper.high < 1.0, low > 1.0) {
            (true, true) => "opposite sign",
            (true, false) => "smaller gain than the paper's",
            (false, _) => "larger loss than the paper's",
        }
    } else if (low..=high).contains(&1.0) && !(paper.low..=paper.high).contains(&1.0) {
        // An effect is not confirmed by numbers that cannot tell it from none.
        "undecided"
    } else {
        "agrees"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::Source;

    fn told(low: f64, high: f64, paper: [f64; 2]) -> &'static str {
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
        assert_eq!(told(0.3, 0.5, [0.4, 0.4]), "agrees");
        assert_eq!(told(0.3, 0.5, [0.5, 0.9]), "agrees");
        assert_eq!(told(0.1, 0.2, [0.3, 0.4]), "larger gain than the paper's");
        assert_eq!(told(0.5, 0.9, [0.3, 0.4]), "smaller gain than the paper's");
        assert_eq!(told(0.8, 1.2, [0.3, 0.4]), "smaller gain than the paper's", "1 is not excluded");
        assert_eq!(told(0.003, 1.1, [0.034, 0.034]), "undecided", "neither the gain nor none is excluded");
        assert_eq!(told(0.9, 1.1, [0.95, 1.05]), "agrees", "none is what the source says");
        assert_eq!(told(1.1, 1.2, [0.3, 0.4]), "opposite sign");
        assert_eq!(told(0.1, 0.9, [1.5, 1.5]), "opposite sign");
        assert_eq!(told(0.9, 1.2, [1.5, 1.5]), "smaller loss than the paper's");
        assert_eq!(told(1.8, 2.0, [1.5, 1.5]), "larger loss than the paper's");
        assert_eq!(told(1.8, 2.0, [0.8, 1.2]), "larger loss than the paper's");
        assert_eq!(told(0.2, 0.3, [0.8, 1.2]), "larger gain than the paper's");
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
        assert_eq!(verdict(&ours, PaperRatio { low: 2.0, high: 2.0 }), "undecided");
    }
}
