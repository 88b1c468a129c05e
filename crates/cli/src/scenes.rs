//! `noisefloor scenes`.

use serde_json::{Value, json};

use crate::args::List;

pub fn run(args: &List) -> anyhow::Result<()> {
    let mut list = Vec::new();
    for entry in noisefloor_scenes::builtin() {
        let scene = (entry.build)();
        let models = serde_json::to_value(scene.models())?;
        let records: Vec<&str> =
            noisefloor_render::available(&scene).into_iter().map(noisefloor_render::Quantity::name).collect();
        if args.json {
            list.push(json!({
                "id": entry.id, "title": scene.title, "about": entry.about, "models": models,
                "primitives": scene.primitives(), "records": records,
            }));
            continue;
        }
        let on: Vec<&str> = models
            .as_object()
            .into_iter()
            .flatten()
            .filter(|(_, on)| **on == Value::Bool(true))
            .map(|(name, _)| name.as_str())
            .collect();
        println!("{}\n  {}\n  models: {}", entry.id, entry.about, on.join(", ").replace('_', " "));
        println!("  records: colour, {}\n  primitives: {}\n", records.join(", "), scene.primitives());
    }
    if args.json {
        println!("{}", serde_json::to_string_pretty(&list)?);
    }
    Ok(())
}
