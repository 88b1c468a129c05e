//! A method under test: run on a frame, and the answer judged by what its card says.

mod complete;
mod examine;

use std::panic::{AssertUnwindSafe, catch_unwind};

use noisefloor_denoiser::{Caveat, DenoiseError, Denoiser, Input, Invariance, MethodCard, Output};

use crate::case::Case;
use crate::{Broken, Outcome, Violation};

pub(crate) use complete::completed;
pub(crate) use examine::{observed, same_bits};

/// A method in one recipe.
pub(crate) struct Trial<'a> {
    pub denoiser: &'a dyn Denoiser,
    pub card: MethodCard,
    frames: usize,
    refused: usize,
}

impl<'a> Trial<'a> {
    pub fn new(denoiser: &'a dyn Denoiser, card: MethodCard) -> Self {
        Self { denoiser, card, frames: 0, refused: 0 }
    }

    /// Nothing was broken.
    pub fn kept(&self) -> Outcome {
        Outcome::Kept { frames: self.frames, refused: self.refused }
    }

    /// The reason that the card gives for a caveat.
    pub fn caveat(&self, caveat: Caveat) -> Option<&str> {
        self.card.caveats.iter().find(|(known, _)| *known == caveat).map(|(_, reason)| reason.as_str())
    }

    /// The reason that the card gives for depending on something.
    pub fn varies_with(&self, what: Invariance) -> Option<&str> {
        self.card.varies_with.iter().find(|(known, _)| *known == what).map(|(_, reason)| reason.as_str())
    }

    /// Every case ends in an image that may be, or in a refusal that the card declares.
    pub fn survive(&mut self, cases: &[Case]) -> Result<Outcome, Violation> {
        for case in cases {
            self.case(case)?;
        }
        Ok(self.kept())
    }

    /// The image of one case; `None` for a refusal that the card declares.
    pub fn case(&mut self, case: &Case) -> Result<Option<Output>, Violation> {
        let frame = completed(&case.frame, &self.card);
        self.judge(&case.name, &Input::new(&frame), case.extreme)
    }

    /// Runs on an input and judges the answer; `None` for a refusal that the card declares.
    pub fn judge(
        &mut self,
        case: &str,
        input: &Input<'_>,
        extreme: bool,
    ) -> Result<Option<Output>, Violation> {
        self.frames += 1;
        let excused = extreme || self.caveat(Caveat::Undefined).is_some();
        let output = match (self.run(case, input)?, input.check(&self.card)) {
            (Ok(output), Ok(())) => output,
            (Ok(_), Err(expected)) => return Err(Broken::Careless(expected.into()).on(case)),
            (Err(got), Err(expected)) if !same_reason(&got, &expected) => {
                return Err(Broken::Reason { expected: expected.into(), got: got.into() }.on(case));
            }
            (Err(got), Ok(())) if !(excused && matches!(got, DenoiseError::Undefined { .. })) => {
                return Err(Broken::Refuses(got.into()).on(case));
            }
            (Err(_), _) => {
                self.refused += 1;
                return Ok(None);
            }
        };
        examine::examine(&self.card, input.target, &output).map_err(|broken| broken.on(case))?;
        Ok(Some(output))
    }

    /// Runs on an input without judging the answer, but for a panic.
    pub fn run(&self, case: &str, input: &Input<'_>) -> Result<Result<Output, DenoiseError>, Violation> {
        attempt(case, || self.denoiser.denoise(input))
    }
}

/// A refusal by a card is the same whoever words it: all that is missing, or the name that means nothing.
fn same_reason(got: &DenoiseError, expected: &DenoiseError) -> bool {
    match (got, expected) {
        (DenoiseError::MissingInputs { missing, .. }, DenoiseError::MissingInputs { missing: all, .. }) => {
            missing == all
        }
        _ => got.kind() == expected.kind(),
    }
}

/// Runs something of a method; a panic becomes a violation.
pub(crate) fn attempt<T>(case: &str, work: impl FnOnce() -> T) -> Result<T, Violation> {
    // The method's state is not touched again after a panic unless by another call, which fails on its own.
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("with something that is no text");
        Broken::Panics(text.into()).on(case)
    })
}
