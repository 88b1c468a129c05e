//! What the measuring gives on a fixed pair of images: numbers of two definitions of a metric are never mixed.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

use noisefloor_denoiser::Claim;
use noisefloor_frame::{Frame, Image, Reference, Sampling, Statistic};
use noisefloor_metrics::{Classes, Measurer, Metric, MetricError, block_bootstrap};
use noisefloor_stats::{IntervalFamily, Level, ShapeError, students_t};
use noisefloor_study::{Bits, Key, key_of};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticError, SyntheticScene};
use serde_json::{Value, json};

use crate::cell::{Measure, MeasureError, PixelClasses};
use crate::error::{BOOTSTRAP_IMAGES, ratio_within_se};
use crate::intervals::of_family;
use crate::level::{LevelCell, LevelFrame, Outputs};
use crate::list::{QUESTIONS, measure_level};

/// Hash of all that the measuring of a cell gives on a fixed frame, output and truth, for each way in which a truth states
/// its noise: metrics, their standard errors, classes, coverage, bounds, enclosures, estimates of error.
pub fn measuring() -> &'static str {
    static MEASURING: OnceLock<Key> = OnceLock::new();
    MEASURING.get_or_init(|| {
        // Nothing here can fail but for a mistake in this file, which its test would show.
        everything().map_or_else(|error| format!("none: {error}"), |all| key_of(&all))
    })
}

/// Hash of all that the measuring of a level gives on two fixed frames and their outputs, for each way in which a truth
/// states its noise.
pub fn measuring_of_levels() -> &'static str {
    static MEASURING: OnceLock<Key> = OnceLock::new();
    MEASURING.get_or_init(|| levels().map_or_else(|error| format!("none: {error}"), |all| key_of(&all)))
}

fn levels() -> Result<Value, Wrong> {
    let (frame, image, references) = fixed()?;
    let mut other = frame.clone();
    other.color.mean = other.color.mean.map(|v| 1.01 * v);
    let frames = [(0, frame), (1, other)];
    let frames = frames.map(|(replicate, frame)| LevelFrame { replicate, frame, invalid: Vec::new() });
    let rows = [noisefloor_study::BASELINE.to_owned(), "row".to_owned()];
    let outputs = |label: &str| -> Outputs {
        let of = |f: &LevelFrame| (f.replicate, f.frame.color.mean.clone());
        let filtered = |k: u32| (k, image.map(|v| v + 0.01 * k as f32));
        if label == rows[0] { frames.iter().map(of).collect() } else { (0..2).map(filtered).collect() }
    };
    let study = noisefloor_study::Study::plain("fixed".into(), vec![8], Vec::new(), Vec::new());
    let mut out = Vec::new();
    for reference in &references {
        let classes = PixelClasses::from_reference(reference);
        let level = LevelCell {
            study: &study,
            scene: "fixed",
            spp: 8,
            reference_spp: 256,
            known_mean: Some(1.0),
            reference,
            classes: &classes,
            frames: &frames,
            intervals: students_t(),
            rows: &rows,
            outputs: &outputs,
        };
        let found = measure_level(QUESTIONS, &level)?;
        let mut bits = Bits::of("maps");
        for map in &found.maps {
            bits.text(&map.label);
            bits.text(&map.name);
            bits.image(&map.image);
        }
        out.push(json!([found.answers, bits.finish()]));
    }
    Ok(json!(out))
}

/// The same for a family of intervals that is measured on request alone: what it covers, and its widths.
pub fn measuring_of_intervals(family: &'static dyn IntervalFamily) -> Key {
    static KNOWN: Known = Mutex::new(BTreeMap::new());
    remembered(&KNOWN, family.id(), || {
        let statistics = [Statistic::ThirdMoment, Statistic::Least, Statistic::Greatest];
        let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), SampleLaw::Exponential, 24, 18)?;
        let frame = scene.clone().with_guides(Guides::None).render_with(6, 1, &statistics);
        let truth = scene.truth();
        let classes = PixelClasses::from_reference(&truth);
        let measure = Measure::new(&frame, &truth, &classes, &[], false);
        let Some(observed) = measure.intervals() else { return Ok(Value::Null) };
        Ok(json!(of_family(&measure, family, &observed, &[0.8, 0.95])?))
    })
}

/// The same for a metric that is measured on request alone: its numbers, those of classes and its spread.
pub fn measuring_of(metric: &'static Metric) -> Key {
    static KNOWN: Known = Mutex::new(BTreeMap::new());
    remembered(&KNOWN, metric.id, || numbers_of(metric))
}

/// Hashes by the id of what was measured.
type Known = Mutex<BTreeMap<&'static str, Key>>;

/// The hash of this id, made once.
fn remembered(known: &Known, id: &'static str, numbers: impl FnOnce() -> Result<Value, Wrong>) -> Key {
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    let key = || numbers().map_or_else(|error| format!("{id}: {error}"), |numbers| key_of(&numbers));
    known.entry(id).or_insert_with(key).clone()
}

fn numbers_of(metric: &'static Metric) -> Result<Value, Wrong> {
    let (_, image, references) = fixed()?;
    let of_reference = |reference: &Reference| {
        let classes = PixelClasses::from_reference(reference);
        let map = Classes { names: &classes.names, of_pixel: &classes.of_pixel };
        let measurer = Measurer::new(reference, Some(map))?.with(&[metric]);
        let measured = measurer.measure(&image)?;
        let in_classes: Vec<Option<f64>> =
            measured.classes.values().map(|values| values[metric.id]).collect();
        let spread = block_bootstrap(&measurer, &image, BOOTSTRAP_IMAGES, 1)?;
        Ok(json!([measured.values[metric.id], in_classes, spread.get(metric.id)]))
    };
    let numbers: Result<Vec<Value>, Wrong> = references.iter().map(of_reference).collect();
    Ok(json!(numbers?))
}

#[derive(Debug, thiserror::Error)]
enum Wrong {
    #[error(transparent)]
    Scene(#[from] SyntheticError),
    #[error(transparent)]
    Frame(#[from] noisefloor_frame::FrameError),
    #[error(transparent)]
    Metric(#[from] MetricError),
    #[error(transparent)]
    Shape(#[from] ShapeError),
    #[error(transparent)]
    Measure(#[from] MeasureError),
}

fn everything() -> Result<Value, Wrong> {
    let (frame, image, references) = fixed()?;
    let measured: Result<Vec<Value>, Wrong> =
        references.iter().map(|reference| against(reference, &frame, &image)).collect();
    Ok(json!(measured?))
}

/// A frame, an image made from it, and truths that state their noise in every way.
fn fixed() -> Result<(Frame, Image, [Reference; 4]), Wrong> {
    let law = SampleLaw::Gaussian { sd: 0.3, relative: false };
    // More than one block of the bootstrap in both directions.
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 70, 50)?.with_guides(Guides::None);
    let frame = scene.render(8, 1);
    let parts = (0..8).map(|part| scene.render(32, 100 + part).color.mean).collect();
    let in_parts = Reference::from_parts(parts, 32, Sampling::LowDiscrepancy)?;
    let mut varied = in_parts.clone();
    (varied.frame.color.halves, varied.parts) = (None, Vec::new());
    let mut silent = varied.clone();
    silent.frame.color.variance = None;
    let mut image = frame.color.mean.map(|v| 0.9 * v + 0.02);
    // Values that are not finite, on an edge of the image and inside.
    for (value, at) in [(f32::NAN, 3), (f32::INFINITY, 1801), (f32::NEG_INFINITY, 5000)] {
        image.data_mut()[at] = value;
    }
    Ok((frame, image, [scene.truth(), in_parts, varied, silent]))
}

fn against(reference: &Reference, frame: &Frame, image: &Image) -> Result<Value, Wrong> {
    let mut bits = Bits::of("reference");
    bits.frame(&reference.frame);
    let classes = PixelClasses::from_reference(reference);
    let map = Classes { names: &classes.names, of_pixel: &classes.of_pixel };
    let measurer = Measurer::new(reference, Some(map))?;
    let measured = measurer.measure(image)?;
    let squared = measurer.squared_errors(image)?;
    let estimate = image.map(|v| 0.01 * v);
    let level = Level::TWO_SIDED_95;
    let claims = [Claim { name: "claim".into(), terms: vec![(1.5, level)], level, proven: true }];
    let invalid: Vec<bool> = (0..frame.pixels()).map(|pixel| pixel % 97 == 5).collect();
    let measure = Measure::new(frame, reference, &classes, &invalid, true);
    Ok(json!({
        "reference": bits.finish(),
        "classes of pixels": [json!(classes.names), json!(classes.of_pixel)],
        "values": measured.values,
        "classes": measured.classes,
        "reference_se": measured.reference_se,
        "non-finite": measured.non_finite_values,
        "pixels": measured.pixels,
        "floor": measurer.floor(),
        "influences": measured.reference,
        "influences in classes": measured.class_reference,
        "bootstrap": block_bootstrap(&measurer, image, BOOTSTRAP_IMAGES, 1)?,
        "ratio": ratio_within_se(image, &frame.color.mean, reference)?,
        "estimate": measure.estimate(&estimate, &squared),
        "coverage": measure.coverage(&[0.95, 0.998])?,
        "bounds": measure.bounds(image, &claims)?,
        "enclosures": measure.enclosures(image, &claims)?,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_of_the_measuring_holds_every_number_of_a_record() {
        let all = everything().unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(measuring(), key_of(&all));

        for (index, of_reference) in all.as_array().unwrap().iter().enumerate() {
            for (name, found) in of_reference.as_object().unwrap() {
                // The exact truth has no noise of its own, one that states none has none to tell.
                let of_noise = ["reference_se", "floor", "influences", "influences in classes"];
                let none = matches!(index, 0 | 3) && of_noise.contains(&name.as_str());
                let empty = found.is_null()
                    || found.as_array().is_some_and(Vec::is_empty)
                    || found.as_object().is_some_and(serde_json::Map::is_empty);
                assert!(!empty || none, "{index}: {name} is {found}");
            }
            for metric in noisefloor_metrics::METRICS {
                assert!(of_reference["values"][metric.id].is_number(), "{index}: {}", metric.id);
            }
        }
    }

    #[test]
    fn a_metric_on_request_has_a_fingerprint_of_its_own_and_leaves_the_others() {
        use noisefloor_metrics::{Metric, Rule, add, metric};
        let before = everything().unwrap_or_else(|e| panic!("{e}"));
        let rules =
            [("one", Rule::Over(|_, _| Some(1.0))), ("pixels", Rule::Over(|_, of| Some(of.len() as f64)))];
        let [one, pixels] = rules.map(|(id, rule)| {
            add(Metric::new(id, id, "for a test", rule)).unwrap();
            measuring_of(metric(id).unwrap())
        });
        assert_ne!(one, pixels);
        assert_eq!(key_of(&everything().unwrap()), key_of(&before));
    }

    #[test]
    fn every_family_of_intervals_has_a_fingerprint_of_its_own() {
        let all: std::collections::BTreeSet<Key> =
            noisefloor_stats::FAMILIES.iter().map(|family| measuring_of_intervals(*family)).collect();
        assert_eq!(all.len(), noisefloor_stats::FAMILIES.len());
        assert!(all.iter().all(|key| key.len() == 32), "{all:?}");
    }

    #[test]
    fn another_number_anywhere_is_another_fingerprint() {
        let all = everything().unwrap_or_else(|e| panic!("{e}"));
        let mut other = all.clone();
        let value = other[1]["values"]["relmse"].as_f64().unwrap();
        other[1]["values"]["relmse"] = json!(f64::from_bits(value.to_bits() ^ 1));
        assert_ne!(key_of(&other), key_of(&all));
    }
}
