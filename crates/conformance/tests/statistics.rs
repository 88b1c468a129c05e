//! Statistical claims on frames with exact truth.

use noisefloor_conformance::Tolerance;
use noisefloor_denoiser::{Citation, DenoiseError, Denoiser, Guarded, Input, MethodCard, Output};
use noisefloor_frame::{Frame, Image, Variance};
use noisefloor_stats::{
    BoundTally, CoverageTally, Level, Observed, SampleCounts, Truth, bound_violations, clustered_rate,
    coverage, half_widths,
};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

const LEVELS: [Level; 3] = [Level::TWO_SIDED_95, Level::TWO_SIDED_99, Level::TWO_SIDED_998];
const GAUSSIAN: SampleLaw = SampleLaw::Gaussian { sd: 0.4, relative: false };

fn scene(law: SampleLaw) -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 96, 64).unwrap().with_guides(Guides::None)
}

fn observed(frame: &Frame) -> Observed<'_> {
    Observed {
        mean: frame.color.mean.data(),
        variance: frame.color.variance.as_ref().map_or(&[], |v| v.mean_variance().data()),
        counts: SampleCounts::Uniform(frame.samples.at(0)),
        pixels: frame.pixels(),
        valid: None,
    }
}

fn count(frame: &Frame, truth: &Image, noise: Option<&Image>, level: Level) -> CoverageTally {
    let truth = Truth { mean: truth.data(), variance: noise.map(Image::data) };
    coverage(&observed(frame), &truth, level, None).unwrap()[0]
}

#[test]
fn coverage_against_exact_truth_is_nominal() {
    let scene = scene(GAUSSIAN);
    let truth = scene.truth();
    for spp in [2, 4, 64] {
        let frame = scene.render(spp, 21);
        for level in LEVELS {
            let tally = count(&frame, truth.mean(), None, level);
            assert_eq!((tally.covered, tally.all()), (tally.covered_uncorrected, tally.total));
            // The channels are independent here.
            let tolerance = Tolerance::rate(level.confidence(), tally.all());
            tolerance.near(tally.rate().unwrap()).unwrap();
        }
    }
}

#[test]
fn coverage_against_a_noisy_truth_is_nominal_with_the_allowance_and_low_without() {
    let scene = scene(GAUSSIAN);
    let (frame, reference) = (scene.render(64, 22), scene.render(256, 23));
    let noise = reference.color.variance.as_ref().map(Variance::mean_variance);
    // Only four times the samples: the uncorrected interval of 95 % covers P(|Z| ≤ 1.96/√(1+¼)) ≈ 92 %.
    let tally = count(&frame, &reference.color.mean, noise, Level::TWO_SIDED_95);
    Tolerance::rate(0.95, tally.all()).near(tally.rate().unwrap()).unwrap();
    let uncorrected = tally.covered_uncorrected as f64 / tally.total as f64;
    assert!(Tolerance::rate(0.95, tally.all()).at_least(uncorrected).is_err(), "{uncorrected}");
}

#[test]
fn rare_events_are_missed_as_often_as_their_law_says() {
    let (q, n) = (0.01, 16);
    let scene = scene(SampleLaw::Bernoulli { q, bright: 1.0 });
    let tally = count(&scene.render(n, 24), scene.truth().mean(), None, Level::TWO_SIDED_99);
    assert_eq!(tally.constant, 0);
    let missed = tally.missed as f64 / tally.all() as f64;
    Tolerance::rate((1.0 - q).powi(n as i32), tally.all()).near(missed).unwrap();
    let low = Tolerance::rate(0.99, tally.all()).at_least(tally.rate().unwrap());
    assert!(low.is_err(), "coverage collapses: {:?}", tally.rate());
}

#[test]
fn channels_that_share_their_noise_count_as_one() {
    let scene = scene(GAUSSIAN).with_common_channels(true);
    let truth = scene.truth();
    let level = Level::TWO_SIDED_95;
    let rates: Vec<f64> = (0..40)
        .map(|seed| count(&scene.render(8, seed), truth.mean(), None, level).rate().unwrap())
        .collect();
    let pixels = 96 * 64;
    let actual = {
        let mean = rates.iter().sum::<f64>() / 40.0;
        rates.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / 39.0
    };
    // Over replicates the variance is that of `pixels` trials, not of three times as many.
    Tolerance::normal_variance(0.95 * 0.05 / f64::from(pixels), 40).near(actual).unwrap();
    let frame = scene.render(8, 99);
    let widths = half_widths(&observed(&frame), &[(1.0, level)]).unwrap();
    let hits: Vec<bool> = (0..widths.len())
        .map(|i| f64::from(frame.color.mean.data()[i] - truth.mean().data()[i]).abs() <= widths[i])
        .collect();
    let within = clustered_rate(&hits, pixels as usize).unwrap().standard_error;
    let ratio = within * within / (0.95 * 0.05 / f64::from(pixels));
    // A binomial variance from its own rate: the rate's 5 tolerances move p(1−p) by
    // 5·√(0.0475/6144)·0.9/0.0475 = 26 %.
    assert!((ratio - 1.0).abs() < 0.27, "{ratio}");
}

/// Adds a constant far outside any interval, which the guard then cuts to the interval's end: the worst that
/// it lets through.
struct Shift(f32);

impl Denoiser for Shift {
    fn card(&self) -> MethodCard {
        MethodCard::new("shift", "shift", Citation::new("none", "none"))
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        Ok(Output::from_image(input.target.color.mean.map(|v| v + self.0)))
    }
}

fn violations(scene: &SyntheticScene, spp: u32, level: Level, factor: f64) -> BoundTally {
    let frame = scene.render(spp, 25);
    let guarded = Guarded::new(Box::new(Shift(1e3)), level);
    let output = guarded.denoise(&Input::new(&frame)).unwrap();
    let observed = observed(&frame);
    let bound = half_widths(&observed, &[(factor, level)]).unwrap();
    let truth = scene.truth();
    let truth = Truth { mean: truth.mean().data(), variance: None };
    bound_violations(output.image.data(), &bound, &observed, &truth, level, None).unwrap()[0]
}

#[test]
fn the_theorem_holds_on_normal_samples_even_for_the_worst_output() {
    let scene = scene(GAUSSIAN);
    for level in LEVELS {
        for spp in [2, 16] {
            let tally = violations(&scene, spp, level, 2.0);
            let rate = tally.rate().unwrap();
            Tolerance::rate(level.alpha(), tally.total).at_most(rate).unwrap();
            // D is the interval's upper end, so |D−μ| > 2·t·SE exactly where T > t or T < −3·t.
            let least = 0.5 * level.alpha();
            Tolerance::rate(least, tally.total).at_least(rate).unwrap();
            assert_eq!((tally.violations, tally.violations_missed), (tally.violations_uncorrected, 0));
        }
    }
}

#[test]
fn the_theorem_fails_on_rare_events_and_on_half_the_width() {
    let rare = scene(SampleLaw::Bernoulli { q: 0.01, bright: 1.0 });
    let tally = violations(&rare, 16, Level::TWO_SIDED_99, 2.0);
    assert!(Tolerance::rate(0.01, tally.total).at_most(tally.rate().unwrap()).is_err());
    assert!(tally.violations_missed * 2 > tally.violations);
    let half = violations(&scene(GAUSSIAN), 16, Level::TWO_SIDED_99, 1.0);
    // D = x̄ + t·SE lies further than t·SE from μ in about half of all cases.
    assert!(half.rate().unwrap() > 0.4);
}
