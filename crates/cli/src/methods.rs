//! `noisefloor methods`.

use noisefloor_denoiser::{Entry, Guarded, Need};
use serde_json::{Map, Value, json};

use crate::args::List;
use crate::context::Context;

pub fn run(context: &Context, args: &List) -> anyhow::Result<()> {
    let entries = context.registry.entries();
    if args.json {
        let list: Vec<Value> = entries.iter().map(|entry| describe(context, entry)).collect();
        println!("{}", serde_json::to_string_pretty(&list)?);
        return Ok(());
    }
    for entry in entries {
        let card = context.registry.build(entry.id, &Map::new())?.denoiser.card();
        println!(
            "{}\n  {}\n  source: {} ({})",
            entry.id, entry.summary, card.citation.text, card.citation.key
        );
        let needs: Vec<String> = card.needs.iter().map(Need::to_string).collect();
        println!(
            "  needs: {}",
            if needs.is_empty() { "nothing but the colour".into() } else { needs.join(", ") }
        );
        let defaults = (entry.defaults)();
        let rows: Vec<Vec<String>> = entry
            .params
            .iter()
            .map(|p| {
                vec![format!("    {} = {}", p.name, defaults[p.name]), format!("[{}]  {}", p.range, p.about)]
            })
            .collect();
        // Left-aligned second column: pad the first only.
        let width = rows.iter().map(|r| r[0].chars().count()).max().unwrap_or(0);
        for row in rows {
            println!("{:width$}  {}", row[0], row[1]);
        }
        println!();
    }
    println!("guarded(ID)\n  any method, projected into the confidence interval of the input mean");
    let (guard, level) = (Guarded::PARAM, Guarded::DEFAULT_LEVEL.confidence());
    println!("    {} = {level}  [{}]  {}", guard.name, guard.range, guard.about);
    Ok(())
}

fn describe(context: &Context, entry: &Entry) -> Value {
    let card = context.registry.build(entry.id, &Map::new()).map(|m| m.denoiser.card());
    let strings = |needs: &[Need]| needs.iter().map(Need::to_string).collect::<Vec<_>>();
    let defaults = (entry.defaults)();
    let params: Vec<Value> = entry
        .params
        .iter()
        .map(|p| json!({"name": p.name, "default": defaults[p.name], "range": p.range, "about": p.about}))
        .collect();
    let mut object = json!({"id": entry.id, "summary": entry.summary, "params": params});
    if let Ok(card) = card {
        object["name"] = card.name.into();
        object["citation"] = json!({"key": card.citation.key, "text": card.citation.text});
        object["needs"] = strings(&card.needs).into();
        object["uses"] = strings(&card.uses).into();
        object["bounds"] = card.claims.error_bound.iter().map(|c| c.name).collect::<Vec<_>>().into();
        object["consistent"] = card.claims.consistent.into();
        object["notes"] = card.notes.into();
    }
    object
}
