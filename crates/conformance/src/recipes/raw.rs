//! Input that breaks the contract: nobody mended it.

use noisefloor_denoiser::Input;
use noisefloor_frame::{Flash, Frame, Image};

use crate::case::complete;
use crate::change::set_variance;
use crate::trial::{Trial, completed};
use crate::{Broken, Outcome, Violation};

const BAD: [f32; 6] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, f32::MAX, f32::MIN_POSITIVE];

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    for bad in BAD {
        let mut frame = completed(complete(), &trial.card).into_owned();
        spoil(&mut frame, bad);
        let name = format!("{bad} in every buffer");
        // An error of any kind is an answer, and so is an image that shows what went in.
        if let Ok(output) = trial.run(&name, &Input::new(&frame))? {
            let shape = output.image.expect_shape("output", frame.width(), frame.height(), 3);
            shape.map_err(|error| Broken::Shape(error).on(name))?;
        }
    }
    Ok(Outcome::Kept { frames: BAD.len(), refused: 0 })
}

fn spoil(frame: &mut Frame, bad: f32) {
    let scatter = |image: &mut Image, first: usize| {
        image.data_mut().iter_mut().skip(first).step_by(19).for_each(|v| *v = bad);
    };
    scatter(&mut frame.color.mean, 1);
    let mut k = 0;
    set_variance(&mut frame.color, |v| {
        k += 1;
        if k % 23 == 0 { bad } else { v }
    });
    frame.color.halves.iter_mut().flatten().for_each(|half| scatter(half, 4));
    frame.features.values_mut().for_each(|feature| scatter(&mut feature.mean, 2));
    if let Some(Flash::Parts { base, light, .. }) = &mut frame.flash {
        scatter(&mut base.mean, 3);
        set_variance(light, |_| bad);
    }
}
