//! Where further samples help.

use std::sync::OnceLock;

use noisefloor_denoiser::{Caveat, DenoiseError, Input};
use noisefloor_frame::Image;

use crate::case::{Case, complete, known};
use crate::trial::{Trial, attempt, completed};
use crate::{Broken, Outcome, Violation};

pub(super) const KNOWN: [&str; 6] = [
    "zero variance everywhere",
    "black image",
    "fireflies a million times brighter",
    "sample counts from 2 on",
    "scale 1e8",
    "1×1",
];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    let Some(adaptive) = trial.denoiser.adaptive() else {
        return Ok(Outcome::Idle("it steers no samples"));
    };
    let cases = CASES.get_or_init(|| {
        let sound = Case::new("a complete frame", complete().clone());
        std::iter::once(sound).chain(known(&KNOWN)).collect()
    });
    let mut refused = 0;
    for case in cases {
        let frame = completed(&case.frame, &trial.card);
        let input = Input::new(&frame);
        match attempt(&case.name, || adaptive.density(&input))? {
            Ok(density) => examine(&density, frame.width(), frame.height())
                .map_err(|broken| broken.on(case.name.as_ref()))?,
            Err(_) if input.check(&trial.card).is_err() => refused += 1,
            Err(DenoiseError::Undefined { .. }) if trial.caveat(Caveat::Undefined).is_some() => refused += 1,
            Err(error) => return Err(Broken::Refuses(error.into()).on(case.name.as_ref())),
        }
    }
    Ok(Outcome::Kept { frames: cases.len(), refused })
}

fn examine(density: &Image, width: usize, height: usize) -> Result<(), Broken> {
    density.expect_shape("density", width, height, 1).map_err(Broken::Shape)?;
    let values = density.data().iter().filter(|v| !(v.is_finite() && **v >= 0.0)).count();
    let wrong = Broken::Values { what: "the density".into(), values, how: "not finite or negative" };
    if values == 0 { Ok(()) } else { Err(wrong) }
}
