use super::*;
use crate::{Estimate, FeatureId, FindingKind, Samples, Sampling, Variance};

const N: u32 = 4;

/// A ramp with variances and halves that average to it.
fn frame(width: usize, height: usize) -> Frame {
    let mean = Image::from_fn(width, height, 3, |c, x, y| (c * 100 + y * 10 + x) as f32);
    let halves = Some([mean.map(|v| v + 0.5), mean.map(|v| v - 0.5)]);
    let variance = Some(Variance::of_mean(Image::filled(width, height, 3, 0.25)));
    Frame::from_color(Estimate { mean, variance, halves }, Samples::uniform(N), Sampling::Independent)
}

fn edit_variance(estimate: &mut Estimate, edit: impl FnOnce(&mut Image)) {
    let mut image = estimate.variance.take().unwrap().into_mean_variance();
    edit(&mut image);
    estimate.variance = Some(Variance::of_mean(image));
}

fn variances(estimate: &Estimate) -> &[f32] {
    estimate.variance.as_ref().unwrap().mean_variance().data()
}

fn kinds(hygiene: &Hygiene) -> Vec<FindingKind> {
    hygiene.findings.iter().map(|f| f.kind).collect()
}

#[test]
fn a_sound_frame_stays_bit_for_bit_and_gives_no_finding() {
    let mut f = frame(12, 9);
    f.features.insert(FeatureId::Albedo, f.color.clone());
    let before = f.clone();
    assert_eq!(f.sanitize().unwrap(), Hygiene::default());
    assert_eq!(f, before);
}

#[test]
fn invalid_pixels_are_counted_and_filled_from_their_ring() {
    let mut f = frame(3, 3);
    f.color.mean.set(1, 1, 1, f32::NAN);
    let report = f.sanitize().unwrap();
    assert_eq!((report.invalid_pixels, report.absent_pixels), (1, 0));
    // The ring around the centre of a linear ramp has the centre's value as its mean.
    assert_eq!(f.color.mean.get(1, 1, 1), 111.0);
    assert_eq!(f.color.mean.get(0, 1, 1), 11.0, "all channels of an invalid pixel are refilled");
    assert_eq!(kinds(&report), [FindingKind::InvalidPixels]);
    let mut output = f.color.mean.clone();
    report.mark_absent(&mut output);
    assert_eq!(output, f.color.mean, "one pixel in nine is part of the image");
    report.restore(&mut output);
    assert!(output.get(1, 1, 1).is_nan() && output.get(0, 1, 1) == 11.0, "as it was read");
    report.mark_invalid(&mut output);
    assert!(output.get(0, 1, 1).is_nan() && output.count_non_finite() == 3);
}

#[test]
fn a_colour_is_kept_whatever_its_variance_and_halves_hold() {
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
        let mut f = frame(20, 10);
        edit_variance(&mut f.color, |v| v.set(0, 3, 3, value));
        let before = f.color.mean.clone();
        let report = f.sanitize().unwrap();
        assert_eq!(f.color.mean, before);
        assert_eq!((report.invalid_pixels, report.unknown_variances), (0, 1));
        assert!(variances(&f.color).iter().all(|&v| v == 0.25), "filled from its neighbours");
        assert!(report.unknown[3 * 20 + 3] && report.unknown.iter().filter(|&&u| u).count() == 1);
        assert_eq!(report.negative_variances, usize::from(value < 0.0));
        // These means and variances could be half floats.
        let expected: &[FindingKind] = match value {
            f32::INFINITY => &[FindingKind::VarianceOverflow, FindingKind::UnknownVariance],
            _ if value < 0.0 => &[FindingKind::NegativeVariance],
            _ => &[FindingKind::UnknownVariance],
        };
        assert_eq!(kinds(&report), expected);
    }
}

#[test]
fn unknown_halves_are_made_up_so_that_they_average_to_the_mean() {
    let mut f = frame(20, 10);
    let [a, b] = f.color.halves.as_mut().unwrap();
    a.set(0, 2, 2, f32::NAN);
    b.set(1, 5, 5, f32::INFINITY);
    a.set(2, 7, 7, f32::NAN);
    b.set(2, 7, 7, f32::NAN);
    let before = f.color.mean.clone();
    let report = f.sanitize().unwrap();
    assert_eq!((f.color.mean == before, report.unknown_halves, report.invalid_pixels), (true, 4, 0));
    let [a, b] = f.color.halves.as_ref().unwrap();
    assert_eq!((a.get(0, 2, 2), b.get(1, 5, 5)), (22.5, 154.5), "what the other half leaves");
    assert_eq!((a.get(2, 7, 7), b.get(2, 7, 7)), (277.0, 277.0));
    assert_eq!(kinds(&report), [FindingKind::UnknownHalves]);
    assert_eq!(report.findings[0].value, Some(3.0));
}

#[test]
fn too_many_unknown_values_take_the_buffer_away_with_its_reason() {
    let mut f = frame(20, 10);
    edit_variance(&mut f.color, |v| v.data_mut().fill(f32::NAN));
    f.color.halves.as_mut().unwrap()[0].data_mut()[..300].fill(f32::NAN);
    let report = f.sanitize().unwrap();
    assert!(f.color.variance.is_none() && f.color.halves.is_none());
    assert_eq!(kinds(&report), [FindingKind::VarianceDropped, FindingKind::HalvesDropped]);
    assert!(report.findings[0].text.contains("600 are NaN"), "{}", report.findings[0]);
    assert!(report.unknown.is_empty());
    // A fifth is still filled.
    let mut f = frame(20, 10);
    edit_variance(&mut f.color, |v| v.data_mut().iter_mut().step_by(5).for_each(|v| *v = -1e-9));
    let report = f.sanitize().unwrap();
    assert_eq!((report.negative_variances, report.unknown_variances), (120, 120));
    assert!(variances(&f.color).iter().all(|&v| v == 0.25));
}

#[test]
fn an_infinite_variance_beside_half_floats_overflowed() {
    let mut f = frame(20, 10);
    edit_variance(&mut f.color, |v| v.data_mut().fill(f32::INFINITY));
    let report = f.sanitize().unwrap();
    assert_eq!(kinds(&report), [FindingKind::VarianceOverflow, FindingKind::VarianceDropped]);
    assert!(report.findings[1].text.contains("overflowed half precision"), "{}", report.findings[1]);
    let mut f = frame(20, 10);
    f.color.mean = f.color.mean.map(|v| v + 0.1);
    edit_variance(&mut f.color, |v| v.data_mut().fill(f32::INFINITY));
    assert_eq!(kinds(&f.sanitize().unwrap()), [FindingKind::VarianceDropped], "floats have no such limit");
}

#[test]
fn a_frame_without_a_valid_pixel_is_an_error() {
    let mut f = frame(2, 2);
    f.color.mean.plane_mut(1).fill(f32::INFINITY);
    assert_eq!(f.sanitize(), Err(FrameError::NoValidPixel { pixels: 4 }));
}

#[test]
fn many_invalid_pixels_and_the_depth_of_holes_are_no_part_of_the_image() {
    let mut f = frame(40, 10);
    f.color.mean.plane_mut(0).iter_mut().step_by(4).for_each(|v| *v = f32::NAN);
    let report = f.sanitize().unwrap();
    assert_eq!((report.invalid_pixels, report.absent_pixels), (100, 100));
    assert!(f.color.mean.count_non_finite() == 0, "methods that look across see numbers");
    let mut output = f.color.mean.clone();
    report.mark_absent(&mut output);
    assert_eq!(output.count_non_finite(), 300);
    // A hole of 19×19 in 100×100 pixels: what is more than 8 pixels from its rim.
    let mut f = frame(100, 100);
    for y in 40..59 {
        f.color.mean.plane_mut(0)[y * 100 + 40..][..19].fill(f32::NAN);
    }
    let report = f.sanitize().unwrap();
    assert_eq!((report.invalid_pixels, report.absent_pixels), (361, 9));
}

#[test]
fn infinite_depth_is_background_and_no_finding() {
    let mut f = frame(2, 1);
    let depth = Image::from_vec(2, 1, 1, vec![10.0, f32::INFINITY]).unwrap();
    f.features.insert(FeatureId::Depth, Estimate::from_mean(depth));
    let report = f.sanitize().unwrap();
    assert_eq!(report.invalid_feature_values, 1);
    assert_eq!(f.features[&FeatureId::Depth].mean.data(), [10.0, 11.0]);
    assert!(report.findings.is_empty());
}

#[test]
fn features_are_mended_or_dropped_and_each_is_told() {
    let mut f = frame(20, 10);
    let sound = f.color.clone();
    let mut nan = sound.clone();
    nan.mean.data_mut().fill(f32::NAN);
    f.features.insert(FeatureId::Albedo, nan);
    let mut some = sound.clone();
    some.mean.set(0, 4, 4, f32::NAN);
    edit_variance(&mut some, |v| v.data_mut()[..7].fill(-1.0));
    f.features.insert(FeatureId::Normal, some);
    let mut dark = sound.clone();
    edit_variance(&mut dark, |v| v.data_mut().fill(f32::NAN));
    f.features.insert(FeatureId::Direct, dark);
    let mut light = sound.clone();
    light.mean.data_mut().fill(f32::NAN);
    f.flash = Some(Flash::Parts { base: sound, light, covariance: None });
    let report = f.sanitize().unwrap();
    assert!(!f.features.contains_key(&FeatureId::Albedo) && f.flash.is_none(), "never silently zero");
    let normal = &f.features[&FeatureId::Normal];
    assert_eq!((normal.mean.get(0, 4, 4), normal.mean.get(1, 4, 4)), (0.0, 144.0));
    assert!(variances(normal).iter().all(|v| [0.0, 0.25].contains(v)));
    assert!(f.features[&FeatureId::Direct].variance.is_none());
    let told: Vec<(FindingKind, &str)> =
        report.findings.iter().map(|f| (f.kind, f.subject.as_str())).collect();
    let expected = [
        (FindingKind::NegativeVariance, "normal"),
        (FindingKind::VarianceDropped, "direct"),
        (FindingKind::InvalidFeature, "albedo"),
        (FindingKind::InvalidFeature, "normal"),
        (FindingKind::InvalidFeature, "flashLight"),
    ];
    assert_eq!(told, expected);
}
