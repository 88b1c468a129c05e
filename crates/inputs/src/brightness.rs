//! Is the mean of a frame that of its reference?
//!
//! S = Σ w(g_x − g_r) over pixels, with g the mean of the channels (a pixel is one cluster) and w the inverse of the
//! brightness around. Its variance is the largest of what the residuals show, pixel by pixel and by blocks, what the frame
//! states and what the reference predicts for the frame's number of samples, which knows of rare light that the frame's
//! own samples missed. z is shrunk for skewness (Hall 1992), and judged by Student's t with as many degrees of freedom
//! as there are bright samples.

use noisefloor_frame::{Finding, FindingKind, Frame, Sampling};
use noisefloor_stats::holm_adjusted;

use crate::against::Against;
use crate::blocks::median;
use crate::chance::{ALPHA, p_value};
use crate::sums::Sums;

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

/// Pixels among which the variance must effectively be spread.
pub(crate) const LEAST_EFFECTIVE: f64 = 30.0;

/// Smallest relative difference that is told: above what half precision does to constant pixels.
const LEAST_EFFECT: f64 = 2e-3;

/// Variance of S, its parts and its third moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spread {
    pub(crate) variance: f64,
    /// The reference's part in it.
    pub(crate) reference: f64,
    /// Third central moment of S.
    pub(crate) third: f64,
}

/// How S spreads, and the effective number of pixels; `None` if the frame may have missed light.
fn spread(frame: &Frame, sums: &Sums, together: f64, between: f64) -> Result<Spread, f64> {
    let (second, third) = sums.central();
    let n = sums.pixels;
    let shown = second * n / (n - 1.0).max(1.0);
    // Low-discrepancy samples: s²/n is not the variance, only residuals are.
    let states = frame.color.variance.is_some() && frame.sampling == Sampling::Independent;
    let effective = |sum: f64, squares: f64| if squares > 0.0 { sum * sum / squares } else { 0.0 };
    let mut least = effective(sums.e2, sums.e4);
    let mut variance = shown.max(between);
    if states {
        least = effective(sums.stated, sums.stated2);
        variance = variance.max(together * (sums.stated + sums.reference));
    }
    let predicts = sums.predicted > 0.0;
    if predicts {
        least = least.min(effective(sums.predicted, sums.predicted2));
        variance = variance.max(together * (sums.predicted + sums.reference));
    }
    let missed = states && sums.silent > sums.constant;
    if least < LEAST_EFFECTIVE || (missed && !predicts) {
        return Err(least.min(if missed { LEAST_EFFECTIVE - 1.0 } else { least }));
    }
    Ok(Spread { variance, reference: together * sums.reference, third })
}

/// z of `s`, shrunk for skewness where that moves it towards zero.
pub(crate) fn shrunk(s: f64, variance: f64, third: f64) -> f64 {
    if variance <= 0.0 {
        return if s == 0.0 { 0.0 } else { f64::INFINITY.copysign(s) };
    }
    let z = s / variance.sqrt();
    let skew = third / variance.powf(1.5);
    // Monotone in z, so that large differences stay large whatever their skewness.
    let hall = z + skew * z * z / 3.0 + skew * skew * z.powi(3) / 27.0 + skew / 6.0;
    if hall * z <= 0.0 { 0.0 } else { z.abs().min(hall.abs()).copysign(z) }
}

/// The whole image.
pub(crate) fn whole(frame: &Frame, blocks: &[Sums]) -> Brightness {
    let all = Sums::total(blocks);
    if all.pixels < LEAST_EFFECTIVE || all.light <= 0.0 {
        return Brightness::NotTested;
    }
    match spread(frame, &all, all.together(), between(blocks, &all)) {
        Err(effective) => Brightness::TooFew { effective },
        Ok(spread) => {
            let z = shrunk(all.e, spread.variance, spread.third);
            let freedom = effective_freedom(frame, &all);
            Brightness::Tested { z, p: p_value(z, freedom), ratio: all.seen / all.light }
        }
    }
}

/// Size of the difference in standard errors from pixel to pixel alone: a systematic difference that varies over the image
/// passes for noise in the spread of the blocks.
pub(crate) fn by_pixels(frame: &Frame, blocks: &[Sums]) -> f64 {
    let all = Sums::total(blocks);
    let together = all.together();
    let mut variance = all.central().0.max(together * (all.predicted + all.reference));
    if frame.sampling == Sampling::Independent {
        variance = variance.max(together * (all.stated + all.reference));
    }
    if variance > 0.0 { (all.e / variance.sqrt()).abs() } else { 0.0 }
}

/// What [`crate::among`] pools: S, its variance without the reference's part, that part, the third moment.
pub(crate) fn pooled(frame: &Frame, blocks: &[Sums]) -> Option<[f64; 4]> {
    let all = Sums::total(blocks);
    let spread = spread(frame, &all, all.together(), between(blocks, &all)).ok()?;
    let own = (spread.variance - spread.reference).max(0.0);
    (own > 0.0 && all.light > 0.0).then_some([all.e, own, spread.reference, spread.third])
}

fn effective_freedom(frame: &Frame, sums: &Sums) -> u64 {
    let effective = match frame.color.variance.is_some() && sums.stated2 > 0.0 {
        true => sums.stated * sums.stated / sums.stated2,
        false => sums.e2 * sums.e2 / sums.e4.max(f64::MIN_POSITIVE),
    };
    effective.min(sums.pixels).max(2.0) as u64 - 1
}

/// Variance of S from the spread of the blocks' sums, which knows of correlated neighbours.
fn between(blocks: &[Sums], all: &Sums) -> f64 {
    let used: Vec<&Sums> = blocks.iter().filter(|b| b.pixels > 0.0).collect();
    let count = used.len() as f64;
    if count < LEAST_EFFECTIVE {
        return 0.0;
    }
    let mean = all.e / all.pixels;
    used.iter().map(|b| (b.e - b.pixels * mean).powi(2)).sum::<f64>() * count / (count - 1.0)
}

/// What a reader must know: the image, or else the blocks that differ.
pub(crate) fn findings(
    against: &Against<'_>,
    frame: &Frame,
    blocks: &[Sums],
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
fn local(against: &Against<'_>, frame: &Frame, blocks: &[Sums]) -> Option<Finding> {
    let together = Sums::total(blocks).together();
    let mut tested = Vec::new();
    for (index, sums) in blocks.iter().enumerate() {
        // A block cannot show how skewed it is where light is rare; the frame's own spread and the reference's must both say.
        if sums.light <= 0.0 || frame.color.variance.is_none() || sums.predicted2 <= 0.0 && !against.exact {
            continue;
        }
        if let Ok(spread) = spread(frame, sums, together, 0.0) {
            let z = shrunk(sums.e, spread.variance, spread.third);
            let freedom = effective_freedom(frame, sums)
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
