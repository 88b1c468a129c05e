//! Other names for red, green and blue.

use std::sync::OnceLock;

use noisefloor_denoiser::Invariance;
use noisefloor_frame::Frame;

use super::follows::{Change, ROUNDING, run as follow};
use crate::case::complete;
use crate::change::{tinted, turned, with_turned_channels};
use crate::trial::Trial;
use crate::{Outcome, Violation};

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static FRAME: OnceLock<Frame> = OnceLock::new();
    let changes = [Change {
        name: "channels that changed places".into(),
        frame: |frame, _| with_turned_channels(frame),
        output: |image, _| turned(image),
        by: 1.0,
        // Sums over channels go in another order.
        allowed: ROUNDING,
    }];
    // In strong colours, and the flash in others, so that what weighs channels by luminance cannot miss which is which.
    let frame = FRAME.get_or_init(|| {
        let flash = tinted(complete(), [0.25, 1.0, 0.5]).flash;
        Frame { flash, ..tinted(complete(), [1.0, 0.5, 0.25]) }
    });
    follow(trial, Invariance::ChannelOrder, frame, &changes)
}
