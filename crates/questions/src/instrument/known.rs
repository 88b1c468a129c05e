//! Scenes whose answers are known: the study that an instrument is checked with, and what it must find there.

use noisefloor_frame::Reference;
use noisefloor_stats::instrument::{bernoulli_coverage, missed_by_all};
use noisefloor_stats::{Level, MOST_TRIALS, binomial_two_sided_p, rate_standard_error, t_quantile};
use noisefloor_study::check::{CheckFound, CheckKind, CheckRecord};
use noisefloor_study::record::{CoverageCount, Record};
use noisefloor_study::summary::{EstimateSummary, Interval, Summary};
use noisefloor_study::{
    BASELINE, MethodRow, Replicates, RowFrames, SceneSource, SceneSpec, Shot, Study, Timing,
};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticError, SyntheticScene};
use serde_json::Map;

use super::analyse::checks;
use crate::cell::ALL;
use crate::own_error;
use crate::records::LEVEL;

/// Name of the study; who runs it does not check it once more.
pub const SELF_CHECK: &str = "instrument-check";
/// Columns and rows of its scenes.
pub const SELF_CHECK_SIZE: (usize, usize) = (48, 36);
const NORMAL: &str = "normal";
const RARE: &str = "rare";
const FURNACE: &str = "furnace";
/// Probability of the rare event.
const Q: f64 = 0.02;
/// Most samples per pixel: the faults that more of them hide show with few.
const MOST_SPP: u32 = 64;
const REPLICATES: u32 = 4;
/// Confidences of the intervals that are checked at least.
const CONFIDENCES: [f64; 3] = [0.95, 0.99, 0.998];
/// Samples of the furnace's reference: its image is known without, and the noise of a reference counts in every check.
const REFERENCE_SPP: u32 = 16 * Reference::LEAST_PARTS as u32;

/// The study that checks the instrument which measures `of`: its levels, as far as they are small, on normal samples, rare
/// events and a furnace. `unbiased` are methods that promise an unbiased estimate of their error.
///
/// # Errors
/// None but for a mistake in this file.
pub fn self_check_study(of: &Study, unbiased: &[String]) -> Result<Study, SyntheticError> {
    let all = of.scenes.iter().flat_map(|scene| of.levels(scene)).chain(&of.spp).copied();
    let mut spp: Vec<u32> = all.filter(|spp| (2..=MOST_SPP).contains(spp)).collect();
    spp.sort_unstable();
    spp.dedup();
    if spp.is_empty() {
        spp.push(16);
    }
    let (width, height) = SELF_CHECK_SIZE;
    let image = MeanImage::of(ImageKind::Mixed);
    let normal = SyntheticScene::new(image, SampleLaw::Gaussian { sd: 0.3, relative: false }, width, height)?;
    let rare = SyntheticScene::new(image, SampleLaw::Bernoulli { q: Q, bright: 1.0 }, width, height)?;
    let scene = |id: &str, source| SceneSpec {
        id: id.into(),
        source,
        spp: None,
        replicates: None,
        shot: Shot::default(),
        set: Map::new(),
        equal_time_spp: None,
        sequence: None,
    };
    let scenes = vec![
        scene(NORMAL, SceneSource::Synthetic(normal)),
        scene(RARE, SceneSource::Synthetic(rare)),
        scene(FURNACE, SceneSource::Builtin(FURNACE.into())),
    ];
    let known = |id: &String| MethodRow { frames: RowFrames::KnownVariance, ..MethodRow::new(id) };
    let rows = std::iter::once(MethodRow::new(BASELINE)).chain(unbiased.iter().map(known)).collect();
    let mut study = Study::plain(SELF_CHECK.into(), spp, scenes, rows);
    study.title = "Checks of the instrument".into();
    study.question = "Do intervals, variances and estimates show what is known?".into();
    study.replicates = Replicates::uniform(REPLICATES);
    // Of the furnace alone, whose truth is its formula.
    study.reference.spp = REFERENCE_SPP;
    (study.width, study.height) = SELF_CHECK_SIZE;
    study.seed = of.seed;
    // Whatever the study asks, intervals are checked where faults show: see the table of faults in the methodology.
    study.coverage = CONFIDENCES.into_iter().chain(of.coverage.iter().copied()).collect();
    study.coverage.sort_unstable_by(f64::total_cmp);
    study.coverage.dedup();
    study.timing = Timing { warmup: 0, runs: 1 };
    study.viewer_spp = Vec::new();
    Ok(study)
}

/// What the records and the analysis of [`self_check_study`] say of the instrument.
#[must_use]
pub fn self_checks(records: &[Record], summary: &Summary) -> Vec<CheckRecord> {
    let mut out = Vec::new();
    let of_input = |record: &&Record| record.method == BASELINE;
    let mut levels: Vec<u32> = records.iter().map(|record| record.spp).collect();
    levels.sort_unstable();
    levels.dedup();
    for spp in levels {
        let here = |scene: &str| -> Vec<&CoverageCount> {
            let of_scene = records.iter().filter(of_input).filter(|r| r.scene == scene && r.spp == spp);
            of_scene.flat_map(|record| &record.coverage).filter(|count| count.class == ALL).collect()
        };
        out.extend(normal(spp, &here(NORMAL)));
        out.extend(rare(spp, &here(RARE)));
    }
    out.extend(summary.estimates.iter().filter_map(known_variance));
    // Those that every scene gets, of these scenes.
    out.extend(checks(summary).into_iter().map(|check| check.record));
    for check in &mut out {
        check.scene = format!("{} (instrument)", check.scene);
    }
    out
}

/// Counts at one confidence over all replicates.
fn by_confidence(counts: &[&CoverageCount]) -> Vec<(f64, Vec<CoverageCount>)> {
    let mut out: Vec<(f64, Vec<CoverageCount>)> = Vec::new();
    for count in counts {
        match out.iter_mut().find(|(confidence, _)| *confidence == count.confidence) {
            Some((_, group)) => group.push((*count).clone()),
            None => out.push((count.confidence, vec![(*count).clone()])),
        }
    }
    out
}

/// I1: channels and pixels are independent, so that counts are binomial.
fn normal(spp: u32, counts: &[&CoverageCount]) -> Vec<CheckRecord> {
    let check = |(confidence, group): (f64, Vec<CoverageCount>)| {
        let (hits, trials) = sum(&group, |c| c.covered);
        binomial(CheckKind::Normal, NORMAL, spp, &intervals(confidence), (hits, trials, confidence))
    };
    by_confidence(counts).into_iter().filter_map(check).collect()
}

/// I2: the share that all samples missed, once, and coverage at every confidence.
fn rare(spp: u32, counts: &[&CoverageCount]) -> Vec<CheckRecord> {
    let mut out = Vec::new();
    for (k, (confidence, group)) in by_confidence(counts).into_iter().enumerate() {
        if k == 0 {
            let (hits, trials) = sum(&group, |c| c.missed);
            // All samples that met the event have no spread either, and are as wrong.
            let expected = missed_by_all(Q, spp) + missed_by_all(1.0 - Q, spp);
            out.extend(binomial(CheckKind::Rare, RARE, spp, "missed events", (hits, trials, expected)));
        }
        let expected = Level::two_sided(confidence).ok().and_then(|level| bernoulli_coverage(Q, spp, level));
        if let Some(expected) = expected {
            let (hits, trials) = sum(&group, |c| c.covered + c.constant);
            let of = (hits, trials, expected.covered);
            out.extend(binomial(CheckKind::Rare, RARE, spp, &intervals(confidence), of));
        }
    }
    out
}

fn intervals(confidence: f64) -> String {
    format!("coverage of {} intervals", noisefloor_study::format::percent_short(confidence))
}

fn sum(counts: &[CoverageCount], hits: impl Fn(&CoverageCount) -> u64) -> (u64, u64) {
    let all = |c: &CoverageCount| c.total + c.constant + c.missed;
    (counts.iter().map(hits).sum(), counts.iter().map(all).sum())
}

fn binomial(
    kind: CheckKind,
    scene: &str,
    spp: u32,
    what: &str,
    (hits, trials, expected): (u64, u64, f64),
) -> Option<CheckRecord> {
    let p = binomial_two_sided_p(hits, trials.min(MOST_TRIALS), expected).ok()?;
    let value = hits as f64 / trials.max(1) as f64;
    let standard_error = rate_standard_error(expected, trials).max(f64::MIN_POSITIVE);
    let z = ((value - expected) / standard_error).clamp(-f64::MAX, f64::MAX);
    Some(CheckRecord {
        kind,
        what: what.into(),
        scene: scene.into(),
        spp: Some(spp),
        found: Some(CheckFound { value, expected, z, p }),
        note: String::new(),
    })
}

/// I7: estimated over measured squared error, on normal samples. It cannot tell where the measured error may be nothing.
fn known_variance(estimate: &EstimateSummary) -> Option<CheckRecord> {
    if estimate.scene != NORMAL || estimate.class != ALL {
        return None;
    }
    let (mean, measured) = (estimate.estimated.value, estimate.measured.value);
    let found = own_error::claim(estimate).judged().p.filter(|_| measured > 0.0).map(|p| CheckFound {
        value: if estimate.is_ratio { estimate.effect.value } else { mean / measured },
        expected: 1.0,
        z: standard_errors(&estimate.effect, estimate.is_ratio),
        p,
    });
    let note = if found.is_none() { "the measured error may be nothing" } else { "" };
    Some(CheckRecord {
        kind: CheckKind::KnownVariance,
        what: format!("estimated over measured error of {}", estimate.label),
        scene: estimate.scene.clone(),
        spp: Some(estimate.spp),
        found,
        note: note.into(),
    })
}

/// Of a ratio from 1, on the logarithm, or of a difference from 0; 0 without an interval.
fn standard_errors(effect: &Interval, ratio: bool) -> f64 {
    let scale = |v: f64| if ratio { v.ln() } else { v };
    let Some((low, high)) = effect.low.zip(effect.high).filter(|_| effect.n > 1) else { return 0.0 };
    // The interval is symmetric on that scale, and its critical value is above 0.
    let critical = t_quantile(LEVEL, u64::from(effect.n) - 1);
    let standard_error = 0.5 * (scale(high) - scale(low)) / critical;
    let off = scale(effect.value);
    if off == 0.0 { 0.0 } else { (off / standard_error).clamp(-f64::MAX, f64::MAX) }
}

#[cfg(test)]
mod tests;
