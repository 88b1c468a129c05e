use noisefloor_stats::replicate_interval;
use noisefloor_study::summary::Source;

use super::*;

fn count(confidence: f64, [covered, varying, constant, missed]: [u64; 4]) -> CoverageCount {
    CoverageCount {
        confidence,
        class: ALL.into(),
        total: varying,
        covered,
        covered_uncorrected: covered,
        truth_above: 0,
        truth_below: 0,
        constant,
        missed,
        within_se: None,
    }
}

fn found(record: &CheckRecord) -> CheckFound {
    record.found.unwrap()
}

#[test]
fn coverage_of_normal_samples_is_judged_over_all_replicates_as_independent_trials() {
    let counts = [count(0.9, [1, 2, 0, 0]), count(0.5, [1, 2, 0, 0]), count(0.9, [0, 1, 0, 0])];
    let checks = normal(4, &counts.iter().collect::<Vec<_>>());
    assert_eq!(checks.len(), 2, "one per confidence");
    // One of three at 0.9: twice P(X ≤ 1) = 0.1³ + 3·0.9·0.1².
    let (first, second) = (found(&checks[0]), found(&checks[1]));
    assert!((first.p - 2.0 * 0.028).abs() < 1e-15 && (first.value - 1.0 / 3.0).abs() < 1e-15, "{first:?}");
    assert_eq!((first.expected, second.expected, second.p), (0.9, 0.5, 1.0));
    // (1/3 − 0.9)/√(0.9·0.1/3).
    assert!((first.z + 0.566_667 / 0.173_205).abs() < 1e-4, "{first:?}");
    let told = (checks[0].kind, checks[0].scene.as_str(), checks[0].spp, checks[0].what.as_str());
    assert_eq!(told, (CheckKind::Normal, NORMAL, Some(4), "coverage of 90 % intervals"));
}

#[test]
fn missed_events_are_counted_once_and_their_coverage_is_that_of_the_enumeration() {
    // The numbers of 10⁶ trials at q = 0.02, n = 4, to the last one.
    let exact = |confidence| count(confidence, [77_632, 77_632, 0, 922_368]);
    let checks = rare(4, &[&exact(0.95), &exact(0.99)]);
    let what: Vec<&str> = checks.iter().map(|check| check.what.as_str()).collect();
    assert_eq!(what, ["missed events", "coverage of 95 % intervals", "coverage of 99 % intervals"]);
    for (check, expected) in checks.iter().zip([0.922_368, 0.077_632, 0.077_632]) {
        let found = found(check);
        assert!((found.expected - expected).abs() < 6e-7, "{found:?}");
        assert!(found.z.abs() < 0.01 && found.p > 0.9, "{found:?}");
    }
    // What is missed counts as covered: 923 standard deviations of a share of 10⁶ trials.
    let wrong = rare(4, &[&count(0.95, [77_632, 77_632, 922_368, 0])]);
    let sizes: Vec<f64> = wrong.iter().map(|check| found(check).z).collect();
    assert!(sizes[0] < -3000.0 && sizes[1] > 3000.0 && wrong.iter().all(|c| found(c).p == 0.0), "{wrong:?}");
}

#[test]
fn counts_of_nothing_check_nothing() {
    assert_eq!(normal(4, &[&count(0.95, [0; 4])]), []);
    assert_eq!(rare(4, &[]), []);
}

/// What a row estimated and what was measured, over replicates.
fn estimate(estimated: &[f64], measured: &[f64]) -> EstimateSummary {
    let mean = |values: &[f64]| told(&replicate_interval(values, 0.0, LEVEL).unwrap());
    let ratio = estimated.iter().chain(measured).all(|v| *v > 0.0);
    let pairs = estimated.iter().zip(measured);
    let effect = if ratio {
        let logs: Vec<f64> = pairs.map(|(a, b)| (a / b).ln()).collect();
        told(&replicate_interval(&logs, 0.0, LEVEL).unwrap().exp())
    } else {
        mean(&pairs.map(|(a, b)| a - b).collect::<Vec<_>>())
    };
    EstimateSummary {
        scene: NORMAL.into(),
        spp: 4,
        label: "sure".into(),
        of: None,
        class: ALL.into(),
        estimated: mean(estimated),
        measured: mean(measured),
        effect,
        is_ratio: ratio,
        common: 0.0,
        deciles: Vec::new(),
        non_finite: 0,
    }
}

fn told(interval: &noisefloor_stats::Interval) -> Interval {
    crate::records::told(*interval, Source::Replicates, None)
}

#[test]
fn an_estimate_is_held_against_the_measured_error_in_standard_errors_of_its_replicates() {
    let found = found(&known_variance(&estimate(&[0.5, 0.505, 0.5, 0.505], &[1.0; 4])).unwrap());
    let logs = [0.5f64.ln(), 0.505f64.ln()];
    // The mean of two pairs of equal numbers, and their standard deviation √(4/3)·half their difference, over √4.
    let (mean, se) = (0.5 * (logs[0] + logs[1]), 0.5 * (logs[1] - logs[0]) / 3f64.sqrt());
    assert!(
        (found.value - mean.exp()).abs() < 1e-12 && (found.z / (mean / se) - 1.0).abs() < 1e-9,
        "{found:?}"
    );
    // From 0.8, the region's end, by Student's t with 3 degrees of freedom: far beyond 100 standard errors.
    assert!(found.p > 0.0 && found.p < 1e-5, "{found:?}");
    let right = known_variance(&estimate(&[1.1, 0.95, 1.05, 0.9], &[1.0; 4])).unwrap();
    assert_eq!(right.found.unwrap().p, 1.0, "within a fifth");
}

#[test]
fn an_estimate_below_zero_is_a_fault_and_no_silence() {
    let found =
        found(&known_variance(&estimate(&[-0.11, -0.112, -0.109, -0.111], &[1.0, 1.01, 0.99, 1.0])).unwrap());
    assert!((found.value + 0.1105).abs() < 1e-3 && found.z < -100.0 && found.p < 1e-5, "{found:?}");
}

#[test]
fn an_error_that_may_be_nothing_cannot_be_estimated_wrongly() {
    let check = known_variance(&estimate(&[-0.1, 0.1, 0.2, 0.1], &[-0.01, 0.01, 0.02, -0.01])).unwrap();
    assert!(check.found.is_none() && !check.note.is_empty(), "{check:?}");
}

#[test]
fn other_scenes_and_classes_are_no_check_of_estimates() {
    let here = estimate(&[0.5; 4], &[1.0; 4]);
    assert!(known_variance(&here).is_some());
    assert_eq!(known_variance(&EstimateSummary { scene: RARE.into(), ..here.clone() }), None);
    assert_eq!(known_variance(&EstimateSummary { class: "dark".into(), ..here }), None);
}

#[test]
fn the_study_has_the_small_levels_of_the_one_that_it_is_for_and_its_seed() {
    let scene = |spp: &[u32]| SceneSpec {
        id: "own".into(),
        source: SceneSource::Builtin("cornell".into()),
        spp: Some(spp.to_vec()),
        replicates: None,
        shot: Shot::default(),
        set: Map::new(),
        equal_time_spp: None,
        sequence: None,
    };
    let study = |spp: &[u32], of_scene: &[u32]| {
        let mut study = Study::plain("own".into(), spp.to_vec(), vec![scene(of_scene)], Vec::new());
        (study.seed, study.coverage) = (9, vec![0.9]);
        study
    };
    let check = self_check_study(&study(&[1, 256, 8], &[4, 8, 64]), &["sure".to_owned()]).unwrap();
    assert_eq!((check.spp, check.seed), (vec![4, 8, 64], 9));
    assert_eq!(check.coverage, [0.9, 0.95, 0.99, 0.998], "those of the study and those where faults show");
    assert_eq!(check.replicates, Replicates::uniform(REPLICATES));
    let frames: Vec<(&str, &RowFrames)> = check.methods.iter().map(|m| (m.id.as_str(), &m.frames)).collect();
    assert_eq!(frames, [(BASELINE, &RowFrames::Uniform), ("sure", &RowFrames::KnownVariance)]);
    assert_eq!(self_check_study(&study(&[1, 256], &[1024]), &[]).unwrap().spp, [16], "nothing small");
}
