//! The first screen's sentences and how they sound.

use noisefloor_questions::document;
use noisefloor_study::exhibit::Tone;
use noisefloor_study::summary::{Status, Summary};

use crate::fixture::{judge_all, study};
use crate::look::{answer, told};

const ERROR: &str = "closest to the truth";
const COST: &str = "What does it cost?";
const CLAIMS: &str = "statistical claims";
const BREAKAGE: &str = "break";

fn green(summary: &Summary) -> Vec<String> {
    let answers = document(summary).front.answers;
    answers.into_iter().filter(|a| a.tone == Tone::Good).map(|a| a.question).collect()
}

#[test]
fn the_four_questions_come_in_their_order() {
    let asked: Vec<String> = document(&study()).front.answers.into_iter().map(|a| a.question).collect();
    for (question, part) in asked.iter().zip([ERROR, COST, CLAIMS, BREAKAGE]) {
        assert!(question.contains(part), "{question}");
    }
    assert_eq!(asked.len(), 4);
}

#[test]
fn a_tie_is_in_the_headline() {
    let mut study = study();
    for comparison in study.comparisons.iter_mut().filter(|c| c.spp == 64) {
        comparison.best_group = comparison.ranking[..2].to_vec();
    }
    let lead = told(&study, ERROR);
    let tied = "virtual-flash and guarded(virtual-flash) are tied for the lowest rMSE on all 2 scenes";
    assert!(lead.contains(tied), "{lead}");
    assert!(lead.contains("cannot tell them apart") && !lead.contains("has the lowest"), "{lead}");
    // One scene with a clear winner, one with a tie.
    study.comparisons.iter_mut().filter(|c| c.scene == "lamps").for_each(|c| c.best_group.truncate(1));
    let first =
        study.comparisons.iter().find(|c| c.scene == "lamps" && c.spp == 64).unwrap().ranking[0].clone();
    let lead = told(&study, ERROR);
    assert!(lead.contains(&format!("{first} has the lowest rMSE on 1 of 2 scenes and is tied")), "{lead}");
}

#[test]
fn a_single_replicate_says_that_another_order_is_possible() {
    let mut study = study();
    study.scenes.iter_mut().for_each(|s| s.replicates.values_mut().for_each(|n| *n = 1));
    study.cells.iter_mut().for_each(|cell| cell.replicates = 1);
    let lead = told(&study, ERROR);
    assert!(lead.contains("One replicate: other random seeds may give another order."), "{lead}");
    assert!(!lead.contains("tied"), "one replicate tells nothing, not even a tie: {lead}");
}

#[test]
fn costs_of_frames_of_different_sizes_are_told_apart() {
    let mut study = study();
    assert_eq!(told(&study, COST).matches("a frame of 48×36").count(), 1);
    study.scenes[1].width = 480;
    study.scenes[1].height = 360;
    for cell in study.cells.iter_mut().filter(|cell| cell.scene == "lamps") {
        cell.denoise_seconds = cell.denoise_seconds.map(|s| 100.0 * s);
    }
    let told = told(&study, COST);
    for text in [
        "61.0 ms (virtual-flash) to 64.0 ms (guarded(virtual-flash)) a frame of 48×36",
        "6.71 s (virtual-flash) to 7.04 s (guarded(virtual-flash)) a frame of 480×360",
    ] {
        assert!(told.contains(text), "{told}");
    }
}

#[test]
fn what_was_not_tested_is_never_green() {
    let mut study = study();
    study.claims.clear();
    assert_eq!(answer(&study, CLAIMS).tone, Tone::Plain, "an enclosure alone is no claim shown");
    assert_ne!(answer(&study, BREAKAGE).tone, Tone::Good, "a row was skipped");
    study.skipped.clear();
    assert_eq!(answer(&study, BREAKAGE).tone, Tone::Good);
    study.progress = None;
    assert_eq!(answer(&study, BREAKAGE).tone, Tone::Plain, "whether all ended is unknown");
    study.cells.clear();
    assert!(green(&study).is_empty(), "nothing ran");
}

/// The study with the proven bounds as its only claims; they are shown.
fn proven() -> Summary {
    let mut study = study();
    study.bounds.retain(|b| b.proven);
    (study.coverage, study.estimates, study.paper) = (Vec::new(), Vec::new(), Vec::new());
    judge_all(&mut study);
    study
}

#[test]
fn only_claims_that_are_all_shown_are_green_and_one_that_is_refuted_is_red() {
    let shown = answer(&proven(), CLAIMS);
    assert_eq!(shown.tone, Tone::Good);
    assert!(shown.sentences[0].contains("Of 16 claims, 16 shown, 0 refuted, 0 not shown"), "{shown:?}");
    let with = |low, value, high| {
        let mut study = proven();
        let violations = &mut study.bounds[0].violations;
        (violations.low, violations.value, violations.high) = (Some(low), value, Some(high));
        violations.standard_error = Some((high - value) / 3.18);
        judge_all(&mut study);
        answer(&study, CLAIMS)
    };
    let open = with(0.001, 0.0015, 0.0025);
    assert_eq!(open.tone, Tone::Plain, "lack of evidence is no success");
    assert!(open.sentences.iter().any(|s| s.contains("15 shown, 0 refuted, 1 not shown")), "{open:?}");
    assert_eq!(with(0.0099, 0.01, 0.0101).tone, Tone::Bad);
    // p is 0.05 at the interval's end: refuted alone, not beside fifteen others.
    let alone = with(0.002_01, 0.003, 0.003_99);
    assert_eq!(alone.tone, Tone::Plain);
    assert!(
        alone.sentences[0].contains("Each taken alone, 1 would be refuted; at most 0.80 by chance"),
        "{alone:?}"
    );
}

/// The study in which the guarded row breaks its proven bound at 4 samples.
fn broken() -> Summary {
    let mut study = study();
    let guarded = |label: &str| label.starts_with("guarded");
    study.bounds.retain(|b| guarded(&b.label));
    for b in study.bounds.iter_mut().filter(|b| b.spp == 4) {
        let violations = &mut b.violations;
        (violations.value, violations.low, violations.high) = (0.01, Some(0.009_9), Some(0.010_1));
        violations.standard_error = Some(0.0001 / 3.18);
        b.missed = 0.006;
    }
    judge_all(&mut study);
    study
}

#[test]
fn a_broken_bound_with_its_certain_half_held_is_laid_to_the_light() {
    let claims = answer(&broken(), CLAIMS);
    let told = claims.sentences.join(" ");
    assert_eq!(claims.tone, Tone::Bad, "the promise is broken all the same");
    assert!(told.contains("6 shown, 2 refuted, 0 not shown; worst 1.00 % beside"), "{told}");
    assert!(told.contains("The light breaks them, not the program"), "{told}");
    assert!(
        told.contains("60.0 % of the violations in the worst cell are at pixels that met none"),
        "{told}"
    );
}

#[test]
fn the_light_is_not_blamed_without_evidence() {
    let blamed = |study: &Summary| told(study, CLAIMS).contains("The light breaks them");
    let mut unknown = broken();
    unknown.cells.iter_mut().for_each(|cell| cell.enclosure_worst_ratio = None);
    assert!(!blamed(&unknown), "nobody looked at the certain half");
    let mut violated = broken();
    violated.cells.iter_mut().filter(|c| c.spp == 256).for_each(|c| {
        c.enclosure_worst_ratio = c.enclosure_worst_ratio.map(|_| 1.2);
    });
    assert!(!blamed(&violated), "the program broke the certain half somewhere");
    assert!(told(&violated, CLAIMS).contains("by a factor of 1.20"));
    let mut printed = broken();
    printed.bounds.iter_mut().for_each(|b| b.proven = false);
    judge_all(&mut printed);
    assert!(!blamed(&printed), "no proof says that normal samples would keep it");
}

#[test]
fn an_error_or_a_lost_value_is_red() {
    let mut failed = study();
    failed.skipped[0].status = Status::Failed;
    assert_eq!(answer(&failed, BREAKAGE).tone, Tone::Bad);
    assert!(told(&failed, BREAKAGE).contains("1 row ended in an error."));
    let mut lost = study();
    lost.cells[0].non_finite_output = 3;
    assert_eq!(answer(&lost, BREAKAGE).tone, Tone::Bad);
    assert!(told(&lost, BREAKAGE).contains("3 output values were not finite."));
}
