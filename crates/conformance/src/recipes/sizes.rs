use std::sync::OnceLock;

use crate::case::{Case, known, render};
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 9] = [
    "1×1",
    "1×1 of two samples",
    "2×1",
    "1×7",
    "50×1",
    "smaller than any window",
    "odd width 15",
    "odd width 33",
    "width 64 plus 1",
];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        for (width, height) in [(7, 1), (2, 2), (3, 3), (17, 16)] {
            cases.push(Case::new(format!("{width}×{height}"), render(width, height, 4, 11)));
        }
        cases
    }))
}
