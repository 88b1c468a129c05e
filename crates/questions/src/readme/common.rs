//! What belongs to no question alone.

use noisefloor_study::format;

use super::asked::Block;
use super::chosen::Chosen;
use super::kind::{Kind, lines};
use crate::document::answers;

pub(super) const KINDS: &[Kind] = &[
    Kind { name: "answers", keys: &[], make: all_answers },
    Kind { name: "machine", keys: &[], make: machine },
];

fn all_answers(chosen: &Chosen<'_>) -> Vec<Block> {
    let line = |answer: noisefloor_study::exhibit::Answer| {
        format!("* **{}** {}", answer.question, answer.sentences.join(" "))
    };
    lines(answers(chosen.view).into_iter().map(line).collect())
}

fn machine(chosen: &Chosen<'_>) -> Vec<Block> {
    let summary = chosen.view.summary;
    let environment = &summary.environment;
    let cells = match &summary.progress {
        Some(progress) if progress.complete() => {
            format!("All {} cells of the study ended. ", progress.planned)
        }
        Some(progress) => format!("**Unfinished**: {progress}. "),
        None => String::new(),
    };
    let load = environment
        .load_at_start
        .map_or_else(String::new, |load| format!("; load {} when it began", format::significant(load, 2)));
    vec![Block::Text(format!(
        "{cells}Made by noisefloor {} ({} build) on {}, {}, {}{load}.",
        environment.version,
        environment.profile,
        environment.cpu,
        format::plural(environment.threads as usize, "thread"),
        environment.simd
    ))]
}
