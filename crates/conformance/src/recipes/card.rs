use crate::trial::{Trial, attempt};
use crate::{Broken, Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let card = &trial.card;
    let again = attempt("its card", || trial.denoiser.card())?;
    let reasons = || {
        let depends = card.varies_with.iter().map(|(what, why)| (what.to_string(), why));
        depends.chain(card.caveats.iter().map(|(what, why)| (what.to_string(), why)))
    };
    let twice = |names: Vec<String>| (1..names.len()).find(|&i| names[..i].contains(&names[i])).is_some();
    let wrong = if again != *card {
        "is another when it is asked for again"
    } else if card.id.is_empty() {
        "has no id"
    } else if reasons().any(|(_, why)| why.is_empty()) {
        "excepts something without a reason"
    } else if twice(reasons().map(|(what, _)| what).collect()) {
        "excepts the same thing twice"
    } else if twice(card.needs.iter().map(ToString::to_string).collect()) {
        "needs the same thing twice"
    } else {
        return Ok(Outcome::Kept { frames: 0, refused: 0 });
    };
    Err(Broken::Card(wrong.into()).on("its card"))
}
