//! `noisefloor check`.

use anyhow::bail;
use noisefloor_conformance::{Outcome, recipes};
use noisefloor_denoiser::Method;
use serde_json::{Map, json};

use crate::args::Check;
use crate::context::Context;
use crate::denoise::overrides;
use crate::exit::Exit;
use crate::out::{Out, note, say};

pub fn run(context: &Context, args: &Check) -> anyhow::Result<Exit> {
    let methods = methods(context, args)?;
    let (mut list, mut broken) = (Vec::new(), Vec::new());
    for method in &methods {
        if !args.json {
            say!(Out::Stdout, "{}", method.id)?;
        }
        let mut kept = true;
        let mut verdicts = Vec::new();
        for recipe in recipes() {
            let outcome = recipe.check(method.denoiser.as_ref());
            kept &= outcome.violation().is_none();
            if args.json {
                let (word, told) = (outcome.word(), outcome.to_string());
                verdicts
                    .push(json!({"recipe": recipe.id, "asks": recipe.asks, "verdict": word, "told": told}));
            } else {
                say!(Out::Stdout, "{}", line(recipe.id, recipe.asks, &outcome))?;
            }
        }
        list.push(json!({"id": method.id, "params": method.params, "conforms": kept, "recipes": verdicts}));
        if !kept {
            broken.push(method.id.as_str());
        }
    }
    if args.json {
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&list)?)?;
    }
    if broken.is_empty() {
        return Ok(Exit::Done);
    }
    bail!("{} of {} methods broke a recipe: {}", broken.len(), methods.len(), broken.join(", "))
}

/// What the recipe asks, and beside it what came of it; a broken one says how.
fn line(id: &str, asks: &str, outcome: &Outcome) -> String {
    let head = format!("  {:8}  {id:12}  ", outcome.word());
    match outcome {
        Outcome::Broken(violation) => format!("{head}{violation}; every method {asks}"),
        _ => format!("{head}{asks} ({outcome})"),
    }
}

/// The one that was asked for, or all that build without a setting.
fn methods(context: &Context, args: &Check) -> anyhow::Result<Vec<Method>> {
    if let Some(id) = &args.method {
        return Ok(vec![context.registry.build(id, &overrides(&args.set)?)?]);
    }
    let mut methods = Vec::new();
    for factory in context.registry.factories() {
        if factory.ready() {
            methods.push(context.registry.build(factory.id(), &Map::new())?);
        } else {
            note!("{} is left out: it needs a setting", factory.id());
        }
    }
    Ok(methods)
}
