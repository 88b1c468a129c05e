//! Bounds that cards say are proven, where the proof holds: independent normal samples of a known mean.

use std::sync::OnceLock;

use noisefloor_denoiser::Input;
use noisefloor_frame::{Frame, Image};
use noisefloor_stats::{Truth, bound_violations, half_widths};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::case::STATISTICS;
use crate::trial::{Trial, completed, observed};
use crate::{Broken, Outcome, Tolerance, Violation};

/// Enough pixels to tell twice a rate of 1 % from it, and quick.
const SIZE: (usize, usize) = (48, 32);
const SPP: [u32; 2] = [2, 16];

/// A frame of normal samples, and its truth.
type Known = (String, Frame, Image);

/// # Panics
/// Never: law and size are in range.
fn frames() -> Vec<Known> {
    let law = SampleLaw::Gaussian { sd: 0.4, relative: false };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, SIZE.0, SIZE.1)
        .expect("the law and the size of this file are in range");
    let truth = scene.truth().mean().clone();
    SPP.iter()
        .map(|&n| (format!("{n} normal samples"), scene.render_with(n, 41, &STATISTICS), truth.clone()))
        .collect()
}

pub(super) fn run(trial: &mut Trial<'_>) -> Result<Outcome, Violation> {
    static FRAMES: OnceLock<Vec<Known>> = OnceLock::new();
    let claims: Vec<_> = trial.card.claims.error_bound.iter().filter(|claim| claim.proven).cloned().collect();
    if claims.is_empty() {
        return Ok(Outcome::Idle("it says of none that it is proven"));
    }
    for (name, frame, truth) in FRAMES.get_or_init(frames) {
        let frame = completed(frame, &trial.card);
        let Some(output) = trial.judge(name, &Input::new(&frame), false)? else { continue };
        let Some(observed) = observed(&frame) else { continue };
        let truth = Truth { mean: truth.data(), variance: None };
        for claim in &claims {
            let tally = half_widths(&observed, &claim.terms).and_then(|widths| {
                bound_violations(output.image.data(), &widths, &observed, &truth, claim.level, None)
            });
            // The shapes were checked, and there is one group of pixels.
            let Some(tally) = tally.ok().and_then(|tallies| tallies.first().cloned()) else { continue };
            let Some(rate) = tally.rate() else { continue };
            // An average over neighbours errs like its neighbour: each trial counts for a channel of a pixel all the same,
            // as the bound is far from being reached where values are averaged.
            Tolerance::rate(claim.level.alpha(), tally.total)
                .at_most(rate)
                .map_err(|told| Broken::Bound { claim: claim.name.to_string(), told }.on(name))?;
        }
    }
    Ok(trial.kept())
}
