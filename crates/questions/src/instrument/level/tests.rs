use noisefloor_frame::{Estimate, Frame, Image, Samples, Variance};
use noisefloor_stats::students_t;
use noisefloor_study::Study;
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

use super::*;
use crate::cell::PixelClasses;

const SIZE: (usize, usize) = (24, 18);

fn checks(frames: Vec<Frame>, reference: &Reference, known_mean: Option<f64>) -> Vec<CheckRecord> {
    checks_in(frames, reference, known_mean, &PixelClasses::from_reference(reference))
}

fn checks_in(
    frames: Vec<Frame>,
    reference: &Reference,
    known_mean: Option<f64>,
    classes: &PixelClasses,
) -> Vec<CheckRecord> {
    let study = Study::plain("checked".into(), vec![8], Vec::new(), Vec::new());
    let of = |(replicate, frame)| LevelFrame { replicate, frame, invalid: Vec::new() };
    let frames: Vec<LevelFrame> = (0..).zip(frames).map(of).collect();
    let level = LevelCell {
        study: &study,
        scene: "here",
        spp: 8,
        reference,
        reference_spp: 0,
        known_mean,
        classes,
        frames: &frames,
        intervals: students_t(),
        rows: &[],
        outputs: &|_| Vec::new(),
    };
    let mut found = LevelFound::default();
    measure(&level, &mut found).unwrap();
    found.answers.get(ID).map_or_else(Vec::new, |value| serde_json::from_value(value.clone()).unwrap())
}

fn scene(law: SampleLaw) -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(ImageKind::Edges), law, SIZE.0, SIZE.1).unwrap()
}

const NORMAL: SampleLaw = SampleLaw::Gaussian { sd: 0.3, relative: false };

fn kinds(checks: &[CheckRecord]) -> Vec<CheckKind> {
    checks.iter().map(|check| check.kind).collect()
}

#[test]
fn sound_frames_of_an_exact_image_pass_by_their_halves_and_their_brightness() {
    let scene = scene(NORMAL);
    let found = checks((0..4).map(|seed| scene.render(8, seed)).collect(), &scene.truth(), None);
    // An exact reference has no halves to be independent of.
    assert_eq!(kinds(&found), [CheckKind::Halves, CheckKind::Brightness]);
    for check in &found {
        assert!(check.found.unwrap().p > 1e-4 && check.spp == Some(8) && check.scene == "here", "{check:?}");
    }
}

#[test]
fn halves_of_dependent_samples_state_nothing_and_a_missing_half_checks_nothing() {
    let scene = scene(NORMAL);
    let mut dependent = scene.render(8, 1);
    dependent.sampling = Sampling::LowDiscrepancy;
    let of_dependent = checks(vec![dependent], &scene.truth(), None);
    assert_eq!(kinds(&of_dependent), [CheckKind::Halves, CheckKind::Brightness]);
    assert!(of_dependent[0].found.is_none() && of_dependent[0].note.contains("not independent"));
    let mut whole = scene.render(8, 1);
    whole.color.halves = None;
    let of_whole = checks(vec![whole], &scene.truth(), None);
    assert_eq!(of_whole[0].note, "not made: frames have no half buffers");
    assert!(of_whole[0].found.is_none() && of_whole[1].found.is_some(), "{of_whole:?}");
    assert_eq!(checks(Vec::new(), &scene.truth(), None), []);
}

#[test]
fn light_that_few_samples_meet_is_told_as_no_evidence() {
    let scene = scene(SampleLaw::Bernoulli { q: 0.001, bright: 1.0 });
    let found = checks(vec![scene.render(8, 1)], &scene.truth(), None);
    assert_eq!(kinds(&found), [CheckKind::Halves, CheckKind::Brightness]);
    for check in &found {
        assert!(check.found.is_none() && check.note == TOO_FEW, "{check:?}");
    }
}

#[test]
fn a_reference_in_parts_is_held_against_the_frames_for_shared_samples() {
    let scene = scene(NORMAL);
    let parts = |first: Image| {
        let others = (1..8).map(|seed| scene.render(8, 100 + seed).color.mean);
        let parts = std::iter::once(first).chain(others).collect();
        Reference::from_parts(parts, 8, Sampling::Independent).unwrap()
    };
    let frame = scene.render(8, 1);
    let p_of = |reference: &Reference| {
        let found = checks(vec![frame.clone()], reference, None);
        found.iter().find(|check| check.kind == CheckKind::Dependence).unwrap().found.unwrap().p
    };
    assert!(p_of(&parts(scene.render(8, 100).color.mean)) > 1e-4);
    assert!(p_of(&parts(frame.color.mean.clone())) < 1e-4, "a part is the frame");
}

#[test]
fn classes_that_a_sampled_reference_chose_take_no_part() {
    let scene = scene(NORMAL);
    let parts = (0..8).map(|seed| scene.render(8, 100 + seed).color.mean).collect();
    let sampled = Reference::from_parts(parts, 8, Sampling::Independent).unwrap();
    let truth = scene.truth();
    // As edges are, though more so: pixels at which the reference came out too dark.
    let dark = (0..SIZE.0 * SIZE.1).map(|p| grey(&sampled, p) < grey(&truth, p)).collect();
    let classes = PixelClasses::from_masks(&[("dark", dark)], &sampled);
    let p_of = |reference: &Reference| {
        let found = checks_in((0..4).map(|seed| scene.render(8, seed)).collect(), reference, None, &classes);
        found.iter().find(|check| check.kind == CheckKind::Brightness).unwrap().found.unwrap().p
    };
    assert!(p_of(&sampled) > 1e-3);
    // Frames that are too bright in one class of an exact image and too dark in the others are told by it alone.
    let brighter = |seed| {
        let mut frame = scene.render(8, seed);
        for (i, value) in frame.color.mean.data_mut().iter_mut().enumerate() {
            *value += if classes.of_pixel[i % (SIZE.0 * SIZE.1)] == 0 { 0.02 } else { -0.02 };
        }
        frame
    };
    let found = checks_in((0..4).map(brighter).collect(), &truth, None, &classes);
    assert!(found[1].found.unwrap().p < 1e-3, "{found:?}");
}

#[test]
fn a_block_that_is_too_bright_is_told_on_an_exact_image() {
    let scene = scene(NORMAL);
    let brighter = |seed| {
        let mut frame = scene.render(8, seed);
        for (i, value) in frame.color.mean.data_mut().iter_mut().enumerate() {
            let pixel = i % (SIZE.0 * SIZE.1);
            // One block of 8×8 pixels brighter, another darker.
            let (x, y) = (pixel % SIZE.0, pixel / SIZE.0);
            *value += if y < 8 && x < 8 {
                0.05
            } else if y < 8 && x < 16 {
                -0.05
            } else {
                0.0
            };
        }
        frame
    };
    let found = checks((0..4).map(brighter).collect(), &scene.truth(), None);
    assert!(found[1].found.unwrap().p < 1e-6, "{found:?}");
}

/// A frame of one value everywhere, with a variance or none.
fn constant(value: f32, variance: Option<f32>) -> Frame {
    let image = |v: f32| Image::filled(SIZE.0, SIZE.1, 3, v);
    let variance = variance.map(|v| Variance::of_mean(image(v)));
    let color = Estimate { mean: image(value), variance, halves: None };
    Frame::from_color(color, Samples::uniform(8), Sampling::Independent)
}

#[test]
fn a_known_image_is_compared_by_its_mean_with_channels_that_err_alike() {
    let truth = Reference::exact(Image::filled(SIZE.0, SIZE.1, 3, 2.0));
    let closed = |frames: Vec<Frame>| {
        let found = checks(frames, &truth, Some(2.0));
        found.into_iter().find(|check| check.kind == CheckKind::ClosedForm).unwrap().found.unwrap()
    };
    let found = closed(vec![constant(2.25, Some(0.01)), constant(2.0, Some(0.01))]);
    // Standard deviation of a pixel 0.1, the same in all channels, over √(2·432) pixels.
    let se = 0.1 / (2.0 * (SIZE.0 * SIZE.1) as f64).sqrt();
    assert_eq!((found.value, found.expected), (2.125, 2.0));
    assert!((found.z / (0.125 / se) - 1.0).abs() < 1e-5, "{found:?}");
    // Without noise the mean is known to the rounding of single precision.
    assert_eq!(closed(vec![constant(2.0, None)]).z, 0.0);
    let found = closed(vec![constant(2.0 + 2e-5, None)]);
    assert!(found.z > 9.0 && found.z < 11.0, "{found:?}");
}
