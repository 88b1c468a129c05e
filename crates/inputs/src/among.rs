//! The frames of a scene among each other, from their sketches.

use noisefloor_frame::{Finding, FindingKind};
use noisefloor_stats::instrument::shrunk;

use crate::Sketch;
use crate::against::Against;
use crate::chance::{ALPHA, SCENE_ALPHA, p_value};

/// Smallest relative difference of all frames together that is told.
const LEAST_EFFECT: f64 = 1e-3;

/// Smallest correlation of two frames that is told.
const LEAST_CORRELATION: f64 = 0.1;

/// Holds the frames of a scene against each other; each with its name, such as `16 spp, replicate 1`.
///
/// * Equal planes of any two.
/// * Correlated errors of any two: the half buffers' differences where both have them, else the distances to the
///   reference, whose own noise is then in both.
/// * Brightness of all frames together, which sees a difference that no single one shows.
#[must_use]
pub fn among(against: &Against<'_>, frames: &[(String, Sketch)]) -> Vec<Finding> {
    let mut out = Vec::new();
    for (k, (name, sketch)) in frames.iter().enumerate() {
        for (other_name, other) in &frames[..k] {
            let subject = format!("{other_name} and {name}");
            if let Some((a, b)) = other.planes.equal(&sketch.planes) {
                let text = format!("{a} of one is bit for bit {b} of the other: not independent");
                out.push(Finding::new(FindingKind::EqualData, subject, text));
            } else if let Some((rho, z)) = correlated(against, other, sketch, frames.len()) {
                let text = format!(
                    "their errors are correlated ({rho:.2}, {z:.1} standard errors): they share samples"
                );
                let found = Finding::new(FindingKind::Dependent, subject, text);
                out.push(found.with_value(z).with_standard_errors(z));
            }
        }
    }
    out.extend(brightness(against, frames));
    out
}

/// Correlation of the errors of two frames, and its size in standard errors, if it is more than chance.
fn correlated(against: &Against<'_>, a: &Sketch, b: &Sketch, frames: usize) -> Option<(f64, f64)> {
    let halves = !a.halves.is_empty() && a.halves.len() == b.halves.len();
    let (x, y, common) = if halves {
        (&a.halves, &b.halves, 0.0)
    } else {
        let known = a.distance.len() == b.distance.len() && a.sound && b.sound && !a.differs && !b.differs;
        // The noise of the reference is in both distances.
        let common = match against.exact {
            true => 0.0,
            false => (a.spp * b.spp).sqrt() / against.spp?,
        };
        if !known {
            return None;
        }
        (&a.distance, &b.distance, common)
    };
    let (mut sum, mut squares, mut xx, mut yy, mut n) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (&x, &y) in x.iter().zip(y).filter(|(x, y)| x.is_finite() && y.is_finite()) {
        let (x, y) = (f64::from(x), f64::from(y));
        sum += x * y;
        squares += (x * y).powi(2);
        xx += x * x;
        yy += y * y;
        n += 1.0;
    }
    if n < 100.0 || squares <= 0.0 {
        return None;
    }
    let scale = (xx * yy).sqrt();
    let rho = sum / scale - common;
    let z = rho * scale / squares.sqrt();
    let pairs = (frames * (frames - 1) / 2).max(1) as f64;
    // Shared samples correlate by this much; distances may be correlated by less for other reasons.
    let expected = (a.spp.min(b.spp) / a.spp.max(b.spp)).sqrt();
    let least = if halves { LEAST_CORRELATION } else { LEAST_CORRELATION.max(0.5 * expected) };
    let significant = z > 0.0 && p_value(z, n as u64 - 1) * pairs <= ALPHA;
    (rho >= least && significant).then_some((rho, z))
}

/// All frames together: Σ S/V over Σ 1/V, whose variance is 1/Σ(1/V) + V_r with V_r the reference's common part.
fn brightness(against: &Against<'_>, frames: &[(String, Sketch)]) -> Option<Finding> {
    if frames.len() < 2 || frames.iter().any(|(_, s)| s.differs || !s.sound) {
        return None;
    }
    if !against.exact && against.reference.frame.color.variance.is_none() {
        return None;
    }
    let (mut weight, mut sum, mut third, mut common) = (0.0, 0.0, 0.0, 0.0f64);
    for [s, own, reference, skew] in frames.iter().filter_map(|(_, sketch)| sketch.brightness) {
        weight += 1.0 / own; // positive by construction
        sum += s / own;
        third += skew / own.powi(3);
        common = common.max(reference);
    }
    if weight <= 0.0 {
        return None;
    }
    let (s, variance) = (sum / weight, 1.0 / weight + common);
    let z = shrunk(s, variance, third / weight.powi(3));
    let light: f64 = against.light();
    let relative = s / light;
    let certain = p_value(z, 1000) <= SCENE_ALPHA && relative.abs() >= LEAST_EFFECT;
    certain.then(|| {
        let how = if z > 0.0 { "brighter" } else { "darker" };
        let text = format!(
            "the frames together are {:.2} % {how} than the reference, {:.1} standard errors",
            100.0 * relative.abs(),
            z.abs()
        );
        Finding::new(FindingKind::Brightness, "", text).with_value(z).with_standard_errors(z.abs())
    })
}
