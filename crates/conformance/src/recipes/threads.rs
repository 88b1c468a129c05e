use std::sync::OnceLock;

use noisefloor_denoiser::Input;
use noisefloor_frame::Frame;

use crate::case::render;
use crate::trial::{Trial, completed, same_bits};
use crate::{Broken, Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static FRAME: OnceLock<Frame> = OnceLock::new();
    let frame = completed(FRAME.get_or_init(|| render(67, 35, 8, 11)), &trial.card);
    let name = "67×35";
    let mut outputs = Vec::new();
    for threads in [1, 4] {
        let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
            return Ok(Outcome::Idle("threads cannot be started here"));
        };
        outputs.push(pool.install(|| trial.judge(name, &Input::new(&frame), false))?);
    }
    match &outputs[..] {
        [Some(one), Some(four)] if same_bits(one, four) => {}
        [None, None] => {}
        _ => return Err(Broken::OtherBits("on four threads").on(name)),
    }
    Ok(trial.kept())
}
