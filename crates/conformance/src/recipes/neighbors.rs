use std::sync::OnceLock;

use noisefloor_denoiser::Input;
use noisefloor_frame::Frame;

use crate::case::{SIZE, SPP, render};
use crate::trial::{Trial, completed};
use crate::{Outcome, Violation};

/// Most neighbours on each side that are tried.
const MOST: usize = 3;

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let reach = trial.card.neighbors.min(MOST);
    if reach == 0 {
        return Ok(Outcome::Idle("it looks at one frame"));
    }
    static MOMENTS: OnceLock<Vec<Frame>> = OnceLock::new();
    let moments = MOMENTS.get_or_init(|| {
        (0..2 * MOST as u64 + 1).map(|moment| render(SIZE.0, SIZE.1, SPP, 20 + moment)).collect()
    });
    let moments: Vec<Frame> =
        moments.iter().map(|moment| completed(moment, &trial.card).into_owned()).collect();
    let (before, after) = (&moments[..reach], &moments[reach + 1..2 * reach + 1]);
    let input = Input::new(&moments[reach]);
    for (name, input) in [
        ("neighbours on both sides", input.with_neighbors(before, after)),
        ("the first frame of a sequence", input.with_neighbors(&[], after)),
        ("the last frame of a sequence", input.with_neighbors(before, &[])),
    ] {
        trial.judge(name, &input, false)?;
    }
    Ok(trial.kept())
}
