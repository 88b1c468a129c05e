//! `noisefloor plan`.

mod calibrate;
mod levels;
mod plans;
mod text;

use std::path::Path;

use noisefloor_harness::{Forecast, SpreadsOf, forecast, spreads_of};
use noisefloor_questions::Spread;
use noisefloor_study::{Replicates, SceneSource, Study};

use crate::args::{Plan, Run};
use crate::context::{Context, default_cache, use_threads};
use crate::exit::Exit;
use crate::out::{Out, say};
use crate::run::{default_out, find_study};
use calibrate::{Rate, rate};
use levels::{Question, levels};
use plans::Plans;

/// Scenes differ in the cost of a sample by about as much, either way.
const SCENES_DIFFER: f64 = 3.0;

/// What a method's card says of its cost is meant to a factor of three.
const CARDS_DIFFER: f64 = 3.0;

pub fn run(context: &Context, args: &Plan) -> anyhow::Result<Exit> {
    use_threads(args.threads)?;
    let named = Run { study: Some(args.study.clone()), size: args.size, spp: args.spp, ..Run::default() };
    let mut study = find_study(context, &named)?.0;
    let out = args.out.clone().unwrap_or_else(|| default_out(&study, args.size));
    if let Some(replicates) = args.replicates {
        ask_for(&mut study, replicates);
        study.check(&args.study)?;
    }
    let cache = args.cache.clone().unwrap_or_else(default_cache);
    let size = args.size.map(|s| (s.width, s.height));
    let ahead = forecast(&study, &context.registry, size, &out, &cache)?;
    let spread = spread(args, &study, &out)?;
    let rate = if ahead.samples > 0 { Some(rate()?) } else { None };
    let plans = plans(args, &study, ahead, spread, rate);
    if args.json {
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&plans)?)?;
    } else {
        Out::Stdout.text(text::text(&plans))?;
    }
    Ok(Exit::Done)
}

/// As many replicates at every level of scenes whose frames are made here; a folder has those that it has.
fn ask_for(study: &mut Study, replicates: u32) {
    study.replicates = Replicates::uniform(replicates);
    for scene in study.scenes.iter_mut().filter(|s| !matches!(s.source, SceneSource::Folder(_))) {
        scene.replicates = None;
    }
}

/// The spread over replicates, and where it is from: the folder asked for, or the study's own results if there are any.
fn spread(args: &Plan, study: &Study, out: &Path) -> anyhow::Result<SpreadFrom> {
    let from = match &args.from {
        Some(from) => from,
        None if out.join("results.jsonl").is_file() => out,
        None => return Ok(SpreadFrom::default()),
    };
    let SpreadsOf { spreads, sizes } = spreads_of(from, Some(study.primary_metric.as_str()))?;
    if args.from.is_none() && spreads.is_empty() {
        return Ok(SpreadFrom::default());
    }
    let planned = args.size.map_or((study.width, study.height), |size| (size.width, size.height));
    // Other scenes have sizes of their own.
    let rendered = study.scenes.iter().filter(|scene| matches!(scene.source, SceneSource::Builtin(_)));
    let mut others = rendered.filter_map(|scene| sizes.get(&scene.id)).filter(|size| **size != planned);
    let note = others.next().map(|(width, height)| {
        let (wide, high) = planned;
        format!("of images of {width}×{height} pixels; those of {wide}×{high} may spread otherwise")
    });
    Ok(SpreadFrom { folder: Some(from.display().to_string()), note, spreads })
}

/// What is known of the spread over replicates.
#[derive(Default)]
struct SpreadFrom {
    folder: Option<String>,
    /// In what it is not that of the study.
    note: Option<String>,
    spreads: Vec<Spread>,
}

fn plans(args: &Plan, study: &Study, ahead: Forecast, spread: SpreadFrom, rate: Option<Rate>) -> Plans {
    let rows = study.methods.len() as u32;
    let pairs = match study.comparison {
        noisefloor_study::Family::AllPairs => rows * rows.saturating_sub(1) / 2,
        noisefloor_study::Family::WithBest => rows.saturating_sub(1),
    };
    let question = Question::new(pairs, args.ratio, args.power);
    let threads = rayon::current_num_threads();
    let range = |seconds: f64, factor: f64| [seconds / 60.0 / factor, seconds / 60.0 * factor];
    let render = rate.as_ref().map_or(0.0, |rate| ahead.samples as f64 / rate.per_second);
    Plans {
        study: study.name.clone(),
        metric: study.primary_metric.clone(),
        pairs,
        confidence: question.confidence(),
        ratio: args.ratio,
        power: args.power,
        spread_from: spread.folder,
        spread_note: spread.note,
        levels: levels(&ahead.items, &spread.spreads, &question),
        cells: ahead.cells,
        finished_cells: ahead.finished,
        samples: ahead.samples,
        samples_per_second: rate.map(|rate| rate.per_second),
        threads,
        render_minutes: range(render, SCENES_DIFFER),
        denoise_minutes: range(ahead.seconds / threads.max(1) as f64, CARDS_DIFFER),
    }
}
