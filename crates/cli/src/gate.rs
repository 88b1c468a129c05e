//! `noisefloor gate`.

mod text;

use noisefloor_harness::GateFailure;
use noisefloor_questions::{GateError, Overall};
use noisefloor_stats::{Level, Terms};

use crate::args::Gate;
use crate::exit::{Exit, not_comparable, usage};
use crate::out::{Out, say};

pub fn run(args: &Gate) -> anyhow::Result<Exit> {
    let terms = Terms { level: Level::two_sided(1.0 - args.alpha)?, margin: args.margin };
    let found =
        noisefloor_harness::gate(&args.old, &args.new, args.metric.as_deref(), terms).map_err(refused)?;
    if args.json {
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&found)?)?;
    } else {
        Out::Stdout.text(text::text(&found))?;
    }
    Ok(match found.overall {
        Overall::Worse => Exit::Worse,
        Overall::CannotBeTold if args.strict => Exit::Untold,
        Overall::Same | Overall::Passed | Overall::CannotBeTold => Exit::Done,
    })
}

fn refused(failure: GateFailure) -> anyhow::Error {
    match failure {
        GateFailure::Folder(error) => error.into(),
        GateFailure::Gate(error @ GateError::NotAnError { .. }) => usage(format!("--metric: {error}")),
        error @ GateFailure::Unfinished { .. } => {
            not_comparable(format!("the two cannot be compared: {error}"))
        }
        GateFailure::Gate(error @ GateError::NotComparable(_)) => {
            not_comparable(format!("the two cannot be compared:\n{error}"))
        }
    }
}
