use std::collections::BTreeMap;

use noisefloor_study::format;
use noisefloor_study::summary::{Environment, ReferenceSummary, SceneSummary};
use serde_json::Value;

/// Program, machine and load.
pub(super) fn environment(e: &Environment) -> Vec<(String, String)> {
    let facts = [
        ("Program", format!("noisefloor {}", e.version)),
        ("Build", e.profile.clone()),
        ("Processor", e.cpu.clone()),
        ("Logical processors", e.logical_cpus.to_string()),
        ("Threads used", e.threads.to_string()),
        ("Instruction set", e.simd.clone()),
        ("Platform", e.platform.clone()),
        ("Load at start", e.load_at_start.map_or_else(String::new, |load| format::significant(load, 2))),
        ("Date", e.date.clone()),
    ];
    told(facts)
}

/// Named values without the empty ones.
fn told<const N: usize>(facts: [(&str, String); N]) -> Vec<(String, String)> {
    facts.into_iter().filter(|(_, value)| !value.is_empty()).map(|(name, v)| (name.to_owned(), v)).collect()
}

/// Size, replicates, settings and pixel classes of a scene.
pub(super) fn scene(s: &SceneSummary) -> Vec<(String, String)> {
    let mut facts = vec![
        ("Size".to_owned(), format!("{}×{} pixels", s.width, s.height)),
        ("Replicates".to_owned(), replicates(&s.replicates)),
    ];
    facts.extend(s.settings.iter().map(|(name, value)| (name.clone(), value.clone())));
    if !s.classes.is_empty() {
        let all = f64::from(s.width) * f64::from(s.height);
        let share =
            |(class, n): (&String, &u64)| format!("{class} {}", format::percent(*n as f64 / all.max(1.0)));
        let classes: Vec<String> = s.classes.iter().map(share).collect();
        facts.push(("Pixel classes".into(), classes.join(" · ")));
    }
    facts
}

/// `4` or, if they differ, `8 at 4 spp, 4 at 512 spp`.
fn replicates(by_spp: &BTreeMap<u32, u32>) -> String {
    let mut counts: Vec<u32> = by_spp.values().copied().collect();
    counts.dedup();
    match counts.as_slice() {
        [] => "none".into(),
        [one] => one.to_string(),
        _ => by_spp.iter().map(|(spp, n)| format!("{n} at {spp} spp")).collect::<Vec<_>>().join(", "),
    }
}

/// What stands for the truth.
pub(super) fn reference(r: &ReferenceSummary) -> Vec<(String, String)> {
    let samples = match r.spp {
        _ if r.is_exact() => "none: exact truth".into(),
        0 => "unknown".into(),
        spp => {
            let ratio = format::ratio(r.ratio_to_top);
            let ratio = ratio.trim_end_matches('0').trim_end_matches('.');
            let short = match r.long_enough {
                true => "",
                false => " (fewer than the 16 that the coverage correction assumes)",
            };
            format!("{spp}, {ratio} times the top level{short}")
        }
    };
    let figure = |(id, v): (&String, &f64)| format!("{id} {}", format::significant(*v, 2));
    let floor: Vec<String> = r.floor.iter().map(figure).collect();
    let share = |(id, v): (&String, &f64)| format!("{id} at most {}", format::percent(*v));
    let bias: Vec<String> = r.bias.iter().map(share).collect();
    told([
        ("Samples per pixel", samples),
        ("Independent parts", if r.parts > 0 { r.parts.to_string() } else { String::new() }),
        ("Sampling", r.sampling.clone()),
        ("Its noise", r.correction.clone()),
        ("Floor (its standard error)", floor.join(" · ")),
        (
            "Bias by it, taken out of relative metrics",
            if bias.is_empty() { String::new() } else { format!("{} of a value", bias.join(" · ")) },
        ),
    ])
}

/// Parameters by dotted name, values as they stand in a study file.
pub(super) fn parameters(params: &Value) -> Vec<(String, String)> {
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
