//! Is the stated variance the one that the distance to the reference shows?
//!
//! The mean of (x−r)² is v + v_r if frame and reference are independent and have one mean: an exact expectation for every
//! law of samples, since s²/n is unbiased. Sums are over the image with the weight w² of the brightness around. Where light
//! is rare, few pixels make such a sum, so a factor is only told if the middle block agrees in direction, and it is at least
//! 2.

use noisefloor_frame::{Finding, FindingKind, Frame};
use noisefloor_stats::instrument::ResidualSums;

use crate::against::Against;
use crate::chance::{ALPHA, p_value};
use crate::median::median;
use crate::number::number;

/// Smallest factor that is told, either way.
const LEAST_FACTOR: f64 = 2.0;

/// Ratio of sums over blocks with its standard error.
struct Ratio {
    /// Logarithm of the ratio.
    log: f64,
    error: f64,
    blocks: usize,
    /// The same of the middle block.
    middle: f64,
}

/// Stated over shown of `sides`, which tells both of a block.
fn ratio(blocks: &[ResidualSums], sides: impl Fn(&ResidualSums) -> (f64, f64)) -> Option<Ratio> {
    let all = ResidualSums::total(blocks);
    let (stated, shown) = sides(&all);
    if shown <= 0.0 || stated <= 0.0 || all.stated <= 0.0 {
        return None;
    }
    let used: Vec<&ResidualSums> = blocks.iter().filter(|b| b.pixels > 0.0).collect();
    let part = |b: &&ResidualSums| {
        let (own_stated, own_shown) = sides(b);
        (own_stated / stated - own_shown / shown).powi(2)
    };
    let spread: f64 = used.iter().map(part).sum();
    let mut logs: Vec<f64> = used
        .iter()
        .filter(|b| b.apart > 0.0 && b.stated + b.reference > 0.0)
        .map(|b| ((b.stated + b.reference) / b.apart).ln())
        .collect();
    Some(Ratio {
        log: (stated / shown).ln(),
        error: spread.sqrt(),
        blocks: used.len(),
        middle: median(&mut logs)?,
    })
}

/// `differs`: the frame's mean is known to differ from the reference's, so that a large distance shows nothing.
pub(crate) fn frame(
    against: &Against<'_>,
    frame: &Frame,
    blocks: &[ResidualSums],
    differs: bool,
) -> Option<Finding> {
    let n = f64::from(frame.samples.total().uniform()?);
    // `apart` is Σ w²(x−r)²/9 over channels, of which the frame's part is what is left without the reference's.
    let found = ratio(blocks, |b| (b.stated, b.apart - b.reference))?;
    if n < 2.0 || found.blocks < 16 {
        return None;
    }
    let z = found.log / found.error.max(1e-12);
    let significant = p_value(z, found.blocks as u64 - 1) <= ALPHA;
    let agrees = found.middle * found.log > 0.0 && found.middle.abs() >= 0.5 * LEAST_FACTOR.ln();
    // An unknown variance of the reference makes the distance larger than the frame's variance says.
    let known = against.exact
        || against.reference.frame.color.variance.is_some()
        || against.spp.is_some_and(|long| long >= 8.0 * n);
    let too_small = found.log < 0.0;
    if !significant || !agrees || (too_small && (differs || !known)) {
        return None;
    }
    if found.log.abs() < LEAST_FACTOR.ln() {
        return None;
    }
    let factor = found.log.exp();
    let near = |power: f64| (found.log - power * n.ln()).abs() <= 0.35 * n.ln() + 2.0 * found.error;
    let why = if n >= 3.0 && near(1.0) {
        format!(
            "; this is about the {n} samples of a pixel: the variance of one sample, not divided by their number?"
        )
    } else if n >= 3.0 && near(-1.0) {
        format!("; this is about one over the {n} samples of a pixel: divided by their number twice?")
    } else if too_small {
        "; it is too small, or frame and reference differ by more than noise".into()
    } else {
        String::new()
    };
    let text = format!(
        "the stated variance is {} times that which the distance to the reference shows{why}",
        number(factor)
    );
    Some(
        Finding::new(FindingKind::VarianceAgainstReference, "", text)
            .with_value(factor)
            .with_standard_errors(z.abs()),
    )
}

/// Where no half buffers can show that frame and reference share samples: a frame whose samples are among the reference's
/// has (x−r)² = v − v_r. Told only if the distance is as much too small as that.
pub(crate) fn shared(against: &Against<'_>, frame: &Frame, blocks: &[ResidualSums]) -> Option<Finding> {
    let n = f64::from(frame.samples.total().uniform()?);
    let share = n / against.spp?;
    if against.exact || !(0.1..1.0).contains(&share) || n < 2.0 {
        return None;
    }
    let all = ResidualSums::total(blocks);
    let found = ratio(blocks, |b| (b.stated + b.reference, b.apart))?;
    // v_r must be that of so many samples, or nothing follows.
    if found.blocks < 16 || !(0.5..=2.0).contains(&(all.reference / (share * all.stated))) {
        return None;
    }
    let z = found.log / found.error.max(1e-12);
    let expected = ((1.0 + share) / (1.0 - share)).ln();
    let fits = (found.log - expected).abs() <= 3.0 * found.error + 0.2 * expected;
    let agrees = found.middle >= 0.5 * expected;
    if !fits || !agrees || z <= 0.0 || p_value(z, found.blocks as u64 - 1) > ALPHA {
        return None;
    }
    let text = format!(
        "its squared distance to the reference is {:.2} of what their variances add up to, as if its {n} samples were among \
         the reference's {:.0}: not independent",
        (-found.log).exp(),
        against.spp?
    );
    Some(Finding::new(FindingKind::Dependent, "", text).with_value(z).with_standard_errors(z))
}
