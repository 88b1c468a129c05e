//! The `noisefloor` command as a library, one verb per file.
//!
//! [`main_with`] takes a user's own methods, so that a program outside this repository gets the whole
//! command with its denoiser in every list, sweep and report.

mod args;
mod check;
mod compare;
mod context;
mod convert;
mod denoise;
mod exit;
mod export;
mod gate;
mod input;
mod interrupt;
mod memory;
mod methods;
mod out;
mod output;
mod plan;
mod progress;
mod record;
mod render;
mod report;
mod run;
mod scenes;
mod shot;
mod table;

use std::io::{self, ErrorKind, Write as _};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use noisefloor_denoiser::Factory;

use crate::exit::Exit;
use crate::out::note;

/// Runs the command with the built-in methods and `extra` ones, on the arguments of the process.
///
/// Exit code 0: done; 1: an error, told on standard error; 2: wrong usage; 3: a report of an unfinished study; of a
/// gate 4: something is worse, 5: not comparable, 6: cannot be told; 130: stopped by Ctrl-C.
#[must_use]
pub fn main_with(extra: impl IntoIterator<Item = Arc<dyn Factory>>) -> ExitCode {
    let args = match args::Args::try_parse() {
        Ok(args) => args,
        Err(asked) => return help(&asked).into(),
    };
    if let Some(Err(error)) = args.instruction_set.map(noisefloor_kernels::InstructionSet::force) {
        note!("noisefloor: {error}");
        return Exit::Usage.into();
    }
    let context = context::Context::new(extra);
    let done = match args.verb.unwrap_or_default() {
        args::Verb::Run(verb) => run::run(&context, &verb),
        args::Verb::Plan(verb) => plan::run(&context, &verb),
        args::Verb::Gate(verb) => gate::run(&verb),
        args::Verb::Render(verb) => render::run(&context, &verb),
        args::Verb::Denoise(verb) => denoise::run(&context, &verb),
        args::Verb::Compare(verb) => compare::run(&verb),
        args::Verb::Convert(verb) => convert::run(&verb),
        args::Verb::Report(verb) => report::run(&verb),
        args::Verb::Export(verb) => export::run(&verb),
        args::Verb::Record(verb) => record::run(&verb),
        args::Verb::Methods(verb) => methods::run(&context, &verb),
        args::Verb::Check(verb) => check::run(&context, &verb),
        args::Verb::Scenes(verb) => scenes::run(&verb),
    };
    match done {
        Ok(exit) => exit.into(),
        Err(error) => {
            note!("noisefloor: {}", exit::told(&error));
            Exit::of(&error).into()
        }
    }
}

/// Shows a help text or what is wrong with the arguments.
fn help(asked: &clap::Error) -> Exit {
    let shown = asked.print().and_then(|()| io::stdout().flush());
    match shown {
        _ if asked.use_stderr() => Exit::Usage,
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            note!("noisefloor: cannot write to standard output: {error}");
            Exit::Failed
        }
        _ => Exit::Done,
    }
}
