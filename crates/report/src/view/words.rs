//! Sentences and lists that several parts of the page use.

use std::collections::BTreeMap;

use noisefloor_harness::summary::{ReferenceSummary, Source, Summary};
use serde_json::Value;

use crate::format;

/// Where the intervals of this study come from.
pub(crate) fn uncertainty(summary: &Summary) -> String {
    let intervals = || summary.cells.iter().flat_map(|c| c.metrics.values());
    let level = intervals().map(|i| i.confidence).next().map_or_else(|| "95 %".into(), format::percent_short);
    let has = |source: Source| intervals().any(|i| i.source == source);
    let mut sentences = Vec::new();
    if has(Source::Replicates) {
        sentences.push(format!(
            "± is half the {level} confidence interval over independent replicates, with the reference's own noise added."
        ));
    }
    if has(Source::WithinImage) {
        sentences.push(format!(
            "± is half the {level} interval from a bootstrap over 32×32 pixel blocks, within one image: it says nothing \
             about other random seeds."
        ));
    }
    if has(Source::None) {
        sentences.push("Numbers without ± have no estimate of their uncertainty.".into());
    }
    if intervals().any(|i| i.below.is_some()) {
        sentences
            .push("“<” marks errors that the reference's noise hides: the number is an upper limit.".into());
    }
    sentences.join(" ")
}

/// `4, 16 and 64`.
pub(crate) fn levels(spp: &[u32]) -> String {
    format::list(&spp.iter().map(u32::to_string).collect::<Vec<_>>())
}

/// `4` or, if they differ, `8 at 4 spp, 4 at 512 spp`.
pub(crate) fn replicates(by_spp: &BTreeMap<u32, u32>) -> String {
    let mut counts: Vec<u32> = by_spp.values().copied().collect();
    counts.dedup();
    match counts.as_slice() {
        [] => "none".into(),
        [one] => one.to_string(),
        _ => by_spp.iter().map(|(spp, n)| format!("{n} at {spp} spp")).collect::<Vec<_>>().join(", "),
    }
}

/// Parameters by dotted name, values as they stand in a study file.
pub(crate) fn parameters(params: &Value) -> Vec<(String, String)> {
    let mut out = Vec::new();
    flatten(params, "", &mut out);
    out
}

fn flatten(value: &Value, name: &str, out: &mut Vec<(String, String)>) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                let name = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
                flatten(value, &name, out);
            }
        }
        Value::Null if name.is_empty() => {}
        Value::String(text) => out.push((name.to_owned(), text.clone())),
        other => out.push((name.to_owned(), other.to_string())),
    }
}

/// The reference in named facts.
pub(crate) fn reference(r: &ReferenceSummary) -> Vec<(String, String)> {
    let mut facts = Vec::new();
    let mut add = |name: &str, value: String| {
        if !value.is_empty() {
            facts.push((name.to_owned(), value));
        }
    };
    if r.is_exact() {
        add("Samples per pixel", "none: exact truth".into());
    } else if r.spp == 0 {
        add("Samples per pixel", "unknown".into());
    } else {
        let ratio = format::ratio(r.ratio_to_top);
        let ratio = ratio.trim_end_matches('0').trim_end_matches('.');
        let short =
            if r.long_enough { "" } else { " (fewer than the 16 that the coverage correction assumes)" };
        add("Samples per pixel", format!("{}, {ratio} times the top level{short}", r.spp));
    }
    if r.parts > 0 {
        add("Independent parts", r.parts.to_string());
    }
    add("Sampling", r.sampling.clone());
    add("Its noise", r.correction.clone());
    let figures = |map: &BTreeMap<String, f64>| {
        let items: Vec<String> =
            map.iter().map(|(id, v)| format!("{id} {}", format::significant(*v, 2))).collect();
        items.join(" · ")
    };
    let shares = |map: &BTreeMap<String, f64>| {
        let items: Vec<String> =
            map.iter().map(|(id, v)| format!("{id} at most {}", format::percent(*v))).collect();
        if items.is_empty() { String::new() } else { format!("{} of a value", items.join(" · ")) }
    };
    add("Floor (its standard error)", figures(&r.floor));
    add("Bias by it, taken out of relative metrics", shares(&r.bias));
    facts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_get_dotted_names() {
        let params = serde_json::json!({"steps": 2, "inner": {"id": "virtual-flash", "kappa": 2.0}});
        let names: Vec<String> = parameters(&params).into_iter().map(|(k, v)| format!("{k}={v}")).collect();
        assert_eq!(names, ["inner.id=virtual-flash", "inner.kappa=2.0", "steps=2"]);
        assert!(parameters(&Value::Null).is_empty());
    }

    #[test]
    fn replicates_that_differ_by_level_say_where() {
        assert_eq!(replicates(&BTreeMap::from([(4, 8), (16, 8)])), "8");
        assert_eq!(replicates(&BTreeMap::from([(4, 8), (512, 4)])), "8 at 4 spp, 4 at 512 spp");
    }
}
