//! The comparison for programs.

use noisefloor_metrics::Measurer;
use serde_json::{Map, Value, json};

use super::Compared;
use crate::args::Compare;

/// One object for one image, an array of them for several.
pub fn describe(args: &Compare, measurer: &Measurer<'_>, all: &[Compared<'_>]) -> Value {
    let mut objects: Vec<Value> = all.iter().map(|one| object(args, measurer, one)).collect();
    if objects.len() == 1 { objects.remove(0) } else { objects.into() }
}

fn object(args: &Compare, measurer: &Measurer<'_>, one: &Compared<'_>) -> Value {
    let measured = &one.measured;
    let values: Map<String, Value> = measurer
        .metrics()
        .iter()
        .map(|m| (m.id.to_owned(), measured.values.get(m.id).copied().flatten().into()))
        .collect();
    let pixels: Map<String, Value> =
        measurer.metrics().iter().map(|m| (m.id.to_owned(), one.pixels(m.id).into())).collect();
    let mut object = json!({
        "test": one.path,
        "reference": args.reference,
        "metrics": values,
        "reference_standard_error": measured.reference_se,
        "reference_noise": measurer.correction(),
        "reference_bias_removed": one.bias(),
        "bias_correction": measurer.bias_correction(),
        "upper_limits": one.upper_limits(),
        "pixels": pixels,
        "pixels_in_image": one.image.pixels(),
        "non_finite_values": measured.non_finite_values,
        "findings": one.findings,
    });
    if let Some(map) = &one.map {
        object["map"] = json!({
            "path": map.path, "error": "relative", "scale": "viridis", "range": [0.0, map.top],
            "pixels_above_range": map.above, "non_finite_pixels": map.non_finite,
        });
    }
    object
}
