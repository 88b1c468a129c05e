//! Inputs that are not there.

use noisefloor_denoiser::{Input, Need};
use noisefloor_frame::{FeatureId, Flash, Frame, Optional, Samples, Sampling};

use crate::case::complete;
use crate::trial::{Trial, completed};
use crate::{Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    let mut frames = 0;
    for need in trial.card.needs.clone() {
        let mut frame = completed(complete(), &trial.card).into_owned();
        take(&mut frame, &need);
        if need.is_met(&frame) {
            continue;
        }
        // Whoever looks at values before needs finds something else to complain of.
        frame.color.mean.data_mut().fill(f32::NAN);
        trial.judge(&format!("a frame without {need}"), &Input::new(&frame), false)?;
        frames += 1;
    }
    if trial.card.needs.is_empty() {
        return Ok(Outcome::Idle("it needs nothing but the colour"));
    }
    // To refuse is what was asked.
    Ok(Outcome::Kept { frames, refused: 0 })
}

/// Takes one input away.
fn take(frame: &mut Frame, need: &Need) {
    let feature = |frame: &mut Frame, id: &FeatureId, part: fn(&mut noisefloor_frame::Estimate)| {
        frame.features.get_mut(id).into_iter().for_each(part);
    };
    match need {
        Need::ColorVariance => frame.color.variance = None,
        Need::ColorHalves => frame.color.halves = None,
        Need::Samples(n) if *n > 1 => frame.samples = Samples::uniform(n - 1),
        Need::IndependentSamples => frame.sampling = Sampling::LowDiscrepancy,
        Need::Feature(id) => drop(frame.features.remove(id)),
        Need::FeatureVariance(id) => feature(frame, id, |feature| feature.variance = None),
        Need::FeatureHalves(id) => feature(frame, id, |feature| feature.halves = None),
        Need::Flash => frame.flash = None,
        Need::FlashVariance => match &mut frame.flash {
            Some(Flash::Parts { base, .. }) => base.variance = None,
            Some(Flash::Ready(flash)) => flash.variance = None,
            None => {}
        },
        Need::ThirdMoment | Need::Extremes => frame.optional = Optional::default(),
        _ => {}
    }
}
