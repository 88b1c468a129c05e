//! Means that are large beside their spread: what subtracts squares loses all digits.

use std::sync::OnceLock;

use noisefloor_denoiser::Caveat;
use noisefloor_frame::{Image, Variance};

use crate::case::{Case, known};
use crate::trial::Trial;
use crate::{Broken, Outcome, Violation};

pub(super) const KNOWN: [&str; 1] = ["mean a million, sample variance a thousandth"];

const LEVEL: f64 = 1e6;
/// Values of the frames lie within 0.4 of the level, and numbers near it 1/16 apart: a sum of the hundreds of values that a
/// window has is rounded by tens of those.
const ALLOWED: f64 = 4.0;

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    let cases = CASES.get_or_init(|| {
        let mut cases = known(&KNOWN);
        cases.push(Case::edited("a million and a little, with halves", |f| {
            let offset = |image: &Image| image.map(|v| (LEVEL + 0.06 * (f64::from(v) - 0.5)) as f32);
            f.color.variance = Some(Variance::of_mean(f.color.mean.map(|_| 1e-3)));
            f.color.mean = offset(&f.color.mean);
            f.color.halves = f.color.halves.as_ref().map(|halves| halves.each_ref().map(offset));
        }));
        cases
    });
    let declared = trial.caveat(Caveat::Level).map(str::to_owned);
    let mut seen = false;
    for case in cases {
        let Some(output) = trial.case(case)? else { continue };
        let away = output.image.data().iter().map(|v| (f64::from(*v) - LEVEL).abs());
        let distance = away.fold(0.0, f64::max);
        if distance > ALLOWED && declared.is_none() {
            return Err(Broken::Level { distance }.on(case.name.as_ref()));
        }
        seen |= distance > ALLOWED;
    }
    Ok(declared.map_or_else(|| trial.kept(), |reason| Outcome::Declared { reason, seen }))
}
