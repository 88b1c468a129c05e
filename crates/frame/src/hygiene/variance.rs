//! Variances that are unknown: not finite, or negative.

use crate::inspect::Precision;
use crate::{Finding, FindingKind, Image};

use super::fill::Rings;
use super::{Hygiene, share_too_large};

/// Unknown variances by cause.
#[derive(Debug, Default)]
struct Causes {
    negative: usize,
    /// +∞.
    infinite: usize,
    nan: usize,
    /// Most negative value.
    least: f32,
}

impl Causes {
    fn total(&self) -> usize {
        self.negative + self.infinite + self.nan
    }

    fn words(&self, overflow: bool) -> String {
        let mut out = Vec::new();
        if self.negative > 0 {
            out.push(format!("{} are negative, down to {:e}", self.negative, self.least));
        }
        if self.infinite > 0 {
            let why = if overflow { " (overflowed half precision)" } else { "" };
            out.push(format!("{} are infinite{why}", self.infinite));
        }
        if self.nan > 0 {
            out.push(format!("{} are NaN", self.nan));
        }
        out.join(", ")
    }
}

/// Fills the unknown variances of pixels with a mean, and those of the others, from known ones. `without` flags
/// pixels without a mean, `of_half_file` says whether the mean looks like half floats. Returns the flags of the
/// pixels with a mean and unknown variance, or `None` if too many are unknown.
pub(super) fn clean(
    layer: &str,
    image: &mut Image,
    without: &[bool],
    of_half_file: bool,
    report: &mut Hygiene,
) -> Option<Vec<bool>> {
    let mut causes = Causes::default();
    let mut pixels = vec![false; without.len()];
    let known = |v: f32| v.is_finite() && v >= 0.0;
    for plane in image.planes() {
        for (p, &value) in plane.iter().enumerate().filter(|(p, v)| !without[*p] && !known(**v)) {
            pixels[p] = true;
            causes.negative += usize::from(value < 0.0);
            causes.infinite += usize::from(value == f32::INFINITY);
            causes.nan += usize::from(value.is_nan());
            causes.least = causes.least.min(value); // a NaN leaves it as it is
        }
    }
    let unknown = causes.total();
    report.unknown_variances += unknown;
    report.negative_variances += causes.negative;
    let of = image.channels() * without.iter().filter(|&&none| !none).count();
    let overflow = causes.infinite > 0 && overflowed(image, of_half_file);
    let count = pixels.iter().filter(|&&p| p).count() as f64;
    let mut tell =
        |kind, text: String| report.findings.push(Finding::new(kind, layer, text).with_value(count));
    let dropped = share_too_large(unknown, of);
    if overflow {
        let text = format!("{} variances overflowed half precision", causes.infinite);
        tell(FindingKind::VarianceOverflow, text);
    }
    if dropped {
        let text = format!(
            "the variance was dropped: {unknown} of {of} variances are unknown ({})",
            causes.words(overflow)
        );
        tell(FindingKind::VarianceDropped, text);
        return None;
    }
    if unknown > 0 {
        let text = format!(
            "{unknown} of {of} variances are unknown ({}) and were filled from their neighbours",
            causes.words(overflow)
        );
        let kind = if causes.negative == unknown {
            FindingKind::NegativeVariance
        } else {
            FindingKind::UnknownVariance
        };
        let value = if causes.negative == unknown { unknown as f64 } else { count };
        report.findings.push(Finding::new(kind, layer, text).with_value(value));
        if causes.negative > 0 && kind != FindingKind::NegativeVariance {
            let text =
                format!("{} variances are negative, down to {:e}: unknown", causes.negative, causes.least);
            let found = Finding::new(FindingKind::NegativeVariance, layer, text);
            report.findings.push(found.with_value(causes.negative as f64));
        }
    }
    let width = image.width();
    for plane in image.planes_mut() {
        let bad: Vec<bool> = plane.iter().zip(without).map(|(&v, &none)| none || !known(v)).collect();
        if bad.contains(&true) {
            match Rings::new(width, &bad) {
                Some(rings) => rings.fill(plane),
                // A channel without a single known variance of an image with several channels.
                None => plane.fill(0.0),
            }
        }
    }
    Some(pixels)
}

/// Whether infinite values are those that a half float cannot hold: the finite ones, or if there are none the means
/// beside them, are all half floats.
fn overflowed(image: &Image, of_half_file: bool) -> bool {
    let finite = image.data().iter().any(|v| v.is_finite() && *v != 0.0);
    if finite { Precision::of(image.data()).is_half() } else { of_half_file }
}
