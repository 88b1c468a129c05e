//! The guard with families of intervals other than Student's t.

use noisefloor_frame::{Frame, Image, Optional, Statistic};
use noisefloor_stats::{FAMILIES, Level, family};
use serde_json::{Map, json};

use super::{Fixed, frame, knobs, overrides, row};
use crate::*;

/// A frame that has what any family of intervals asks for.
fn with_statistics(mut f: Frame) -> Frame {
    let mean = f.color.mean.clone();
    let recorded = [
        (Statistic::ThirdMoment, mean.map(|_| 0.4)),
        (Statistic::Least, mean.map(|v| v - 1.0)),
        (Statistic::Greatest, Image::from_fn(4, 1, 3, |_, x, _| mean.get(0, x, 0) + 1.0 + x as f32)),
    ];
    let recorded = recorded.map(|(statistic, image)| (statistic, vec![image])).to_vec();
    f.optional = Optional::new(recorded, None, vec![]).unwrap();
    f
}

#[test]
fn guard_stays_in_the_interval_of_whatever_family_and_states_its_length() {
    let f = with_statistics(frame(row([1.0, 2.0, 0.0, 5.0]), 0.04, 8));
    let wild = row([40.0, -30.0, f32::NAN, 5.1]);
    let planes = sample_planes(&f).unwrap();
    for family in FAMILIES {
        let guarded = Guarded::new(Box::new(Fixed(wild.clone())), Level::TWO_SIDED_95).with_interval(*family);
        let output = guarded.denoise(&Input::new(&f)).unwrap();
        let ends = family.intervals(&planes, Level::TWO_SIDED_95).unwrap().unwrap();
        for (i, value) in output.image.data().iter().enumerate() {
            let (low, high, value) = (ends.low[i] as f32, ends.high[i] as f32, *value);
            assert!((low - 1e-6..=high + 1e-6).contains(&value), "{}: {value}", family.id());
            match wild.data()[i] {
                v if v.is_nan() => assert_eq!(value, f.color.mean.data()[i]),
                v if v > high => assert!((value - high).abs() < 1e-6),
                v if v < low => assert!((value - low).abs() < 1e-6),
                v => assert_eq!(value, v),
            }
        }
        let card = guarded.card();
        assert_eq!(card.claims.consistent, family.has_both_ends());
        if family.id() == "t" {
            assert_eq!(card.claims.error_bound[0].name, "Theorem 3.1");
            assert!(output.bounds.is_empty());
        } else {
            assert!(card.claims.error_bound.is_empty() && card.claims.enclosure.is_empty());
            assert!(card.notes.iter().any(|note| note.contains(&format!("`{}`", family.id()))));
            assert_eq!(output.bounds.len(), usize::from(family.has_both_ends()));
        }
        for bound in &output.bounds {
            assert_eq!(bound.level, Level::TWO_SIDED_95);
            assert!(bound.name.contains(family.id()));
            let lengths = ends.low.iter().zip(&ends.high).map(|(low, high)| (high - low) as f32);
            assert!(bound.half_width.data().iter().copied().eq(lengths));
        }
    }
}

#[test]
fn guard_by_t_is_the_default_in_every_bit_and_every_key() {
    let registry = Registry::new([mc(), knobs()]);
    let f = with_statistics(frame(row([1.0, -3.0, 0.1, 7.0]), 0.3, 5));
    let plain = registry.build("guarded(mc)", &Map::new()).unwrap();
    let named = registry.build("guarded(mc)", &overrides(json!({ "guard_interval": "t" }))).unwrap();
    assert_eq!(plain.params, json!({ "guard_level": 0.99 }));
    assert_eq!(named.params, plain.params);
    assert_eq!(named.denoiser.card(), plain.denoiser.card());
    let run = |method: &Method| method.denoiser.denoise(&Input::new(&f)).unwrap();
    assert_eq!(run(&named), run(&plain));
    let other = registry.build("guarded(mc)", &overrides(json!({ "guard_interval": "hall" }))).unwrap();
    assert_eq!(other.params, json!({ "guard_level": 0.99, "guard_interval": "hall" }));
    for (method, bad) in [("guarded(mc)", json!("student")), ("guarded(knobs)", json!(1))] {
        let error = registry.build(method, &overrides(json!({ "guard_interval": bad }))).unwrap_err();
        assert!(error.to_string().contains("t | normal | johnson | hall"), "{error}");
    }
    let error = registry.build("guarded(mc)", &overrides(json!({ "guard_intervall": "t" }))).unwrap_err();
    assert!(error.to_string().contains("guard_interval (t | "), "{error}");
}

#[test]
fn guard_refuses_a_frame_without_the_statistics_of_its_family_and_says_how_to_get_them() {
    let bare = frame(row([1.0; 4]), 0.1, 4);
    let guarded = |id: &str| {
        Guarded::new(Box::new(Fixed(row([1.0; 4]))), Level::TWO_SIDED_99).with_interval(family(id).unwrap())
    };
    let error = guarded("hall").denoise(&Input::new(&bare)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "guarded(fixed) needs third moment of the samples: `statistics = [\"third-moment\"]`"
    );
    let error = guarded("rare-event-t").denoise(&Input::new(&bare)).unwrap_err();
    assert!(error.to_string().contains("`statistics = [\"least\", \"greatest\"]`"), "{error}");
    assert!(matches!(error, DenoiseError::MissingInputs { ref missing, .. } if *missing == [Need::Extremes]));
    // Two samples have no third moment.
    let two = with_statistics(frame(row([1.0; 4]), 0.1, 2));
    let error = guarded("johnson").denoise(&Input::new(&two)).unwrap_err();
    assert_eq!(error.to_string(), "guarded(fixed) needs at least 3 samples in every pixel");
    assert!(guarded("pooled-t").denoise(&Input::new(&bare)).is_ok());
}
