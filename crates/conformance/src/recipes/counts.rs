//! Numbers of samples.

use std::sync::OnceLock;

use noisefloor_frame::{Frame, Samples};

use crate::case::{Case, SIZE, complete, counted, known, render};
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) const KNOWN: [&str; 5] =
    ["one sample", "two samples", "three samples", "sample counts from 1 on", "sample counts from 2 on"];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    trial.survive(CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        let pixels = complete().pixels();
        let each =
            |count: &dyn Fn(usize) -> u32| counted(Samples::per_pixel((0..pixels).map(count).collect()));
        // A file may carry a variance and still say that one sample was taken.
        let odd = Frame { samples: Samples::uniform(1), ..render(SIZE.0, SIZE.1, 2, 11) };
        cases.push(Case::new("one sample with a variance", odd));
        cases.push(Case::new("one pixel of one sample", each(&|p| if p == 40 { 1 } else { 4 })));
        cases.push(Case::new("from 2 to 20 000 samples", each(&|p| 2 + (p * p) as u32 % 20_000)));
        let most = counted(Samples::uniform(u32::MAX));
        cases.push(Case::new("as many samples as can be counted", most));
        cases
    }))
}
