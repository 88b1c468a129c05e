//! Every registered method, plain and guarded, with the settings that change which code runs, through every recipe of
//! `noisefloor_conformance`.

use std::collections::BTreeMap;

use noisefloor_conformance::{Outcome, change, check};
use noisefloor_denoiser::{Denoiser, Input, Registry};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

/// A method under test with what makes it.
struct Subject {
    label: String,
    denoiser: Box<dyn Denoiser>,
}

fn overrides(value: &Value) -> Map<String, Value> {
    value.as_object().cloned().unwrap_or_default()
}

/// Settings beyond the defaults that change which code runs.
fn settings(id: &str) -> Vec<Value> {
    let mut all = vec![json!({})];
    match id {
        "virtual-flash" => {
            all.extend(["color", "none"].map(|guide| json!({ "guide": guide })));
            all.extend(["per-channel", "luminance"].map(|test| json!({ "test": test, "guide": "none" })));
            all.extend(["raw", "propagated", "halves"].map(|spread| json!({ "second_spread": spread })));
            all.extend([
                json!({ "steps": 1 }),
                json!({ "steps": 1, "guide": "color", "test": "luminance" }),
                json!({ "second_spread": "halves", "test": "per-channel", "guide": "color" }),
                json!({ "second_spread": "propagated", "test": "luminance", "guide": "none" }),
                json!({ "second_spread": "halves", "test": "luminance", "guide": "color" }),
                json!({ "homogeneous": false }),
                json!({ "homogeneous": false, "guide": "none", "patch_radius_px": 0 }),
                json!({ "patch_radius_px": 3, "second_window_radius_px": 32, "guide_floor": 0.0 }),
            ]);
        }
        "geometric-corrected" => {
            all.extend(["sample-variance", "std-of-mean"].map(|spread| json!({ "spread": spread })));
            all.push(json!({ "material": "ids" }));
            all.push(json!({ "material": "off", "depth_test": false, "normal_test": false }));
            all.push(json!({ "floor_unit": "radiance", "luminance_floor": 0.01 }));
            all.extend(
                ["updated-mean", "previous-mean", "population"].map(|form| json!({ "variance_form": form })),
            );
        }
        // A guest like any other: the copy of its input. Nothing without a command.
        "command" if cfg!(unix) => all = vec![json!({ "run": "cp {color.pfm} {output.pfm}" })],
        "command" => all.clear(),
        "geometric-as-written" => {
            all.push(json!({ "visits_center": false, "normal_threshold": 1.0 }));
            // Without this test it has an answer for most frames.
            all.push(json!({ "normal_test": false }));
        }
        // Its profiles are run by its own tests.
        "nfor" => all.push(json!({ "depth": "scaled", "guide": "same-half", "feature_guide": "same-half" })),
        "rdfc" => all.push(json!({ "neighbors": 1 })),
        "dshl10" => {
            all.push(json!({ "demodulate": true }));
            all.push(json!({ "halve": "sigma", "color_from_level": 1 }));
        }
        _ => {}
    }
    all
}

fn build(registry: &Registry, id: &str, settings: &Value) -> Subject {
    let method = registry.build(id, &overrides(settings)).unwrap();
    Subject { label: format!("{id} {settings}"), denoiser: method.denoiser }
}

/// Every built-in method, plain and guarded, with its settings.
fn subjects() -> Vec<Subject> {
    let registry = noisefloor_registry::registry([]);
    let mut all = Vec::new();
    for factory in registry.factories() {
        for settings in settings(factory.id()) {
            all.push(build(&registry, factory.id(), &settings));
            all.push(build(&registry, &format!("guarded({})", factory.id()), &settings));
        }
    }
    all
}

#[test]
fn every_method_keeps_every_recipe_and_what_a_card_declares_is_seen() {
    let mut broken = Vec::new();
    // By method and recipe: the settings differ in what they show.
    let mut declared: BTreeMap<(String, &str), bool> = BTreeMap::new();
    let reports: Vec<_> =
        subjects().into_par_iter().map(|subject| (subject.label, check(subject.denoiser.as_ref()))).collect();
    for (label, report) in reports {
        if !report.conforms() {
            broken.push(format!("{label}\n{report}"));
        }
        for (recipe, outcome) in &report.outcomes {
            if let Outcome::Declared { seen, .. } = outcome {
                *declared.entry((report.method.clone(), recipe.id)).or_default() |= seen;
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    // What a program outside does is not known, and a copy of the input does nothing.
    let stale = declared.iter().filter(|((method, _), seen)| !**seen && !method.contains("command"));
    assert_eq!(stale.collect::<Vec<_>>(), [], "declared, and not to be seen");
}

#[test]
fn settings_in_radiance_scale_along_with_the_exposure() {
    let registry = noisefloor_registry::registry([]);
    let law = SampleLaw::LogNormal { sigma: 0.7 };
    let frame = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 23, 17).unwrap().render(16, 11);
    let floor = |k: f64| json!({ "floor_unit": "radiance", "luminance_floor": 0.01 * k });
    let error = |k: f64| json!({ "spread": "std-of-mean", "pixels_per_error": 5.0 / k });
    // Darker, the second would be out of range.
    let settings: [(i32, &dyn Fn(f64) -> Value); 3] = [(-13, &floor), (13, &floor), (13, &error)];
    for (exponent, settings) in settings {
        let k = 2f32.powi(exponent);
        let bright = change::exposed(&frame, k);
        for id in ["geometric-corrected", "guarded(geometric-corrected)"] {
            let run = |settings, frame| {
                let subject = build(&registry, id, &settings);
                subject.denoiser.denoise(&Input::new(frame)).unwrap().image
            };
            let expected = run(settings(1.0), &frame).map(|v| v * k);
            assert_eq!(run(settings(f64::from(k)), &bright), expected, "{id}, factor {k}");
        }
    }
}
