//! Methods that estimate their own error, where the error is known.

use noisefloor_harness::reanalyse;
use noisefloor_stats::Verdict;
use noisefloor_study::summary::{EstimateSummary, Source, Summary};

use crate::common::{Place, Watch, records, study};

const PIXELS: f64 = 64.0 * 48.0;

fn run(replicates: u32, rows: &str) -> (Place, Summary) {
    let study = study(&format!(
        r#"
        name = "own"
        spp = [4, 16]
        replicates = {replicates}
        timing = {{ warmup = 0, runs = 1 }}
        [[scene]]
        id = "flats"
        synthetic = {{ image = "flats", law = "gaussian", sd = 0.5, width = 64, height = 48, guides = "none" }}
        [[method]]
        id = "mc"
        {rows}
        "#
    ));
    let place = Place::new();
    let summary = place.run(&study, &Watch::default()).unwrap();
    (place, summary)
}

fn judge(label: &str, set: &str) -> String {
    format!("[[method]]\nid = \"judge\"\nlabel = \"{label}\"\nset = {{ {set} }}\n")
}

fn found<'a>(summary: &'a Summary, label: &str, spp: u32, class: &str) -> &'a EstimateSummary {
    let mut of_row = summary.estimates.iter();
    of_row.find(|e| e.label == label && e.spp == spp && e.class == class).unwrap()
}

fn verdict_of(summary: &Summary, label: &str, spp: u32) -> Verdict {
    let mut claims = summary.claims.iter().filter(|claim| claim.id.question == "own_error");
    claims.find(|claim| claim.id.label == label && claim.id.spp == Some(spp)).unwrap().verdict
}

#[test]
fn an_unbiased_estimate_is_calibrated_and_a_scaled_one_is_told_which_way() {
    let rows = [judge("honest", ""), judge("proud", "scale = 0.5"), judge("shy", "scale = 2.0")].concat();
    let (place, summary) = run(6, &rows);
    for spp in [4u32, 16] {
        let variance = 0.25 / f64::from(spp);
        // Means over so many independent pixel-channels; a squared normal error has the relative variance 2, an estimate
        // of its variance from n samples 2/(n−1).
        let n = PIXELS * 3.0 * 6.0;
        let (sd_measured, sd_estimated) = ((2.0 / n).sqrt(), (2.0 / (f64::from(spp - 1) * n)).sqrt());
        for (label, scale, verdict) in [
            ("honest", 1.0, Verdict::Shown),
            ("proud", 0.5, Verdict::Refuted),
            ("shy", 2.0, Verdict::Refuted),
        ] {
            let own = found(&summary, label, spp, "all");
            let off = own.measured.value / variance - 1.0;
            assert!(off.abs() < 5.0 * sd_measured, "{label} at {spp}: measured off by {off}");
            let off = own.estimated.value / (scale * variance) - 1.0;
            assert!(off.abs() < 5.0 * sd_estimated, "{label} at {spp}: estimate off by {off}");
            let off = own.effect.value / scale - 1.0;
            assert!(
                off.abs() < 5.0 * sd_measured.hypot(sd_estimated),
                "{label} at {spp}: ratio off by {off}"
            );
            assert!(own.is_ratio && own.effect.source == Source::Replicates && own.effect.n == 6);
            assert_eq!(verdict_of(&summary, label, spp), verdict, "{label} at {spp}");
        }
        let mse = summary.cells.iter().find(|c| c.label == "honest" && c.spp == spp).unwrap();
        let own = found(&summary, "honest", spp, "all").measured.value;
        assert!((own / mse.metrics["mse"].value - 1.0).abs() < 1e-9, "measured as the MSE is");
    }
    assert!(summary.estimates.iter().all(|e| e.label != "mc"), "a row without an estimate has no numbers");
    assert!(summary.methods.iter().all(|m| m.estimates_error == (m.label != "mc")));
    // Records and analysis come back from disk as they were.
    let again = reanalyse(&place.out(), false).unwrap();
    assert_eq!(again.estimates, summary.estimates);
}

#[test]
fn tenths_by_rank_show_that_a_variance_of_few_samples_knows_nothing_of_its_own_error() {
    let (place, summary) = run(6, &judge("honest", ""));
    let own = found(&summary, "honest", 4, "all");
    assert_eq!(own.deciles.len(), 10);
    let estimated: Vec<f64> = own.deciles.iter().map(|d| d.estimated.value).collect();
    assert!(estimated.is_sorted() && estimated[9] > 10.0 * estimated[0], "{estimated:?}");
    // Mean and variance of normal samples are independent: every tenth has the same error.
    let sd = (2.0f64 / (PIXELS * 3.0 * 6.0 / 10.0)).sqrt();
    for bin in &own.deciles {
        let off = bin.measured.value / (0.25 / 4.0) - 1.0;
        assert!(off.abs() < 5.0 * sd, "{off} with a standard deviation of {sd}");
    }
    let classes: Vec<&str> = summary
        .estimates
        .iter()
        .filter(|e| e.spp == 4 && e.class != "all")
        .map(|e| e.class.as_str())
        .collect();
    assert!(classes.contains(&"flat") && own.deciles.len() == 10, "{classes:?}");
    let record = records(&place.out()).into_iter().find(|r| r.label == "honest").unwrap();
    let check = record.error_estimate.unwrap();
    assert_eq!((check.all.count, check.non_finite, check.within_se), (64 * 48 * 3, 0, None));
    assert_eq!(check.classes.values().map(|c| c.count).sum::<u64>(), check.all.count);
}

#[test]
fn a_negative_estimate_is_compared_by_its_difference() {
    let (_place, summary) = run(3, &judge("sure", "scale = -1.0"));
    let own = found(&summary, "sure", 4, "all");
    assert!(!own.is_ratio && own.estimated.value < 0.0);
    assert!((own.effect.value + 0.125).abs() < 0.01, "{:?}", own.effect);
    assert_eq!(
        verdict_of(&summary, "sure", 4),
        Verdict::Refuted,
        "below zero is no less wrong than too small"
    );
}

#[test]
fn one_replicate_has_an_interval_from_within_its_image() {
    let (_place, summary) = run(1, &judge("honest", ""));
    let own = found(&summary, "honest", 16, "all");
    assert_eq!((own.effect.source, own.effect.n), (Source::WithinImage, 1));
    // The spread of blocks: 4 blocks here, so the estimate itself is good to a factor of 1 ± 1/√6.
    let expected = ((2.0 + 2.0 / 15.0) / (PIXELS * 3.0)).sqrt();
    let se = own.effect.standard_error.unwrap() / own.effect.value;
    assert!(se > 0.1 * expected && se < 3.0 * expected, "{se} against {expected}");
    assert_eq!(found(&summary, "honest", 16, "flat").effect.source, Source::None);
    assert_eq!(verdict_of(&summary, "honest", 16), Verdict::NotShown, "one image speaks for itself alone");
}

#[test]
fn an_estimate_that_is_claimed_and_missing_or_of_another_shape_is_told() {
    let rows = [judge("silent", "silent = true"), judge("flat", "flat = true")].concat();
    let (_place, summary) = run(2, &rows);
    assert!(
        summary.warnings.iter().any(|w| w.to_string().starts_with("silent: claims an estimate")),
        "{:?}",
        summary.warnings
    );
    let failed = summary.skipped.iter().find(|s| s.label == "flat").unwrap();
    assert!(failed.reason.contains("error estimate of 64×48×1"), "{}", failed.reason);
}
