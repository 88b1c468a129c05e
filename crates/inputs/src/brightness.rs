//! Is the mean of a frame that of its reference?
//!
//! S = Σ w(g_x − g_r) over pixels, with g the mean of the channels (a pixel is one cluster) and w the inverse of the
//! brightness around. Its variance is the largest of what the residuals show, pixel by pixel and by blocks, what the frame
//! states and what the reference predicts for the frame's number of samples, which knows of rare light that the frame's
//! own samples missed. z is shrunk for skewness (Hall 1992), and judged by Student's t with as many degrees of freedom
//! as there are bright samples.

use noisefloor_frame::{Finding, FindingKind, Frame, Sampling};
use noisefloor_stats::holm_adjusted;
use noisefloor_stats::instrument::{LEAST_EFFECTIVE, ResidualSums, Spread, shrunk};

use crate::against::Against;
use crate::chance::{ALPHA, p_value};
use crate::median::median;

/// Whether and how the brightness of a whole frame was tested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Brightness {
    /// Not at all: frame and reference are not expected to have one mean, or nothing is left to test.
    NotTested,
    /// Too few bright samples to tell.
    TooFew {
        /// Pixels among which the variance is effectively spread: (Σ w²v)²/Σ(w²v)².
        effective: f64,
    },
    /// Tested.
    Tested {
        /// Standard errors by which the frame is brighter.
        z: f64,
        /// Two-sided p-value.
        p: f64,
        /// Brightness of the frame over that of the reference.
        ratio: f64,
    },
}

/// Smallest relative difference that is told: above what half precision does to constant pixels.
const LEAST_EFFECT: f64 = 2e-3;

/// How S spreads; the effective number of pixels if the frame may have missed light.
fn spread(frame: &Frame, sums: &ResidualSums, together: f64, between: f64) -> Result<Spread, f64> {
    // Low-discrepancy samples: s²/n is not the variance, only residuals are.
    let states = frame.color.variance.is_some() && frame.sampling == Sampling::Independent;
    sums.spread(states, together, between)
}

/// The whole image.
pub(crate) fn whole(frame: &Frame, blocks: &[ResidualSums]) -> Brightness {
    let all = ResidualSums::total(blocks);
    if all.pixels < LEAST_EFFECTIVE || all.light <= 0.0 {
        return Brightness::NotTested;
    }
    match spread(frame, &all, all.together(), ResidualSums::between(blocks, &all)) {
        Err(effective) => Brightness::TooFew { effective },
        Ok(spread) => {
            let z = shrunk(all.e, spread.variance, spread.third);
            let freedom = all.effective_freedom(frame.color.variance.is_some());
            Brightness::Tested { z, p: p_value(z, freedom), ratio: all.seen / all.light }
        }
    }
}

/// Size of the difference in standard errors from pixel to pixel alone: a systematic difference that varies over the image
/// passes for noise in the spread of the blocks.
pub(crate) fn by_pixels(frame: &Frame, blocks: &[ResidualSums]) -> f64 {
    let all = ResidualSums::total(blocks);
    let together = all.together();
    let mut variance = all.central().0.max(together * (all.predicted + all.reference));
    if frame.sampling == Sampling::Independent {
        variance = variance.max(together * (all.stated + all.reference));
    }
    if variance > 0.0 { (all.e / variance.sqrt()).abs() } else { 0.0 }
}

/// What [`crate::among`] pools: S, its variance without the reference's part, that part, the third moment.
pub(crate) fn pooled(frame: &Frame, blocks: &[ResidualSums]) -> Option<[f64; 4]> {
    let all = ResidualSums::total(blocks);
    let spread = spread(frame, &all, all.together(), ResidualSums::between(blocks, &all)).ok()?;
    let own = (spread.variance - spread.reference).max(0.0);
    (own > 0.0 && all.light > 0.0).then_some([all.e, own, spread.reference, spread.third])
}

/// What a reader must know: the image, or else the blocks that differ.
pub(crate) fn findings(
    against: &Against<'_>,
    frame: &Frame,
    blocks: &[ResidualSums],
    whole: Brightness,
) -> Option<Finding> {
    if let Brightness::Tested { z, p, ratio } = whole
        && p <= ALPHA
        && (ratio - 1.0).abs() >= LEAST_EFFECT
    {
        let how = if z > 0.0 { "brighter" } else { "darker" };
        let text = format!(
            "its mean is {:.2} % {how} than the reference's, {:.1} standard errors",
            100.0 * (ratio - 1.0).abs(),
            z.abs()
        );
        return Some(
            Finding::new(FindingKind::Brightness, "", text).with_value(z).with_standard_errors(z.abs()),
        );
    }
    local(against, frame, blocks)
}

/// The blocks, with Holm's rule over all that can be tested.
fn local(against: &Against<'_>, frame: &Frame, blocks: &[ResidualSums]) -> Option<Finding> {
    let together = ResidualSums::total(blocks).together();
    let mut tested = Vec::new();
    for (index, sums) in blocks.iter().enumerate() {
        // A block cannot show how skewed it is where light is rare; the frame's own spread and the reference's must both say.
        if sums.light <= 0.0 || frame.color.variance.is_none() || sums.predicted2 <= 0.0 && !against.exact {
            continue;
        }
        if let Ok(spread) = spread(frame, sums, together, 0.0) {
            let z = shrunk(sums.e, spread.variance, spread.third);
            let freedom = sums
                .effective_freedom(frame.color.variance.is_some())
                .min((sums.e2 * sums.e2 / sums.e4.max(f64::MIN_POSITIVE)) as u64)
                .max(2);
            tested.push((index, z, p_value(z, freedom), sums.seen / sums.light));
        }
    }
    let adjusted = holm_adjusted(&tested.iter().map(|t| t.2).collect::<Vec<_>>());
    let mut ratios = Vec::new();
    let mut worst: Option<(usize, f64)> = None;
    for ((index, z, _, ratio), p) in tested.iter().zip(&adjusted) {
        if *p <= ALPHA && (ratio - 1.0).abs() >= LEAST_EFFECT {
            ratios.push(*ratio);
            worst = worst.filter(|(_, other)| other.abs() >= z.abs()).or(Some((*index, *z)));
        }
    }
    let (block, z) = worst?;
    let (x, y) = against.blocks.corner(block);
    let (edge, count, of) = (against.blocks.edge(), ratios.len(), tested.len());
    let typical = median(&mut ratios)?;
    let text = format!(
        "its mean differs from the reference's in {count} of {of} blocks of {edge}×{edge} pixels (ratio {typical:.2}); most at \
         ({x}, {y}), {:.1} standard errors",
        z.abs()
    );
    Some(Finding::new(FindingKind::Brightness, "", text).with_value(z).with_standard_errors(z.abs()))
}
