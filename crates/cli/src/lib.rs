//! The `noisefloor` command as a library, one verb per file.
//!
//! [`main_with`] takes the entries of a user's own methods, so that a program outside this repository gets the whole
//! command with its denoiser in every list, sweep and report.

mod args;
mod compare;
mod context;
mod denoise;
mod methods;
mod progress;
mod render;
mod report;
mod run;
mod scenes;
mod shot;
mod table;

use std::process::ExitCode;

use clap::Parser;
use noisefloor_denoiser::Entry;

/// Runs the command with the built-in methods and `extra` ones, on the arguments of the process.
///
/// Exit code 0: done; 1: an error, told on standard error; 2: wrong usage.
#[must_use]
pub fn main_with(extra: &[Entry]) -> ExitCode {
    let args = args::Args::parse();
    let context = context::Context::new(extra);
    let done = match args.verb.unwrap_or_default() {
        args::Verb::Run(verb) => run::run(&context, &verb),
        args::Verb::Render(verb) => render::run(&context, &verb),
        args::Verb::Denoise(verb) => denoise::run(&context, &verb),
        args::Verb::Compare(verb) => compare::run(&verb),
        args::Verb::Report(verb) => report::run(&verb),
        args::Verb::Methods(verb) => methods::run(&context, &verb),
        args::Verb::Scenes(verb) => scenes::run(&verb),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("noisefloor: {error:#}");
            ExitCode::FAILURE
        }
    }
}
