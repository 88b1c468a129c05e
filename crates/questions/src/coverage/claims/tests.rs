use noisefloor_stats::{IntervalFamily, Judged, Verdict, family, rate_standard_error, students_t};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

use super::*;
use crate::cell::{Measure, PixelClasses};

const LEVELS: [u32; 4] = [4, 8, 16, 32];
const CONFIDENCES: [f64; 3] = [0.95, 0.99, 0.998];
const REPLICATES: u64 = 4;

/// The verdict on a cell of normal samples, whose coverage is known, by `region`.
fn judged(
    spp: u32,
    (confidence, region): (f64, Region),
    seed: u64,
    intervals: &dyn IntervalFamily,
) -> Judged {
    let law = SampleLaw::Gaussian { sd: 0.3, relative: false };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 24, 18).unwrap();
    let (truth, classes) = (scene.truth(), PixelClasses::from(scene.classes()));
    let count = |replicate: u64| -> CoverageCount {
        let frame = scene.render(spp, REPLICATES * seed + replicate);
        let measure = Measure::new(&frame, &truth, &classes, &[], false).with_intervals(intervals);
        let counts = measure.coverage(&[confidence]).unwrap();
        counts.into_iter().find(|count| count.class == ALL).unwrap()
    };
    let counts: Vec<CoverageCount> = (0..REPLICATES).map(count).collect();
    let counts: Vec<&CoverageCount> = counts.iter().collect();
    let ([effect, _], trials) = Part::Varying.share(&counts).unwrap();
    let claim = Claim {
        id: ClaimId {
            question: String::new(),
            what: String::new(),
            scene: String::new(),
            spp: None,
            label: String::new(),
        },
        sentence: String::new(),
        effect,
        uncorrected: None,
        scale: Scale::Share,
        region: Some(region),
        common: 0.0,
        trials: Some(trials),
        replicates_per_value: 1,
    };
    claim.judged()
}

/// How many cells are refuted, and of how many, if coverage should lie in `region` of the confidence.
fn refuted(
    seeds: u64,
    levels: &[u32],
    intervals: &dyn IntervalFamily,
    region: fn(f64) -> Region,
) -> (u64, u64) {
    let (mut refuted, mut cells) = (0, 0);
    for _ in 0..seeds {
        for &spp in levels {
            for confidence in CONFIDENCES {
                // No two cells share a frame.
                let found = judged(spp, (confidence, region(confidence)), cells, intervals);
                refuted += u64::from(found.alone == Verdict::Refuted);
                cells += 1;
            }
        }
    }
    (refuted, cells)
}

#[test]
fn cells_of_known_coverage_are_refuted_no_more_often_than_the_rule_says() {
    let (wrong, cells) = refuted(20, &LEVELS, students_t(), Region::coverage);
    assert_eq!(cells, 240);
    let share = |wrong: u64| wrong as f64 / cells as f64;
    let limit = 0.05 + 4.0 * rate_standard_error(0.05, cells);
    assert!(share(wrong) <= limit, "{wrong}");
    // The intervals behind the verdicts leave out the truth itself in 5 %.
    let (without, _) =
        refuted(20, &LEVELS, students_t(), |confidence| Region { low: confidence, high: confidence });
    assert!(share(without) <= limit && without > wrong, "{without}");
}

#[test]
fn cells_whose_intervals_are_too_narrow_are_refuted() {
    let (right, cells) = refuted(5, &[4], family("normal").unwrap(), Region::coverage);
    assert_eq!((right, cells), (15, 15));
}

/// A scene whose reference has so many samples; 0 for exact truth.
fn scene(reference_spp: u64) -> SceneContext {
    let reference = serde_json::json!({
        "key": "", "spp": reference_spp, "parts": 8, "sampling": "independent", "exact": reference_spp == 0,
        "correction": "", "floor": {},
    });
    let context = serde_json::json!({
        "id": "s", "title": "", "about": "", "width": 8, "height": 8, "sampling": "independent", "settings": {},
        "replicates": {}, "classes": [], "reference": reference,
    });
    serde_json::from_value(context).unwrap()
}

/// What is claimed of two replicates that cover `covered` of 1000 with the allowance and 900 without, beside `missed` events.
fn claimed(reference_spp: u64, spp: u32, covered: u64, missed: u64) -> Summary {
    let count = |k: u64| CoverageCount {
        confidence: 0.95,
        class: ALL.into(),
        total: 1000,
        covered: covered + k,
        covered_uncorrected: 900 + k,
        truth_above: 0,
        truth_below: 0,
        constant: 5000,
        missed,
        within_se: None,
    };
    let counts = [count(0), count(1)];
    let share = Interval {
        value: 0.95,
        standard_error: None,
        low: None,
        high: None,
        confidence: 0.95,
        n: 2,
        source: noisefloor_study::summary::Source::None,
        below: None,
    };
    let row = CoverageSummary {
        scene: "s".into(),
        spp,
        confidence: 0.95,
        class: ALL.into(),
        covered: share.clone(),
        covered_uncorrected: share,
        varying: None,
        lit: None,
        sides: None,
        constant: 0.0,
        missed: missed as f64 / 1e4,
        mark: None,
    };
    let mut summary = Summary::default();
    claims(&mut summary, &scene(reference_spp), "mc", (&row, &counts.iter().collect::<Vec<_>>()));
    summary
}

#[test]
fn the_allowance_is_a_bracket_where_a_short_reference_meets_few_samples_and_only_there() {
    let effect = |reference_spp, spp| claimed(reference_spp, spp, 950, 0).claims[0].uncorrected.clone();
    let raw = effect(63 * 16, 16).unwrap();
    assert!((raw.value - 0.9005).abs() < 1e-12, "{raw:?}");
    assert_eq!(claimed(63 * 16, 16, 950, 0).claims[0].alone, Verdict::NotShown, "all between is possible");
    assert_eq!(effect(64 * 16, 16), None, "long enough");
    assert_eq!(effect(2048, 64), None, "many samples");
    assert_eq!(effect(0, 4), None, "exact");
}

#[test]
fn constant_pixels_are_in_no_claim_and_missed_events_are_misses_in_one_of_their_own() {
    let summary = claimed(0, 4, 950, 1000);
    let values: Vec<f64> = summary.claims.iter().map(|claim| claim.effect.value).collect();
    assert_eq!(values.len(), 2);
    assert!((values[0] - 0.9505).abs() < 1e-12 && (values[1] - 0.475_25).abs() < 1e-12, "{values:?}");
    assert_eq!(claimed(0, 4, 950, 0).claims.len(), 1, "nothing was missed: one and the same claim");
}
