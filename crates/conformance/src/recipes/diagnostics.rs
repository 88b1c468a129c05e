use std::sync::OnceLock;

use noisefloor_denoiser::{Diagnostics, Input};

use crate::case::{Case, complete, render};
use crate::trial::{Trial, completed, same_bits};
use crate::{Broken, Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    let cases = CASES.get_or_init(|| {
        let small = [(1, 1), (4, 3)];
        let small = small.map(|(w, h)| Case::new(format!("{w}×{h}"), render(w, h, 4, 11)));
        small.into_iter().chain([Case::new("a complete frame", complete().clone())]).collect()
    });
    for case in cases {
        let frame = completed(&case.frame, &trial.card);
        let input = Input::new(&frame);
        let plain = trial.judge(&case.name, &input, false)?;
        // The pixel that is furthest from where windows begin.
        let corner = (frame.width() - 1, frame.height() - 1);
        for probe in [None, Some(corner)] {
            let asked = input.with_diagnostics(Diagnostics::On { probe });
            let full = trial.judge(&case.name, &asked, false)?;
            let same = match (&plain, &full) {
                (Some(plain), Some(full)) => same_bits(plain, full),
                (plain, full) => plain.is_none() && full.is_none(),
            };
            if !same {
                return Err(Broken::OtherBits("with diagnostics").on(case.name.as_ref()));
            }
        }
    }
    Ok(trial.kept())
}
