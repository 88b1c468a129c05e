use noisefloor_stats::Verdict;
use noisefloor_synthetic::{ImageKind, SampleLaw};

use super::super::level::measure;
use super::*;
use crate::cell::{Measure, PixelClasses};
use crate::level::made::Made;

const LAW: SampleLaw = SampleLaw::Gaussian { sd: 0.1, relative: true };

fn answer(made: &Made) -> Option<Answer> {
    let value = made.measure(measure).answers.remove(ID)?;
    Some(serde_json::from_value(value).unwrap())
}

/// What is found at 95 % over all pixels beside the coverage of the level's reference, and its verdict.
fn found(made: &Made) -> (Finding, Verdict) {
    let classes = PixelClasses::from_reference(&made.reference);
    let against = |replicate: u32| {
        let f = made.frames.iter().find(|f| f.replicate == replicate)?;
        let measure = Measure::new(&f.frame, &made.reference, &classes, &[], false);
        let all = measure.coverage(&[0.95]).unwrap().into_iter().find(|c| c.class == ALL)?;
        Some(all.covered as f64 / all.total as f64)
    };
    let answer = answer(made).unwrap();
    let same = |c: &&Count| c.class == ALL && c.confidence == 0.95;
    let count = answer.counts.iter().find(same).unwrap();
    let found = finding(("made", made.spp), &answer.replicates, count, against).unwrap();
    let mut summary = Summary::default();
    push(&mut summary, claim(&found, "mc", count.spread.pixels()));
    (found, summary.claims[0].alone)
}

#[test]
fn normal_samples_cover_with_and_without_a_reference() {
    let (found, verdict) = found(&Made::of(ImageKind::Mixed, LAW, 64, 16, 8));
    assert_eq!(verdict, Verdict::Shown, "{found:?}");
    // 64·64·3·8 pixel-channels; the replicates' dependence makes it a little more.
    let mcse = (0.05f64 * 0.95 / (64.0 * 64.0 * 3.0 * 8.0)).sqrt();
    assert!((found.covered.value - 0.95).abs() < 5.0 * mcse, "{found:?}");
    assert!((found.against.unwrap() - 0.95).abs() < 5.0 * mcse, "{found:?}");
    assert!(found.lost.unwrap().value.abs() < 8.0 * mcse);
    assert_eq!((found.constant, found.missed), (0.0, 0.0));
}

#[test]
fn a_reference_that_is_too_bright_loses_the_centre_alone() {
    let mut made = Made::of(ImageKind::Mixed, LAW, 64, 16, 8);
    made.reference.frame.color.mean = made.reference.frame.color.mean.map(|v| 1.03 * v);
    let (found, verdict) = found(&made);
    assert_eq!(verdict, Verdict::Shown, "{found:?}");
    // 3 % are 1.2 standard errors of 16 samples: about a quarter of the intervals miss.
    let against = found.against.unwrap();
    assert!(against < Region::coverage(0.95).low && against > 0.7, "{found:?}");
    assert!(found.lost.unwrap().low.unwrap() > 0.1);
}

#[test]
fn intervals_of_the_variance_of_one_sample_are_refuted_without_a_reference() {
    let mut made = Made::of(ImageKind::Mixed, LAW, 64, 16, 8);
    for f in &mut made.frames {
        let variance = f.frame.color.variance.as_ref().unwrap().mean_variance().map(|v| 16.0 * v);
        f.frame.color.variance = Some(noisefloor_frame::Variance::of_mean(variance));
    }
    assert_eq!(found(&made).1, Verdict::Refuted);
}

#[test]
fn one_replicate_has_no_others() {
    assert_eq!(answer(&Made::of(ImageKind::Flats, LAW, 16, 4, 1)), None);
}
