use noisefloor_stats::Verdict;
use noisefloor_synthetic::{ImageKind, SampleLaw};

use super::super::level::measure;
use super::*;
use crate::level::made::Made;

/// 93 pixels a side: the grid has 31.
fn verdict(law: SampleLaw, spp: u32) -> (Finding, Verdict) {
    let made = Made::of(ImageKind::Flats, law, 93, spp, 6);
    let answer = made.measure(measure).answers.remove(ID).unwrap();
    let found = finding("made", spp, serde_json::from_value(answer).unwrap()).unwrap();
    let mut summary = Summary::default();
    push(&mut summary, claim(&found, &band(found.values).unwrap(), "mc").unwrap());
    (found, summary.claims[0].alone)
}

#[test]
fn normal_samples_are_shown_to_be_uniform() {
    let (found, verdict) = verdict(SampleLaw::Gaussian { sd: 0.3, relative: false }, 4);
    assert_eq!((verdict, found.values, found.left_out), (Verdict::Shown, 961, 0), "{found:?}");
    assert_eq!((found.ecdf.len(), found.constant, found.missed_above), (POINTS, 0.0, 0.0));
}

#[test]
fn of_transforms_that_are_drawn_nothing_is_claimed() {
    let (found, _) = verdict(SampleLaw::Gaussian { sd: 0.3, relative: false }, 4);
    let band = band(found.values).unwrap();
    let of = |constant| claim(&Finding { constant, ..found.clone() }, &band, "mc");
    assert!(of(0.1).is_some() && of(0.11).is_none() && of(1.0).is_none());
}

#[test]
fn few_exponential_samples_are_refuted() {
    let (found, verdict) = verdict(SampleLaw::Exponential, 4);
    assert_eq!(verdict, Verdict::Refuted, "{found:?}");
    // Of 4 samples 11.5 % of the 95 % intervals lie below the truth, in place of 2.5 %: F̂(0.98) is about 0.9.
    assert!(found.ecdf[48] < 0.93, "{}", found.ecdf[48]);
}

#[test]
fn missed_events_are_counted_on_their_side() {
    let (found, _) = verdict(SampleLaw::Bernoulli { q: 0.02, bright: 1.0 }, 4);
    // 0.98⁴ = 0.922368 of the pixels, of 961 in 6 replicates.
    let sd = (0.922_368f64 * 0.077_632 / (6.0 * 961.0)).sqrt();
    assert!((found.missed_above - 0.922_368).abs() < 4.0 * sd, "{found:?}");
    assert_eq!((found.missed_below, found.constant), (0.0, 0.0));
}
