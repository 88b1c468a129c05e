use noisefloor_denoiser::Input;

use crate::case::complete;
use crate::trial::{Trial, completed};
use crate::{Broken, Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let name = "a complete frame";
    let frame = completed(complete(), &trial.card);
    let missing = trial.card.missing(&frame);
    if !missing.is_empty() {
        // Nothing else here would ever run it.
        return Err(Broken::Unmet(missing).on(name));
    }
    trial.judge(name, &Input::new(&frame), false)?;
    Ok(trial.kept())
}
