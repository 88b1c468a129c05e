//! The noise of a reference does not pass for error, and what it adds to the uncertainty is predicted.

use std::sync::LazyLock;

use noisefloor_frame::{Image, Reference, Sampling};
use noisefloor_metrics::{Classes, Contribution, Measurer};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

const SIZE: (usize, usize) = (48, 32);
const REFERENCES: usize = 120;
const PARTS: usize = 8;
const SPP_PER_PART: u32 = 8;

fn scene() -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(ImageKind::Ramps), SampleLaw::Exponential, SIZE.0, SIZE.1)
        .unwrap()
        .with_guides(Guides::None)
}

/// Independent references in eight parts.
static REFERENCE: LazyLock<Vec<Reference>> = LazyLock::new(|| {
    let part = |seed: usize, k: usize| scene().render(SPP_PER_PART, (seed * PARTS + k) as u64).color.mean;
    let parts = |seed: usize| (0..PARTS).map(|k| part(seed, k)).collect();
    let whole = |seed| Reference::from_parts(parts(seed), SPP_PER_PART, Sampling::Independent).unwrap();
    (0..REFERENCES).map(whole).collect()
});

/// Truth plus a smooth error of about `size`, in blocks of both signs.
fn test_image(size: f32) -> Image {
    let truth = scene().truth();
    let wave = |v: usize| (v as f32 * 0.3).sin();
    let (w, h) = SIZE;
    let error = Image::from_fn(w, h, 3, |c, x, y| size * (wave(x) * wave(y) + 0.3 * c as f32 - 0.2));
    truth.mean().zip_map(&error, |r, e| r + e)
}

struct Trial {
    value: f64,
    standard_error: f64,
    floor: f64,
}

fn trials(size: f32, id: &str, strip: impl Fn(&mut Reference)) -> Vec<Trial> {
    let test = test_image(size);
    REFERENCE
        .iter()
        .map(|reference| {
            let mut reference = reference.clone();
            strip(&mut reference);
            let measurer = Measurer::new(&reference, None).unwrap();
            let measured = measurer.measure(&test).unwrap();
            Trial {
                value: measured.values[id].unwrap(),
                standard_error: measured.reference_se.get(id).copied().unwrap_or(f64::NAN),
                floor: measurer.floor().get(id).copied().unwrap_or(f64::NAN),
            }
        })
        .collect()
}

fn mean_and_variance(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    (mean, values.map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0))
}

fn exact(size: f32) -> f64 {
    let truth = scene().truth();
    let terms = test_image(size);
    let sum: f64 = terms
        .data()
        .iter()
        .zip(truth.mean().data())
        .map(|(&x, &r)| {
            let (x, r) = (f64::from(x), f64::from(r));
            (x - r).powi(2)
        })
        .sum();
    sum / terms.data().len() as f64
}

fn keep(_: &mut Reference) {}

fn halves_only(reference: &mut Reference) {
    reference.parts.clear();
    reference.frame.color.variance = None;
}

fn variance_only(reference: &mut Reference) {
    reference.parts.clear();
    reference.frame.color.halves = None;
}

fn nothing(reference: &mut Reference) {
    variance_only(reference);
    reference.frame.color.variance = None;
}

/// Takes statistics away from a reference.
type Strip = fn(&mut Reference);

/// A way to strip a reference, and up to which factor the predicted variance may exceed the actual one: 3
/// where the channels count as dependent, which these are not.
const STATISTICS: [(&str, Strip, f64); 3] =
    [("parts", keep, 1.0), ("halves", halves_only, 1.0), ("variance", variance_only, 3.0)];

/// Predicted over actual variance, and the sampling error of that: an empirical variance has a relative
/// standard error of √(2/(R−1)).
fn ratio(predicted: impl Iterator<Item = f64> + Clone, actual: f64) -> (f64, f64) {
    let n = REFERENCES as f64;
    let (mean, spread) = mean_and_variance(predicted);
    (mean / actual, (2.0 / (n - 1.0) + spread / (n * mean * mean)).sqrt())
}

#[test]
fn corrected_errors_are_unbiased_and_their_spread_is_predicted() {
    for (name, strip, factor) in STATISTICS {
        for size in [0.0, 0.02, 0.2] {
            let trials = trials(size, "mse", strip);
            let (mean, variance) = mean_and_variance(trials.iter().map(|t| t.value));
            let error = (variance / REFERENCES as f64).sqrt();
            let expected = exact(size);
            assert!(
                (mean - expected).abs() < 4.0 * error,
                "{name} {size}: {mean} ± {error}, expected {expected}"
            );

            let (ratio, error) = ratio(trials.iter().map(|t| t.standard_error.powi(2)), variance);
            // For a perfect image the estimate is cut at the floor from below, which widens it. The variance
            // of a reference of eight parts is itself uncertain by 2/7 of its square, beside the 2 that
            // count: hence 7/8.
            let widest = if size == 0.0 { 2.0 * factor } else { factor };
            let (low, high) = (7.0 / 8.0 * (1.0 - 4.0 * error), widest * (1.0 + 4.0 * error));
            assert!(ratio > low && ratio < high, "{name} {size}: {ratio}, limits {low} to {high}");
        }
    }
}

#[test]
fn the_floor_is_the_error_of_a_perfect_image() {
    for (name, strip, _) in STATISTICS {
        let trials = trials(0.0, "mse", strip);
        let (_, variance) = mean_and_variance(trials.iter().map(|t| t.value));
        let (ratio, error) = ratio(trials.iter().map(|t| t.floor.powi(2)), variance);
        // Without parts the channels of a pixel count as dependent.
        let widest = if name == "parts" { 1.0 } else { 3.0 };
        let (low, high) = (7.0 / 8.0 * (1.0 - 4.0 * error), widest * (1.0 + 4.0 * error));
        assert!(ratio > low && ratio < high, "{name}: {ratio}, limits {low} to {high}");
    }
}

#[test]
fn the_spread_of_relative_errors_is_predicted_and_that_of_classes_and_trimmed_means_too() {
    let size = 0.2;
    let test = test_image(size);
    let names = ["left".to_owned(), "right".to_owned()];
    let of_pixel: Vec<u8> = (0..SIZE.0 * SIZE.1).map(|p| u8::from(p % SIZE.0 >= SIZE.0 / 2)).collect();
    for (name, strip, factor) in &STATISTICS[..2] {
        let mut found: Vec<(f64, f64)> = Vec::new();
        let mut of: Vec<Vec<(f64, f64)>> = vec![Vec::new(); 6];
        for reference in REFERENCE.iter() {
            let mut reference = reference.clone();
            strip(&mut reference);
            let classes = Classes { names: &names, of_pixel: &of_pixel };
            let measured = Measurer::new(&reference, Some(classes)).unwrap().measure(&test).unwrap();
            let variance = |found: Option<&Contribution>| found.and_then(Contribution::variance);
            let all = |id: &str| (measured.values[id].unwrap(), variance(measured.reference.get(id)));
            let class = |class: &str, id: &str| {
                (measured.classes[class][id].unwrap(), variance(measured.class_reference[class].get(id)))
            };
            let each = [
                all("mse"),
                all("relmse"),
                all("relmse_trimmed"),
                class("left", "mse"),
                class("right", "relmse"),
                class("left", "energy"),
            ];
            for (list, (value, variance)) in of.iter_mut().zip(each) {
                // 48×32 pixels are 2 blocks, too few for influences.
                list.extend(variance.map(|variance| (value, variance)));
            }
            found.push((measured.values["relmse"].unwrap(), measured.reference_se["relmse"].powi(2)));
        }
        assert!(of[0].len() == if *name == "parts" { REFERENCES } else { 0 }, "{name}");
        for (k, list) in of.iter().chain([&found]).enumerate().filter(|(_, list)| !list.is_empty()) {
            let (_, variance) = mean_and_variance(list.iter().map(|t| t.0));
            let (ratio, error) = ratio(list.iter().map(|t| t.1), variance);
            // Influences are of first order. References of 64 exponential samples have a relative variance of ρ² = 1/64,
            // and the next order of the relative error's variance is up to 40ρ² of it, as for a constant error of a
            // tenth of a constant truth.
            let next = if [1, 2, 4, 6].contains(&k) { 40.0 / 64.0 } else { 0.0 };
            let (low, high) = (7.0 / 8.0 * (1.0 - 4.0 * error), factor * (1.0 + next + 4.0 * error));
            assert!(ratio > low && ratio < high, "{name}, {k}: {ratio}, limits {low} to {high}");
        }
    }
}

#[test]
fn the_spread_of_the_energy_is_predicted() {
    let expected = {
        let sum = |image: &Image| image.data().iter().map(|&v| f64::from(v)).sum::<f64>();
        sum(&test_image(0.6)) / sum(scene().truth().mean())
    };
    for (name, strip, factor) in STATISTICS {
        let trials = trials(0.6, "energy", strip);
        let (mean, variance) = mean_and_variance(trials.iter().map(|t| t.value));
        // 5 standard errors of the mean over the references, and the bias by the mean in the denominator, which is its
        // relative variance.
        let allowed = 5.0 * (variance / REFERENCES as f64).sqrt() + 2.0 * variance / expected;
        assert!((mean - expected).abs() < allowed, "{name}: {mean}, expected {expected} ± {allowed}");
        let (ratio, error) = ratio(trials.iter().map(|t| t.standard_error.powi(2)), variance);
        let (low, high) = (7.0 / 8.0 * (1.0 - 4.0 * error), factor * (1.0 + 4.0 * error));
        assert!(ratio > low && ratio < high, "{name}: {ratio}, limits {low} to {high}");
    }
}

#[test]
fn influences_of_images_predict_the_spread_of_their_difference() {
    // Opposite errors: what the reference adds moves them against each other.
    let truth = scene().truth();
    let test = test_image(0.6);
    let opposite = truth.mean().zip_map(&test, |r, x| 2.0 * r - x);
    for id in ["mse", "relmse"] {
        let mut logs = Vec::new();
        let (mut stated, mut apart) = (Vec::new(), Vec::new());
        for reference in REFERENCE.iter() {
            let measurer = Measurer::new(reference, None).unwrap();
            let [a, b] = [&test, &opposite].map(|image| measurer.measure(image).unwrap());
            let [x, y] = [&a, &b].map(|m| m.values[id].unwrap());
            let (of_a, of_b) = (&a.reference[id], &b.reference[id]);
            logs.push((x / y).ln());
            let product = of_a.product * (1.0 / x - 1.0 / y);
            let sum: f64 = of_a.parts.iter().zip(&of_b.parts).map(|(k, l)| (k / x - l / y).powi(2)).sum();
            stated.push((sum - product * product).max(product * product));
            apart.push(of_a.variance().unwrap() / (x * x) + of_b.variance().unwrap() / (y * y));
        }
        let (_, variance) = mean_and_variance(logs.iter().copied());
        let (ratio, error) = ratio(stated.iter().copied(), variance);
        let (low, high) = (7.0 / 8.0 * (1.0 - 4.0 * error), 1.0 + 4.0 * error);
        assert!(ratio > low && ratio < high, "{id}: {ratio}, limits {low} to {high}");
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        // Where the linear part dominates the factor is 2; the product term, which cancels, takes from it.
        assert!(id == "relmse" || mean(&apart) < 0.75 * mean(&stated), "as if independent is too little");
    }
}

#[test]
fn without_any_statistics_the_noise_counts_as_error() {
    let trials = trials(0.0, "mse", nothing);
    let (mean, variance) = mean_and_variance(trials.iter().map(|t| t.value));
    // Exponential samples: the reference of 64 samples has variance μ²/64.
    let truth = scene().truth();
    let squares: f64 = truth.mean().data().iter().map(|&r| f64::from(r).powi(2)).sum();
    let expected = squares / truth.mean().data().len() as f64 / 64.0;
    assert!((mean - expected).abs() < 4.0 * (variance / REFERENCES as f64).sqrt(), "{mean} {expected}");
    assert!(trials[0].standard_error.is_nan(), "an unknown noise has no standard error");
}

#[test]
fn squared_errors_of_pixels_average_to_the_mse_and_are_missing_where_values_are() {
    let truth = Image::from_fn(40, 30, 3, |c, x, y| 0.2 + 0.01 * (c + x + y) as f32);
    let part = |k: usize| truth.map(|v| v + 0.05 * ((k * 7919 % 13) as f32 - 6.0) / 6.0);
    let reference =
        Reference::from_parts((0..8).map(part).collect(), 8, noisefloor_frame::Sampling::LowDiscrepancy)
            .unwrap();
    let measurer = Measurer::new(&reference, None).unwrap();
    let mut test = truth.map(|v| 1.1 * v);
    test.set(1, 3, 2, f32::NAN);
    let squared = measurer.squared_errors(&test).unwrap();
    assert_eq!(squared.iter().filter(|v| v.is_nan()).count(), 3, "all channels of the pixel");
    let kept: Vec<f64> = squared.into_iter().filter(|v| v.is_finite()).collect();
    let mean = kept.iter().sum::<f64>() / kept.len() as f64;
    let mse = measurer.measure(&test).unwrap().values["mse"].unwrap();
    assert!((mean / mse - 1.0).abs() < 1e-12, "{mean} against {mse}");
    assert!(measurer.squared_errors(&Image::new(2, 2, 3)).is_err());
}
