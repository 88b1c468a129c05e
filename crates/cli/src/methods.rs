//! `noisefloor methods`.

use std::collections::BTreeSet;

use noisefloor_denoiser::{Factory, Guarded, Method, MethodCard, Need, Param};
use serde_json::{Map, Value, json};

use crate::args::List;
use crate::context::Context;
use crate::exit::{Exit, usage};
use crate::out::{Out, say};

pub fn run(context: &Context, args: &List) -> anyhow::Result<Exit> {
    if args.bibtex {
        return bibtex(context, args.id.as_deref());
    }
    if let Some(id) = &args.id {
        return one(context, id, args.json);
    }
    let factories = context.registry.factories();
    if args.json {
        let list: Vec<Value> = factories.iter().map(|factory| describe(context, factory.as_ref())).collect();
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&list)?)?;
        return Ok(Exit::Done);
    }
    for factory in factories {
        let method = match factory.ready() {
            true => Some(context.registry.build(factory.id(), &Map::new())?),
            false => None,
        };
        say!(Out::Stdout, "{}", text(factory.as_ref(), method.as_ref(), false))?;
    }
    say!(Out::Stdout, "guarded(ID)\n  any method, projected into the confidence interval of the input mean")?;
    Out::Stdout.text(params(&Guarded::params(), &guards(&Value::Null)))?;
    say!(Out::Stdout, "\n`noisefloor methods ID` shows one with its page")?;
    Ok(Exit::Done)
}

/// The sources of all methods or of one, each once. What has no entry is a comment: BibTeX skips text between entries.
fn bibtex(context: &Context, id: Option<&str>) -> anyhow::Result<Exit> {
    let factories = match id {
        Some(id) => vec![find(context, id)?],
        None => context.registry.factories().iter().map(AsRef::as_ref).collect(),
    };
    let mut printed = BTreeSet::new();
    for factory in factories.into_iter().filter(|factory| factory.ready()) {
        let citation = context.registry.build(factory.id(), &Map::new())?.denoiser.card().citation;
        if printed.insert(citation.key.clone()) {
            let comment = || format!("% {}: {}\n", citation.key, citation.text.replace('@', " at "));
            Out::Stdout.text(citation.bibtex().unwrap_or_else(comment))?;
        }
    }
    Ok(Exit::Done)
}

/// The factory of a method's id, guarded or not.
fn find<'a>(context: &'a Context, id: &str) -> anyhow::Result<&'a dyn Factory> {
    let inner = id.trim_start_matches("guarded(").trim_end_matches(')');
    if let Some(factory) = context.registry.find(inner) {
        return Ok(factory);
    }
    // The registry knows which names are nearest.
    let unknown = context.registry.build(id, &Map::new()).map(|_| ());
    unknown.map_err(|error| usage(error.to_string()))?;
    Err(usage(format!("there is no method `{inner}`")))
}

/// Everything about one method.
fn one(context: &Context, id: &str, as_json: bool) -> anyhow::Result<Exit> {
    let factory = find(context, id)?;
    let method = match factory.ready() {
        true => Some(context.registry.build(id, &Map::new()).map_err(|error| usage(error.to_string()))?),
        false => None,
    };
    let page = factory.readme();
    if as_json {
        let mut object = describe(context, factory);
        if let Some(method) = &method {
            fill(&mut object, method);
        }
        object["id"] = id.into();
        object["readme"] = page.into();
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&object)?)?;
        return Ok(Exit::Done);
    }
    Out::Stdout.text(text(factory, method.as_ref(), true))?;
    if let Some(page) = page {
        say!(Out::Stdout, "\n{}", page.trim_end())?;
    }
    Ok(Exit::Done)
}

/// Source, needs and parameters; in `full` also uses, claims and notes. Without a method, which then needs a setting first,
/// what its factory knows.
fn text(factory: &dyn Factory, method: Option<&Method>, full: bool) -> String {
    let Some(method) = method else {
        let defaults = Value::Object(factory.defaults());
        let head = format!("{}\n  {}\n", factory.id(), factory.summary());
        return head + &params(factory.params(), &defaults);
    };
    let mut out = format!("{}\n  {}\n", method.id, factory.summary());
    out.push_str(&card(&method.denoiser.card(), full));
    out.push_str(&params(factory.params(), &method.params));
    if method.params.get(Guarded::PARAM).is_some() {
        out.push_str(&params(&Guarded::params(), &guards(&method.params)));
    }
    out
}

/// Source and needs; in `full` also uses, claims and notes.
fn card(card: &MethodCard, full: bool) -> String {
    let list = |needs: &[Need]| needs.iter().map(Need::to_string).collect::<Vec<_>>().join(", ");
    let or = |text: String, nothing: &str| if text.is_empty() { nothing.to_owned() } else { text };
    let mut out = format!(
        "  source: {} ({})\n  needs: {}\n",
        card.citation.text,
        card.citation.key,
        or(list(&card.needs), "nothing but the colour")
    );
    if full {
        out.push_str(&format!("  uses, where the frame has it: {}\n", or(list(&card.uses), "nothing more")));
        let bounds: Vec<&str> = card.claims.error_bound.iter().map(|claim| claim.name.as_ref()).collect();
        let says = |yes: bool| if yes { "yes" } else { "no" };
        out.push_str(&format!(
            "  claims: error bound {}; consistent {}; estimates its own error {}\n",
            or(bounds.join(", "), "none"),
            says(card.claims.consistent),
            says(card.claims.estimates_error)
        ));
        let depends = card.varies_with.iter().map(|(what, why)| format!("{what} ({why})"));
        out.push_str(&format!(
            "  depends on: {}\n",
            or(depends.collect::<Vec<_>>().join(", "), "nothing it should not")
        ));
        for (caveat, why) in &card.caveats {
            out.push_str(&format!("  caveat: {caveat} ({why})\n"));
        }
        for note in &card.notes {
            out.push_str(&format!("  note: {note}\n"));
        }
    }
    out
}

/// One line for each parameter, with its default.
fn params(table: &[Param], defaults: &Value) -> String {
    let rows: Vec<[String; 2]> = table
        .iter()
        .map(|p| {
            let default = defaults.get(&p.name).unwrap_or(&Value::Null);
            [format!("    {} = {default}", p.name), format!("[{}]  {}", p.range(), p.described())]
        })
        .collect();
    // Left-aligned second column: pad the first only.
    let width = rows.iter().map(|r| r[0].chars().count()).max().unwrap_or(0);
    rows.iter().map(|row| format!("{:width$}  {}\n", row[0], row[1])).collect()
}

fn describe(context: &Context, factory: &dyn Factory) -> Value {
    let params: Vec<Value> = factory.params().iter().map(|p| param(p, &p.default)).collect();
    let mut object = json!({"id": factory.id(), "summary": factory.summary(), "params": params});
    if let Ok(method) = context.registry.build(factory.id(), &Map::new()) {
        fill(&mut object, &method);
    }
    object
}

fn param(param: &Param, default: &Value) -> Value {
    json!({
        "name": param.name,
        "default": default,
        "range": param.range(),
        "symbol": param.symbol,
        "section": param.section,
        "about": param.about,
    })
}

/// What a method's card and the combinators around it add.
fn fill(object: &mut Value, method: &Method) {
    let card = method.denoiser.card();
    let strings = |needs: &[Need]| needs.iter().map(Need::to_string).collect::<Vec<_>>();
    object["name"] = card.name.into();
    object["citation"] = json!({"key": card.citation.key, "text": card.citation.text});
    object["needs"] = strings(&card.needs).into();
    object["uses"] = strings(&card.uses).into();
    object["bounds"] = card.claims.error_bound.iter().map(|c| c.name.clone()).collect::<Vec<_>>().into();
    object["consistent"] = card.claims.consistent.into();
    object["notes"] = card.notes.into();
    if let (Some(params), Some(_)) = (object["params"].as_array_mut(), method.params.get(Guarded::PARAM)) {
        let values = guards(&method.params);
        params.extend(Guarded::params().iter().map(|own| param(own, &values[&own.name])));
    }
}

/// Values of the combinator's own parameters among those of a method, which leave out some that are defaults.
fn guards(of: &Value) -> Value {
    let own = Guarded::params();
    let value = |own: &Param| of.get(&own.name).unwrap_or(&own.default).clone();
    own.iter().map(|own| (own.name.clone(), value(own))).collect::<Map<_, _>>().into()
}
