use super::*;
use crate::Level;
use crate::interval::mean_and_variance;
use crate::random::Normals;

/// Images of `replicates` and a reference in `parts` parts per half, of normal numbers.
struct Made {
    images: Vec<Vec<f32>>,
    parts: [Vec<Vec<f32>>; 2],
    halves: [Vec<f32>; 2],
    mean: Vec<f32>,
}

/// Bias, standard deviation of a replicate, and standard deviation of the reference's mean.
#[derive(Clone, Copy)]
struct Law {
    bias: f64,
    sigma: f64,
    noise: f64,
}

fn images(normals: &mut Normals, law: Law, replicates: usize, pixels: usize) -> Vec<Vec<f32>> {
    let value = |normals: &mut Normals| (1.0 + law.bias + law.sigma * normals.next()) as f32;
    (0..replicates).map(|_| (0..pixels).map(|_| value(normals)).collect()).collect()
}

fn made(normals: &mut Normals, law: Law, replicates: usize, per_half: usize, pixels: usize) -> Made {
    let images = images(normals, law, replicates, pixels);
    let sd = law.noise * (2.0 * per_half as f64).sqrt();
    let mut half = || -> Vec<Vec<f32>> {
        let part = |normals: &mut Normals| (0..pixels).map(|_| (1.0 + sd * normals.next()) as f32).collect();
        (0..per_half).map(|_| part(normals)).collect()
    };
    let parts = [half(), half()];
    let average = |parts: &[Vec<f32>]| -> Vec<f32> {
        (0..pixels)
            .map(|p| (parts.iter().map(|x| f64::from(x[p])).sum::<f64>() / parts.len() as f64) as f32)
            .collect()
    };
    let halves = [average(&parts[0]), average(&parts[1])];
    let mean = halves[0].iter().zip(&halves[1]).map(|(a, b)| 0.5 * (a + b)).collect();
    Made { images, parts, halves, mean }
}

fn split(made: &Made, pixels: usize, weight: Option<&[f64]>) -> BiasVariance {
    let images: Vec<&[f32]> = made.images.iter().map(Vec::as_slice).collect();
    let parts: [Vec<&[f32]>; 2] = made.parts.each_ref().map(|p| p.iter().map(Vec::as_slice).collect());
    let noise = ReferenceNoise::Halves {
        halves: made.halves.each_ref().map(Vec::as_slice),
        parts: parts.each_ref().map(Vec::as_slice),
    };
    let replicates = Replicates { images: &images, pixels, valid: None, weight };
    bias_variance(&replicates, &BiasReference { mean: &made.mean, noise }, None).unwrap()
}

fn total(found: &BiasVariance) -> &BiasVarianceTotal {
    found.totals[0].as_ref().unwrap()
}

#[test]
fn squared_bias_and_variance_add_up_to_the_mean_squared_error() {
    let mut normals = Normals::new(1);
    let law = Law { bias: 0.2, sigma: 0.3, noise: 0.1 };
    let made = made(&mut normals, law, 5, 3, 30);
    let weight: Vec<f64> = made.mean.iter().map(|&r| 1.0 / (f64::from(r).max(0.0).powi(2) + 0.01)).collect();
    let found = split(&made, 10, Some(&weight));
    let product = |d: &[f32], i: usize| {
        (f64::from(d[i]) - f64::from(made.halves[0][i])) * (f64::from(d[i]) - f64::from(made.halves[1][i]))
    };
    let mut sum = 0.0;
    for (i, w) in weight.iter().enumerate() {
        let slow = made.images.iter().map(|d| product(d, i)).sum::<f64>() / 5.0;
        let squared = found.maps.squared_bias.as_ref().unwrap()[i] + found.maps.variance[i];
        assert!((squared - slow).abs() < 1e-14, "{squared} {slow}");
        sum += w * slow / 30.0;
    }
    let mse = total(&found).mse.as_ref().unwrap();
    assert!((mse.value - sum).abs() < 1e-13);
    // The jackknife of a mean, from the images alone.
    let errors: Vec<f64> =
        made.images.iter().map(|d| (0..30).map(|i| weight[i] * product(d, i)).sum::<f64>() / 30.0).collect();
    let (_, variance) = mean_and_variance(&errors).unwrap();
    assert!((mse.replicate_error.unwrap() - (variance / 5.0).sqrt()).abs() < 1e-13);
}

#[test]
fn closed_forms_are_the_jackknife_that_deletes_images() {
    let mut normals = Normals::new(2);
    let mut made = made(&mut normals, Law { bias: 0.1, sigma: 0.3, noise: 0.1 }, 6, 2, 12);
    let all = split(&made, 12, None);
    let images = std::mem::take(&mut made.images);
    let (mut biases, mut variances) = (Vec::new(), Vec::new());
    for deleted in 0..6 {
        made.images =
            images.iter().enumerate().filter(|(r, _)| *r != deleted).map(|(_, d)| d.clone()).collect();
        let found = split(&made, 12, None);
        biases.push(total(&found).squared_bias.as_ref().unwrap().value);
        variances.push(total(&found).variance.value);
    }
    let slow = |values: &[f64]| (mean_and_variance(values).unwrap().1 * 25.0 / 6.0).sqrt();
    let own = total(&all).squared_bias.as_ref().unwrap().replicate_error.unwrap();
    assert!((own / slow(&biases) - 1.0).abs() < 1e-9, "{own} {}", slow(&biases));
    let own = total(&all).variance.replicate_error.unwrap();
    assert!((own / slow(&variances) - 1.0).abs() < 1e-9);
}

/// Stated variance over replicates against the actual one, of bias, squared bias, variance, error; and whether the
/// estimates are unbiased.
fn over_replicates(law: Law, replicates: usize, expected: [f64; 4]) {
    let (pixels, draws) = (40, 3000);
    let mut normals = Normals::new(17);
    let fixed = made(&mut normals, law, 0, 2, pixels);
    let mut values: [Vec<f64>; 4] = Default::default();
    let mut stated = [0.0; 4];
    for _ in 0..draws {
        let images = images(&mut normals, law, replicates, pixels);
        let made = Made {
            images,
            parts: fixed.parts.clone(),
            halves: fixed.halves.clone(),
            mean: fixed.mean.clone(),
        };
        let found = split(&made, pixels, None);
        let t = total(&found);
        let all = [&t.bias, t.squared_bias.as_ref().unwrap(), &t.variance, t.mse.as_ref().unwrap()];
        for (k, one) in all.into_iter().enumerate() {
            values[k].push(one.value);
            stated[k] += one.replicate_error.unwrap().powi(2) / f64::from(draws);
        }
    }
    for k in 0..4 {
        let (_, actual) = mean_and_variance(&values[k]).unwrap();
        let ratio = stated[k] / actual / expected[k];
        // An empirical variance has a relative standard error of √(2/draws) = 0.026; a stated one, of R−1 degrees of freedom,
        // at most 0.026.
        assert!((ratio - 1.0).abs() < 4.0 * 0.037, "{k}: {ratio}");
    }
}

#[test]
fn jackknifed_errors_over_replicates_are_the_spread_where_bias_exceeds_noise() {
    // Against a nearly exact reference: what is linear in each replicate is all of B̂²; V̂ of normal values by (R−1)/(R−2).
    let law = Law { bias: 0.5, sigma: 0.05, noise: 1e-4 };
    over_replicates(law, 4, [1.0, 1.0, 1.5, 1.0]);
    over_replicates(law, 8, [1.0, 1.0, 7.0 / 6.0, 1.0]);
}

#[test]
fn jackknifed_errors_without_bias_are_too_large_by_what_the_documentation_says() {
    let law = Law { bias: 0.0, sigma: 0.3, noise: 1e-4 };
    over_replicates(law, 4, [1.0, 3.0, 1.5, 1.0]);
    over_replicates(law, 8, [1.0, 14.0 / 6.0, 7.0 / 6.0, 1.0]);
}

#[test]
fn estimates_are_unbiased_however_noisy_the_reference() {
    let law = Law { bias: 0.1, sigma: 0.3, noise: 0.4 };
    let mut normals = Normals::new(23);
    let mut values: [Vec<f64>; 4] = Default::default();
    for _ in 0..3000 {
        let made = made(&mut normals, law, 3, 2, 20);
        let found = split(&made, 20, None);
        let t = total(&found);
        let all = [&t.bias, t.squared_bias.as_ref().unwrap(), &t.variance, t.mse.as_ref().unwrap()];
        all.iter().zip(&mut values).for_each(|(one, list)| list.push(one.value));
    }
    for (list, truth) in values.iter().zip([0.1, 0.01, 0.09, 0.1]) {
        let (mean, variance) = mean_and_variance(list).unwrap();
        let mcse = (variance / list.len() as f64).sqrt();
        assert!((mean - truth).abs() < 4.0 * mcse && mcse < 0.01, "{mean} for {truth} ± {mcse}");
    }
}

#[test]
fn the_references_share_is_the_spread_over_references() {
    // The images stay; 3 parts per half, as noisy as the bias is large.
    let law = Law { bias: 0.1, sigma: 0.02, noise: 0.05 };
    let mut normals = Normals::new(31);
    let fixed = images(&mut normals, law, 3, 60);
    let draws = 2500;
    let mut values: [Vec<f64>; 3] = Default::default();
    let mut stated = [0.0; 3];
    for _ in 0..draws {
        let made = Made { images: fixed.clone(), ..made(&mut normals, law, 0, 3, 60) };
        let found = split(&made, 60, None);
        let t = total(&found);
        for (k, one) in
            [&t.bias, t.squared_bias.as_ref().unwrap(), t.mse.as_ref().unwrap()].into_iter().enumerate()
        {
            values[k].push(one.value);
            stated[k] += one.reference.standard_error.powi(2) / f64::from(draws);
        }
        assert_eq!(t.variance.reference.standard_error, 0.0);
    }
    for k in 0..3 {
        let (_, actual) = mean_and_variance(&values[k]).unwrap();
        let ratio = stated[k] / actual;
        // Relative standard errors √(2/2500) of the spread and √(2/4/2500) of what is stated.
        assert!((ratio - 1.0).abs() < 4.0 * 0.035, "{k}: {ratio}");
    }
}

#[test]
fn a_known_variance_is_subtracted_and_an_unknown_one_hides_the_bias() {
    let images: [&[f32]; 2] = [&[1.0, 3.0], &[3.0, 3.0]];
    let replicates = Replicates { images: &images, pixels: 2, valid: None, weight: None };
    let split =
        |noise| bias_variance(&replicates, &BiasReference { mean: &[1.0, 1.0], noise }, None).unwrap();
    // D̄ = 2, 3; V̂ = 2, 0.
    let exact = split(ReferenceNoise::Exact);
    assert_eq!(exact.maps.squared_bias, Some(vec![0.0, 4.0]));
    assert_eq!((exact.maps.bias, exact.maps.variance), (vec![1.0, 2.0], vec![2.0, 0.0]));
    let known = split(ReferenceNoise::Variance(&[0.5, 0.5]));
    assert_eq!(known.maps.squared_bias, Some(vec![-0.5, 3.5]));
    let t = total(&known);
    assert_eq!((t.variance.value, t.mse.as_ref().unwrap().value), (1.0, 2.5));
    assert_eq!(t.squared_bias.as_ref().unwrap().standard_error(), None, "two replicates");
    assert_eq!(t.squared_bias.as_ref().unwrap().interval(Level::TWO_SIDED_95).low, None);
    let unknown = split(ReferenceNoise::Unknown);
    assert_eq!((&unknown.maps.squared_bias, unknown.maps.variance.as_slice()), (&None, &[2.0, 0.0][..]));
    assert!(total(&unknown).mse.is_none());
}

#[test]
fn a_large_bias_does_not_swallow_a_small_variance() {
    let images: [&[f32]; 3] = [&[1000.0], &[1000.0001], &[1000.0002]];
    let replicates = Replicates { images: &images, pixels: 1, valid: None, weight: None };
    let reference = BiasReference { mean: &[0.0], noise: ReferenceNoise::Exact };
    let found = bias_variance(&replicates, &reference, None).unwrap();
    let step = f64::from(images[1][0]) - 1000.0;
    let other = f64::from(images[2][0]) - 1000.0;
    let exact = (step * step + other * other + (other - step).powi(2)) / 6.0;
    assert!((total(&found).variance.value / exact - 1.0).abs() < 1e-6);
}

#[test]
fn groups_weights_and_unknown_pixels_are_kept_apart() {
    let images: [&[f32]; 3] = [&[1.0, 2.0, 4.0, 5.0], &[2.0, 2.0, f32::NAN, 5.0], &[3.0, 2.0, 4.0, 5.0]];
    let replicates = Replicates {
        images: &images,
        pixels: 4,
        valid: Some(&[true, true, true, false]),
        weight: Some(&[4.0, 1.0, 1.0, 1.0]),
    };
    let reference = BiasReference { mean: &[1.0; 4], noise: ReferenceNoise::Exact };
    let groups = Groups { of_pixel: &[0, 1, 1, 0], count: 3 };
    let found = bias_variance(&replicates, &reference, Some(groups)).unwrap();
    assert_eq!((found.left_out, found.totals.len()), (1, 4));
    let variances: Vec<_> = found.totals.iter().map(|t| t.as_ref().map(|t| t.variance.value)).collect();
    assert_eq!(variances, [Some(2.0), Some(4.0), Some(0.0), None]);
    assert_eq!(found.totals[1].as_ref().unwrap().bias.value, 2.0);
    assert!(found.maps.bias[2].is_nan() && found.maps.bias[3].is_nan() && found.maps.bias[1] == 1.0);
}

#[test]
fn images_that_do_not_belong_together_are_refused() {
    let one: [&[f32]; 1] = [&[1.0]];
    let reference = BiasReference { mean: &[1.0], noise: ReferenceNoise::Exact };
    let refuse = |images: &[&[f32]], reference: &BiasReference<'_>| {
        let replicates = Replicates { images, pixels: 1, valid: None, weight: None };
        bias_variance(&replicates, reference, None).unwrap_err().to_string()
    };
    assert_eq!(refuse(&one, &reference), "1 replicates, at least 2 are needed");
    let two: [&[f32]; 2] = [&[1.0], &[1.0]];
    let short = BiasReference { mean: &[1.0], noise: ReferenceNoise::Variance(&[]) };
    assert_eq!(refuse(&two, &short), "variance of the reference has 0 entries, expected 1");
}
