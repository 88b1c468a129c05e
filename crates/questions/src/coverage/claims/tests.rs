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
    println!("{wrong} of {cells} cells refuted, {without} intervals without the truth");
    assert!(share(without) <= limit && without > wrong, "{without}");
}

#[test]
fn cells_whose_intervals_are_too_narrow_are_refuted() {
    let (right, cells) = refuted(5, &[4], family("normal").unwrap(), Region::coverage);
    assert_eq!((right, cells), (15, 15));
}
