use noisefloor_frame::Reference;
use noisefloor_inputs::{Against, Brightness, Mean, among};

use crate::common::{LAWS, REFERENCE_SPP, found, reference, scene};

#[test]
fn sound_frames_of_every_law_are_silent() {
    let (mut frames, mut alarms) = (0, Vec::new());
    for law in LAWS {
        let scene = scene(law, 64, 48);
        let long = reference(&scene);
        let exact = scene.truth();
        for spp in [2, 4, 16, 64] {
            for seed in 0..12 {
                for (name, truth) in [("reference", &long), ("truth", &exact)] {
                    frames += 1;
                    let mut frame = scene.render(spp, seed);
                    if seed % 3 == 1 {
                        frame.color.halves = None;
                    }
                    if seed % 3 == 2 {
                        frame.color.variance = None;
                        frame.color.halves = None;
                    }
                    for finding in found(truth, &frame) {
                        alarms.push(format!("{law:?} {spp} spp seed {seed} {name}: {finding}"));
                    }
                }
            }
        }
    }
    assert!(alarms.is_empty(), "{} of {frames}:\n{}", alarms.len(), alarms.join("\n"));
}

#[test]
fn the_frames_of_a_sound_scene_are_independent_and_as_bright_as_their_reference() {
    for law in LAWS {
        let scene = scene(law, 64, 48);
        let (long, exact) = (reference(&scene), scene.truth());
        for halves in [true, false] {
            for truth in [&long, &exact] {
                let against = Against::new(truth, Some(REFERENCE_SPP));
                let mut sketches = Vec::new();
                for (spp, seed) in [(4, 1), (4, 2), (16, 3), (16, 4), (64, 5), (64, 6)] {
                    let mut frame = scene.render(spp, seed);
                    if !halves {
                        frame.color.halves = None;
                    }
                    let check = against.frame(&frame, &[], Mean::OfTheReference);
                    sketches.push((format!("{spp} spp, seed {seed}"), check.sketch));
                }
                let found = among(&against, &sketches);
                assert!(found.is_empty(), "{law:?} {halves} {found:?}");
            }
        }
    }
}

#[test]
fn where_bright_samples_are_too_few_the_check_says_so() {
    let scene = scene(noisefloor_synthetic::SampleLaw::Bernoulli { q: 0.002, bright: 1.0 }, 64, 48);
    let told = |truth: &Reference| {
        Against::new(truth, None).frame(&scene.render(4, 1), &[], Mean::OfTheReference).brightness
    };
    assert!(matches!(told(&scene.truth()), Brightness::TooFew { .. }), "{:?}", told(&scene.truth()));
    let frame = scene.render(4, 1);
    let biased = Against::new(&scene.truth(), None).frame(&frame, &[], Mean::Biased).brightness;
    assert_eq!(biased, Brightness::NotTested);
}
