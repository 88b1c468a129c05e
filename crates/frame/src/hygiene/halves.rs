//! Half-buffer values that are not finite.

use crate::{Estimate, Finding, FindingKind, Samples};

use super::{Hygiene, share_too_large};

/// Makes up unknown values of the halves of pixels that have a mean, so that (n_A·A + n_B·B)/n stays the mean. `false` if
/// too many are unknown: the halves are to be dropped.
pub(super) fn clean(
    layer: &str,
    estimate: &mut Estimate,
    without: &[bool],
    samples: &Samples,
    report: &mut Hygiene,
) -> bool {
    let Some([a, b]) = &mut estimate.halves else { return true };
    let channels = estimate.mean.channels();
    let present = without.iter().filter(|&&none| !none).count();
    let mut pixels = vec![false; without.len()];
    let mut unknown = 0;
    for c in 0..channels {
        for (p, (a, b)) in a.plane(c).iter().zip(b.plane(c)).enumerate().filter(|(p, _)| !without[*p]) {
            let bad = usize::from(!a.is_finite()) + usize::from(!b.is_finite());
            pixels[p] |= bad > 0;
            unknown += bad;
        }
    }
    report.unknown_halves += unknown;
    if unknown == 0 {
        return true;
    }
    let of = 2 * channels * present;
    let count = pixels.iter().filter(|&&p| p).count() as f64;
    if share_too_large(unknown, of) {
        let text = format!("the halves were dropped: {unknown} of {of} of their values are not finite");
        report.findings.push(Finding::new(FindingKind::HalvesDropped, layer, text).with_value(count));
        return false;
    }
    let text =
        format!("{unknown} of {of} values of the halves are not finite and were made up from the mean");
    report.findings.push(Finding::new(FindingKind::UnknownHalves, layer, text).with_value(count));
    for c in 0..channels {
        let (mean, a, b) = (estimate.mean.plane(c), a.plane_mut(c), b.plane_mut(c));
        for p in (0..pixels.len()).filter(|&p| pixels[p]) {
            let (in_a, in_b) = samples.halves_at(p);
            let rest = |other: f32, in_other: u32, own: u32| {
                let n = f64::from(own) + f64::from(in_other);
                let value =
                    (n * f64::from(mean[p]) - f64::from(in_other) * f64::from(other)) / f64::from(own);
                Some(value as f32).filter(|v| v.is_finite())
            };
            (a[p], b[p]) = match (a[p].is_finite(), b[p].is_finite()) {
                (true, true) => (a[p], b[p]),
                (true, false) => rest(a[p], in_a, in_b).map_or((mean[p], mean[p]), |b| (a[p], b)),
                (false, true) => rest(b[p], in_b, in_a).map_or((mean[p], mean[p]), |a| (a, b[p])),
                (false, false) => (mean[p], mean[p]),
            };
        }
    }
    true
}
