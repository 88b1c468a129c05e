//! `noisefloor methods`.

use noisefloor_denoiser::{Entry, Guarded, Method, Need, ParamDoc};
use serde_json::{Map, Value, json};

use crate::args::List;
use crate::context::Context;
use crate::exit::{Exit, usage};
use crate::out::{Out, say};

pub fn run(context: &Context, args: &List) -> anyhow::Result<Exit> {
    if let Some(id) = &args.id {
        return one(context, id, args.json);
    }
    let entries = context.registry.entries();
    if args.json {
        let list: Vec<Value> = entries.iter().map(|entry| describe(context, entry)).collect();
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&list)?)?;
        return Ok(Exit::Done);
    }
    for entry in entries {
        let method = context.registry.build(entry.id, &Map::new())?;
        say!(Out::Stdout, "{}", text(entry, &method, false))?;
    }
    say!(Out::Stdout, "guarded(ID)\n  any method, projected into the confidence interval of the input mean")?;
    let guard =
        params(&[Guarded::PARAM], &json!({ Guarded::PARAM.name: Guarded::DEFAULT_LEVEL.confidence() }));
    Out::Stdout.text(guard)?;
    say!(Out::Stdout, "\n`noisefloor methods ID` shows one with its page")?;
    Ok(Exit::Done)
}

/// Everything about one method.
fn one(context: &Context, id: &str, as_json: bool) -> anyhow::Result<Exit> {
    let method = context.registry.build(id, &Map::new()).map_err(|error| usage(error.to_string()))?;
    let inner = id.trim_start_matches("guarded(").trim_end_matches(')');
    let Some(entry) = context.registry.entries().iter().find(|entry| entry.id == inner) else {
        return Err(usage(format!("there is no method `{inner}`")));
    };
    let page = noisefloor_registry::readme(entry);
    if as_json {
        let mut object = describe(context, entry);
        fill(&mut object, &method);
        object["id"] = id.into();
        object["readme"] = page.into();
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&object)?)?;
        return Ok(Exit::Done);
    }
    Out::Stdout.text(text(entry, &method, true))?;
    if let Some(page) = page {
        say!(Out::Stdout, "\n{}", page.trim_end())?;
    }
    Ok(Exit::Done)
}

/// Source, needs and parameters; in `full` also uses, claims and notes.
fn text(entry: &Entry, method: &Method, full: bool) -> String {
    let card = method.denoiser.card();
    let list = |needs: &[Need]| needs.iter().map(Need::to_string).collect::<Vec<_>>().join(", ");
    let or = |text: String, nothing: &str| if text.is_empty() { nothing.to_owned() } else { text };
    let mut out = format!(
        "{}\n  {}\n  source: {} ({})\n  needs: {}\n",
        method.id,
        entry.summary,
        card.citation.text,
        card.citation.key,
        or(list(&card.needs), "nothing but the colour")
    );
    if full {
        out.push_str(&format!("  uses, where the frame has it: {}\n", or(list(&card.uses), "nothing more")));
        let bounds: Vec<&str> = card.claims.error_bound.iter().map(|claim| claim.name).collect();
        let says = |yes: bool| if yes { "yes" } else { "no" };
        out.push_str(&format!(
            "  claims: error bound {}; consistent {}; estimates its own error {}\n",
            or(bounds.join(", "), "none"),
            says(card.claims.consistent),
            says(card.claims.estimates_error)
        ));
        for note in &card.notes {
            out.push_str(&format!("  note: {note}\n"));
        }
    }
    out.push_str(&params(entry.params, &method.params));
    if method.params.get(Guarded::PARAM.name).is_some() {
        out.push_str(&params(&[Guarded::PARAM], &method.params));
    }
    out
}

/// One line for each parameter, with its default.
fn params(docs: &[ParamDoc], defaults: &Value) -> String {
    let rows: Vec<[String; 2]> = docs
        .iter()
        .map(|p| {
            let default = defaults.get(p.name).unwrap_or(&Value::Null);
            [format!("    {} = {default}", p.name), format!("[{}]  {}", p.range, p.about)]
        })
        .collect();
    // Left-aligned second column: pad the first only.
    let width = rows.iter().map(|r| r[0].chars().count()).max().unwrap_or(0);
    rows.iter().map(|row| format!("{:width$}  {}\n", row[0], row[1])).collect()
}

fn describe(context: &Context, entry: &Entry) -> Value {
    let defaults = (entry.defaults)();
    let params: Vec<Value> = entry.params.iter().map(|p| param(p, &defaults)).collect();
    let mut object = json!({"id": entry.id, "summary": entry.summary, "params": params});
    if let Ok(method) = context.registry.build(entry.id, &Map::new()) {
        fill(&mut object, &method);
    }
    object
}

fn param(doc: &ParamDoc, defaults: &Value) -> Value {
    json!({"name": doc.name, "default": defaults.get(doc.name), "range": doc.range, "about": doc.about})
}

/// What a method's card and the combinators around it add.
fn fill(object: &mut Value, method: &Method) {
    let card = method.denoiser.card();
    let strings = |needs: &[Need]| needs.iter().map(Need::to_string).collect::<Vec<_>>();
    object["name"] = card.name.into();
    object["citation"] = json!({"key": card.citation.key, "text": card.citation.text});
    object["needs"] = strings(&card.needs).into();
    object["uses"] = strings(&card.uses).into();
    object["bounds"] = card.claims.error_bound.iter().map(|c| c.name).collect::<Vec<_>>().into();
    object["consistent"] = card.claims.consistent.into();
    object["notes"] = card.notes.into();
    if let (Some(params), Some(_)) = (object["params"].as_array_mut(), method.params.get(Guarded::PARAM.name))
    {
        params.push(param(&Guarded::PARAM, &method.params));
    }
}
