//! Frames that a faulty renderer would give: consistent in themselves, and wrong.

use std::collections::BTreeMap;
use std::sync::Mutex;

use noisefloor_frame::{Frame, Image, Reference, Variance};
use noisefloor_harness::{Laboratory, Passing};
use noisefloor_questions::{checks, failed_checks};
use noisefloor_study::check::CheckKind;
use noisefloor_study::summary::Summary;

use super::planted::{SMALL, first_screen, measured, named, silent};

fn through(passing: &dyn Passing) -> Summary {
    measured(SMALL, Laboratory { passing: Some(passing), ..Laboratory::default() })
}

fn scale_variance(frame: &mut Frame, factor: f32) {
    let stated = frame.color.variance.take().map(Variance::into_mean_variance);
    frame.color.variance = stated.map(|image| Variance::of_mean(image.map(|v| factor * v)));
}

fn samples(frame: &Frame) -> f32 {
    frame.samples.total().mean() as f32
}

/// What happens to every frame.
struct Every<F>(F);

impl<F: Fn(&mut Frame) + Sync> Passing for Every<F> {
    fn frame(&self, _: &str, _: u32, _: u32, frame: &mut Frame) {
        (self.0)(frame);
    }
}

/// Spreads the halves about their mean, which they keep.
fn spread_halves(frame: &mut Frame) {
    let mean = frame.color.mean.clone();
    for half in frame.color.halves.iter_mut().flatten() {
        for (half, mean) in half.data_mut().iter_mut().zip(mean.data()) {
            *half = mean + std::f32::consts::SQRT_2 * (*half - mean);
        }
    }
}

#[test]
fn c_halves_that_spread_twice_as_much_as_the_variance_says_are_named_on_every_scene() {
    let summary = through(&Every(spread_halves));
    for scene in ["direct", "steps", "normal (instrument)"] {
        for spp in [4, 16] {
            let found = named(&summary, CheckKind::Halves, scene, spp, 10.0).record.found.unwrap();
            assert!((found.value - 2.0).abs() < 0.3, "{found:?}");
        }
    }
    silent(&summary, &[CheckKind::Normal, CheckKind::Brightness, CheckKind::ClosedForm]);
}

#[test]
fn d_the_variance_of_one_sample_for_that_of_the_mean_is_named_by_halves_and_coverage() {
    let summary = through(&Every(|frame: &mut Frame| {
        let n = samples(frame);
        scale_variance(frame, n);
    }));
    for spp in [4, 16] {
        named(&summary, CheckKind::Normal, "normal (instrument)", spp, 20.0);
        for scene in ["direct", "steps", "normal (instrument)"] {
            let found = named(&summary, CheckKind::Halves, scene, spp, 8.0).record.found.unwrap();
            assert!((found.value * f64::from(spp) - 1.0).abs() < 0.3, "{found:?}");
        }
    }
}

#[test]
fn d_prime_a_variance_divided_once_too_often_is_named_by_halves_and_coverage() {
    let summary = through(&Every(|frame: &mut Frame| {
        let n = samples(frame);
        scale_variance(frame, (n - 1.0) / n);
    }));
    for spp in [4, 16] {
        named(&summary, CheckKind::Normal, "normal (instrument)", spp, 5.0);
        let found = named(&summary, CheckKind::Halves, "steps", spp, 4.0).record.found.unwrap();
        let n = f64::from(spp);
        assert!((found.value / (n / (n - 1.0)) - 1.0).abs() < 0.1, "{found:?}");
    }
}

fn brighten(image: &mut Image, factor: f32) {
    *image = image.map(|v| factor * v);
}

/// Scales the colour and its statistics as brighter samples would.
fn brighten_frame(frame: &mut Frame, factor: f32) {
    brighten(&mut frame.color.mean, factor);
    frame.color.halves.iter_mut().flatten().for_each(|half| brighten(half, factor));
    scale_variance(frame, factor * factor);
}

const BRIGHTER: f32 = 1.01;

struct Renderer {
    references_too: bool,
}

impl Passing for Renderer {
    fn frame(&self, _: &str, _: u32, _: u32, frame: &mut Frame) {
        brighten_frame(frame, BRIGHTER);
    }

    fn reference(&self, _: &str, reference: &mut Reference) {
        if self.references_too {
            brighten_frame(&mut reference.frame, BRIGHTER);
            reference.parts.iter_mut().for_each(|part| brighten(part, BRIGHTER));
        }
    }
}

#[test]
fn e_a_renderer_that_is_too_bright_everywhere_is_named_where_a_formula_knows_better() {
    let summary = through(&Renderer { references_too: true });
    for (spp, least) in [(4, 4.0), (16, 8.0)] {
        let scene = "furnace (instrument)";
        let found = named(&summary, CheckKind::ClosedForm, scene, spp, least).record.found.unwrap();
        // By 1 %, and five standard errors of a mean that is known that well.
        let off = found.value / found.expected - f64::from(BRIGHTER);
        assert!(off.abs() < 5.0 * 0.01 / least, "{found:?}");
    }
    // Frames agree with their references.
    silent(&summary, &[CheckKind::Brightness, CheckKind::Halves, CheckKind::Normal]);
}

#[test]
fn e_prime_frames_that_are_brighter_than_their_reference_are_named() {
    let summary = through(&Renderer { references_too: false });
    for (scene, spp) in [("steps", 16), ("normal (instrument)", 16), ("furnace (instrument)", 4)] {
        let found = named(&summary, CheckKind::Brightness, scene, spp, 4.0).record.found.unwrap();
        assert!(found.value > 1.005, "{found:?}");
    }
    named(&summary, CheckKind::ClosedForm, "furnace (instrument)", 4, 4.0);
    silent(&summary, &[CheckKind::Halves]);
}

/// Replicate 1 of the study's scenes is replicate 0's frame.
#[derive(Default)]
struct Twins(Mutex<BTreeMap<(String, u32), Frame>>);

impl Passing for Twins {
    fn frame(&self, scene: &str, spp: u32, replicate: u32, frame: &mut Frame) {
        if !["direct", "steps"].contains(&scene) {
            return;
        }
        let mut first = self.0.lock().unwrap();
        match replicate {
            0 => drop(first.insert((scene.to_owned(), spp), frame.clone())),
            1 => frame.clone_from(&first[&(scene.to_owned(), spp)]),
            _ => (),
        }
    }
}

#[test]
fn i_two_replicates_that_are_one_frame_are_named_without_any_doubt() {
    let summary = through(&Twins::default());
    let failed: Vec<_> = checks(&summary).into_iter().filter(|check| check.failed).collect();
    for scene in ["direct", "steps"] {
        let of_scene = failed.iter().filter(|check| check.record.scene.contains(scene));
        let equal: Vec<_> = of_scene.filter(|check| check.record.kind == CheckKind::Dependence).collect();
        for spp in [4, 16] {
            let both = format!("{spp} spp, replicate 0 and {spp} spp, replicate 1");
            assert!(equal.iter().any(|check| check.record.scene.contains(&both)), "{spp} {equal:?}");
        }
        assert!(equal.iter().all(|check| check.adjusted == Some(0.0)), "{equal:?}");
    }
    let text = failed_checks(&summary).join("\n");
    assert!(text.contains("replicate 0") && text.contains("replicate 1"), "{text}");
    let on_screen = first_screen(&summary).sentences;
    assert!(on_screen.iter().any(|text| text.starts_with("I5")), "{on_screen:?}");
}
