//! The hard cases are what their names say.

use noisefloor_frame::{FeatureId, Flash, Frame};
use noisefloor_synthetic::{HardCase, hard_case, hard_cases};

fn case(name: &str) -> HardCase {
    hard_case(name).unwrap_or_else(|| panic!("no case \"{name}\""))
}

fn variance(frame: &Frame) -> &[f32] {
    frame.color.variance.as_ref().unwrap().mean_variance().data()
}

#[test]
fn every_frame_fits_together_and_is_clean_after_sanitising() {
    let cases = hard_cases();
    for case in &cases {
        case.raw.check().unwrap_or_else(|e| panic!("{}: {e}", case.name));
        let (frame, _) = case.frame();
        let mut images = vec![&frame.color.mean];
        images.extend(frame.color.variance.iter().map(noisefloor_frame::Variance::mean_variance));
        images.extend(frame.color.halves.iter().flatten());
        images.extend(frame.features.values().map(|f| &f.mean));
        assert!(images.iter().all(|i| i.count_non_finite() == 0), "{}", case.name);
    }
    let mut names: Vec<&str> = cases.iter().map(|c| c.name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), cases.len());
}

#[test]
fn broken_values_are_really_there() {
    for (name, value) in [
        ("NaN in colour, variance, features and flash", f32::NAN),
        ("infinity in colour, variance, features and flash", f32::INFINITY),
        ("negative infinity in colour, variance, features and flash", f32::NEG_INFINITY),
    ] {
        let frame = case(name).raw;
        let has = |data: &[f32]| data.iter().any(|v| v.to_bits() == value.to_bits());
        assert!(has(frame.color.mean.data()) && has(variance(&frame)), "{name}");
        assert!(has(frame.features[&FeatureId::Depth].mean.data()), "{name}");
        let Some(Flash::Parts { base, .. }) = &frame.flash else { panic!("{name} has a flash") };
        assert!(has(base.mean.data()));
        assert!(case(name).frame().1.invalid_pixels > 10);
    }
    assert!(case("negative variances").frame().1.negative_variances > 10);
    assert!(case("negative radiance").raw.color.mean.data().iter().any(|&v| v < 0.0));
}

#[test]
fn cancellation_keeps_mean_and_variance() {
    let frame = case("mean a million, sample variance a thousandth").raw;
    // Samples near 1e6, where f32 values are 1/16 apart: the mean is right to one such step.
    assert!(frame.color.mean.data().iter().all(|&v| (v - 1e6).abs() <= 0.0625));
    let s2 =
        variance(&frame).iter().map(|&v| f64::from(v) * 16.0).sum::<f64>() / variance(&frame).len() as f64;
    // s² of 16 normal samples in 2880 pixel-channels: relative standard error √(2/15/2880) = 0.7 %.
    assert!((s2 / 0.0316f64.powi(2) - 1.0).abs() < 5.0 * 0.0068, "{s2}");
}

#[test]
fn special_frames_have_their_property() {
    assert!(case("one sample").raw.color.variance.is_none());
    assert_eq!(case("two samples").raw.samples.at(0), 2);
    assert!(variance(&case("zero variance everywhere").raw).iter().all(|&v| v == 0.0));
    let one = case("zero variance in one channel").raw;
    assert!(one.color.mean.plane(1).len() == 960 && variance(&one)[960..1920].iter().all(|&v| v == 0.0));
    assert!(variance(&one)[..960].iter().all(|&v| v > 0.0));
    let bright = case("fireflies a million times brighter").raw;
    assert!(bright.color.mean.data().iter().any(|&v| v > 1e5));
    let tiny = case("scale 1e-8").raw;
    assert!(
        tiny.color.mean.data().iter().all(|v| v.abs() < 1e-7) && variance(&tiny).iter().all(|&v| v > 0.0)
    );
    let missed = case("rare bright samples").raw;
    assert!(variance(&missed).iter().filter(|&&v| v == 0.0).count() > 1000);
    assert!(case("sample counts from 1 on").raw.samples.total().least() == 1);
    assert!(case("no flash").raw.flash.is_none() && case("colour only").raw.features.is_empty());
    assert!(hard_case("no such case").is_none());
}
