use noisefloor_denoiser::Input;

use crate::case::{complete, render};
use crate::trial::{Trial, completed, same_bits};
use crate::{Broken, Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let name = "a complete frame";
    let frame = completed(complete(), &trial.card);
    let first = trial.judge(name, &Input::new(&frame), false)?;
    // Whoever keeps something from a frame for the next one shows it after a frame of another size.
    let other = render(9, 12, 4, 12);
    trial.judge("another frame", &Input::new(&completed(&other, &trial.card)), false)?;
    let again = trial.judge(name, &Input::new(&frame), false)?;
    match (&first, &again) {
        (Some(first), Some(again)) if same_bits(first, again) && first.figures == again.figures => {}
        (None, None) => {}
        _ => return Err(Broken::OtherBits("when it is asked again").on(name)),
    }
    Ok(trial.kept())
}
