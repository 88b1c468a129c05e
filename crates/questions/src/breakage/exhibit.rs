//! What a reader sees.

use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::Status;

use crate::view::View;

pub(super) fn answer(view: &View<'_>) -> Option<Answer> {
    let summary = view.summary;
    let count = |status: Status| summary.skipped.iter().filter(|s| s.status == status).count();
    let (failed, skipped) = (count(Status::Failed), count(Status::Skipped));
    let lost: u64 = summary.cells.iter().map(|c| c.non_finite_output).sum();
    let (ran, known) = (!summary.cells.is_empty(), summary.progress.is_some());
    let mut sentences = Vec::new();
    match &summary.progress {
        _ if !ran => sentences.push("Nothing ran.".to_owned()),
        Some(progress) if !progress.complete() => sentences.push(format!(
            "The study is unfinished: {} of {} cells ended.",
            progress.finished, progress.planned
        )),
        Some(_) if failed + skipped == 0 => sentences.push("Every method ran on every frame.".into()),
        _ => {}
    }
    if skipped > 0 {
        let rows = format::plural(skipped, "row");
        sentences.push(format!("{rows} skipped, with the reason below the tables."));
    }
    if failed > 0 {
        sentences.push(format!("{} ended in an error.", format::plural(failed, "row")));
    }
    if lost > 0 {
        sentences.push(format!("{lost} output values were not finite."));
    } else if ran {
        let so_far =
            if view.complete() { "All outputs are finite." } else { "All outputs so far are finite." };
        sentences.push(so_far.into());
    }
    let tone = match failed > 0 || lost > 0 {
        true => Tone::Bad,
        // What did not run was not tested.
        false if ran && known && view.complete() && skipped == 0 => Tone::Good,
        false => Tone::Plain,
    };
    Some(Answer { question: "Does anything break?".into(), sentences, tone })
}
