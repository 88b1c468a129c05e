use noisefloor_metrics::Measurer;
use noisefloor_synthetic::{ImageKind, SampleLaw};

use super::super::answer::Known;
use super::*;
use crate::level::made::Made;

const LAW: SampleLaw = SampleLaw::Gaussian { sd: 0.3, relative: false };

fn answer(made: &Made) -> Answer {
    serde_json::from_value(made.measure(measure).answers.remove(ID).unwrap()).unwrap()
}

/// Mean over 3×3 pixels, around the edges.
fn blurred(image: &Image) -> Image {
    let (width, height) = (image.width(), image.height());
    Image::from_fn(width, height, 3, |c, x, y| {
        let at = |k: usize| image.get(c, (x + k % 3) % width, (y + k / 3) % height);
        (0..9).map(at).sum::<f32>() / 9.0
    })
}

#[test]
fn a_constant_that_a_row_adds_is_its_bias_with_its_sign() {
    let mut made = Made::of(ImageKind::Mixed, LAW, 48, 16, 4);
    made.rows = vec![("darker".into(), |image| image.map(|v| v - 0.05))];
    let [input, darker] = answer(&made).try_into().unwrap();
    assert_eq!((input.label.as_str(), darker.label.as_str()), ("mc", "darker"));
    let Known(bias, error, reference) = darker.plain.bias.unwrap();
    assert_eq!(reference, 0.0, "the truth is exact");
    // Of the mean over 48·48·3 values of 16 samples in 4 replicates.
    let expected = 0.3 / (48.0f64 * 48.0 * 3.0 * 16.0 * 4.0).sqrt();
    assert!((bias + 0.05).abs() < 5.0 * expected, "{bias}");
    assert!(error.unwrap() < 5.0 * expected && error.unwrap() > 0.0);
    let squared = darker.plain.squared_bias.unwrap();
    assert!((squared.0 - 0.0025).abs() < 5.0 * squared.1.unwrap() && squared.0 > 10.0 * squared.1.unwrap());
    let none = input.plain.squared_bias.unwrap();
    assert!(none.0.abs() < 5.0 * none.1.unwrap(), "{none:?}");
    assert!((darker.plain.variance.0 / input.plain.variance.0 - 1.0).abs() < 1e-5);
}

#[test]
fn the_mean_of_nine_pixels_has_a_ninth_of_the_variance() {
    let mut made = Made::of(ImageKind::Constant, LAW, 64, 16, 4);
    made.rows = vec![("blur".into(), blurred)];
    let [input, blur] = answer(&made).try_into().unwrap();
    // Squares of the blurred values of a channel are worth those of 1/4.46 as many independent ones: Σρ² over all lags.
    let tolerance = 4.0 * (2.0 * (1.0 + 4.46) / (64.0f64 * 64.0 * 3.0 * 3.0)).sqrt();
    let ratio = input.plain.variance.0 / blur.plain.variance.0;
    assert!((ratio / 9.0 - 1.0).abs() < tolerance, "{ratio}");
}

/// Mean over replicates of an error of the input, as the table of metrics has it.
fn mean_error(made: &Made, metric: &str) -> f64 {
    let measurer = Measurer::new(&made.reference, None).unwrap();
    let error = |image: &Image| measurer.measure(image).unwrap().values[metric].unwrap();
    made.frames.iter().map(|f| error(&f.frame.color.mean)).sum::<f64>() / made.frames.len() as f64
}

#[test]
fn parts_add_up_to_the_mean_error() {
    let exact = Made::of(ImageKind::Mixed, LAW, 32, 4, 3);
    let [input] = answer(&exact).try_into().unwrap();
    for (split, metric) in [(&input.plain, "mse"), (&input.relative, "relmse")] {
        let sum = split.squared_bias.unwrap().0 + split.variance.0;
        assert!((sum / mean_error(&exact, metric) - 1.0).abs() < 1e-5, "{metric}: {sum}");
    }
    let classes: Vec<&str> = input.classes.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(classes, ["edge", "flat"]);

    let sampled = exact.sampled(256);
    let [input] = answer(&sampled).try_into().unwrap();
    let Known(squared, error, reference) = input.plain.squared_bias.unwrap();
    let sum = squared + input.plain.variance.0;
    assert!((sum / mean_error(&sampled, "mse") - 1.0).abs() < 1e-5, "the same halves: {sum}");
    assert!(reference > 0.0 && error.unwrap() > 0.0, "both tell their part");
    assert!(squared.abs() < 5.0 * error.unwrap().hypot(reference));
}

#[test]
fn maps_are_few_and_show_where() {
    let mut made = Made::of(ImageKind::Mixed, LAW, 24, 16, 4);
    made.rows = vec![("darker".into(), |image| image.map(|v| v - 0.05))];
    // The left half of the reference is beyond every interval.
    let reference = made.reference.frame.color.mean.clone();
    made.reference.frame.color.mean =
        Image::from_fn(24, 24, 3, |c, x, y| reference.get(c, x, y) + if x < 12 { 2.0 } else { 0.0 });
    let maps = made.measure(measure).maps;
    let told: Vec<(&str, &str)> = maps.iter().map(|m| (m.label.as_str(), m.name.as_str())).collect();
    let bias = "bias, mean over replicates";
    assert_eq!(told, [("mc", bias), ("darker", bias), ("mc", "share of intervals that miss")]);
    let mean = |image: &Image, left: bool| {
        let half = |p: &usize| (p % 24 < 12) == left;
        (0..24 * 24).filter(half).map(|p| f64::from(image.plane(0)[p])).sum::<f64>() / 288.0
    };
    assert!((mean(&maps[0].image, true) + 2.0).abs() < 0.01 && mean(&maps[0].image, false).abs() < 0.01);
    assert!((mean(&maps[1].image, false) + 0.05).abs() < 0.01);
    assert_eq!(mean(&maps[2].image, true), 1.0);
    assert!(mean(&maps[2].image, false) < 0.15, "{}", mean(&maps[2].image, false));
    made.study.viewer_spp = vec![64];
    assert!(made.measure(measure).maps.is_empty(), "the viewer shows another level");
}

#[test]
fn one_replicate_has_no_variance() {
    let found = Made::of(ImageKind::Flats, LAW, 16, 4, 1).measure(measure);
    assert!(found.answers.is_empty() && found.maps.is_empty());
}
