//! Is it the same picture at all, and if not, what makes it fit?
//!
//! Moves (flips, turns, shifts of a few pixels) and exchanged channels are judged by where the frame x lies between the
//! reference r and the moved reference T: L = Σ w(T−r)(2x−r−T) / Σ w(T−r)² is −1 if x shows r and +1 if it shows T. It is
//! linear in x, so noise has no mean in it, and its standard error comes from blocks. Exposure and the sRGB curve are
//! judged by the middle of the relative distances of block means.

mod fit;
mod moves;
mod tone;

use noisefloor_frame::{Finding, FindingKind, Image};
use noisefloor_stats::instrument::ResidualSums;

use crate::against::{Against, grey};
use crate::brightness::Brightness;
use crate::chance::ALPHA;
use crate::number::number;
use tone::Tone;

/// Standard errors from pixel to pixel from which on brightness differs, even if neighbours are correlated.
const CERTAIN: f64 = 15.0;

/// A frame with noise: brightness must differ significantly for a change of tone to be told.
pub(crate) fn frame(
    against: &Against<'_>,
    x: &Image,
    invalid: &[bool],
    blocks: &[ResidualSums],
    whole: Brightness,
    by_pixels: f64,
) -> Option<Finding> {
    let all = ResidualSums::total(blocks);
    let ratio = if all.light > 0.0 { all.seen / all.light } else { f64::NAN };
    let moved = moves::find(against, x, invalid, ratio);
    let tested = matches!(whole, Brightness::Tested { p, .. } if p <= ALPHA);
    let differs = tested || by_pixels >= CERTAIN || (moved.is_none() && tone::leans(against, x, invalid));
    let demand = match whole {
        _ if moved.is_some() => None,
        _ if differs => Some(&tone::NOISY),
        Brightness::Tested { .. } => None,
        // What cannot be tested for brightness must fit as well as an image without noise.
        Brightness::TooFew { .. } | Brightness::NotTested => Some(&tone::CLEAN),
    };
    let tone = demand.and_then(|demand| tone::find(against, x, invalid, ratio, demand));
    told(ratio, moved, tone)
}

/// An image of which nothing but its values is known: a change of tone must fit very well.
pub(crate) fn image(against: &Against<'_>, x: &Image) -> Option<Finding> {
    let (mut light, mut seen) = (0.0, 0.0);
    let r = against.reference.mean();
    for pixel in (0..x.pixels()).filter(|&p| against.usable(p, &[])) {
        let (a, b) = (grey(x, pixel), grey(r, pixel));
        if a.is_finite() {
            let w = against.weights[against.blocks.of(pixel)];
            light += w * f64::from(b);
            seen += w * f64::from(a);
        }
    }
    let ratio = if light > 0.0 { seen / light } else { f64::NAN };
    let moved = moves::find(against, x, &[], ratio);
    let tone = if moved.is_none() { tone::find(against, x, &[], ratio, &tone::CLEAN) } else { None };
    told(ratio, moved, tone)
}

fn told(ratio: f64, moved: Option<(String, f64)>, tone: Option<Tone>) -> Option<Finding> {
    let (fits, z) = match (moved, tone) {
        (Some((moved, z)), _) => (moved, Some(z)),
        (None, Some(tone)) => (tone.to_string(), None),
        (None, None) => return None,
    };
    let text = format!("not the same picture as the reference: ratio {}; fits after {fits}", number(ratio));
    let found = Finding::new(FindingKind::DifferentPicture, "", text).with_value(ratio);
    Some(match z {
        Some(z) => found.with_standard_errors(z),
        None => found,
    })
}
