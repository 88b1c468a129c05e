use std::sync::OnceLock;

use crate::case::{Case, known};
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 4] = ["scale 1e-8", "scale 1e-4", "scale 1e4", "scale 1e8"];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| known(&KNOWN)))
}
