//! Are the errors of frame and reference independent?
//!
//! With half buffers A and B on both sides: Σ (x_A − x_B)(r_A − r_B), whose factors are free of the picture and symmetric
//! about zero, is symmetric about zero if frame and reference are independent, whatever the law of the samples. Frames
//! whose samples are the first of the reference's, split by parity, have the correlation √(n/n_r) instead. Without half
//! buffers of the frame: Σ (x − r̄)(r_A − r_B), which finds samples that are in one half of the reference only. Both are
//! divided by the root mean square of their factors around, so that bright spots do not rule, and by the larger of the
//! standard errors over pixels and over blocks.

use noisefloor_frame::{Finding, FindingKind, Frame, Image};
use noisefloor_stats::instrument::{Correlation, correlation};

use crate::against::{Against, grey};
use crate::chance::{ALPHA, p_value};
use crate::sums::sums;

/// Smallest correlation that is told.
const LEAST_CORRELATION: f64 = 0.03;

pub(crate) fn frame(against: &Against<'_>, frame: &Frame, invalid: &[bool]) -> Option<Finding> {
    let r = &against.reference.frame.color;
    if let Some([r_a, r_b]) = &r.halves {
        let reference = |p: usize| difference(r_a, r_b, p);
        let usable = |p: usize| against.usable(p, invalid);
        let mut tests = Vec::new();
        if let Some([a, b]) = &frame.color.halves {
            tests.push(correlation(&against.blocks, usable, |p| difference(a, b, p), reference));
        }
        let centre = |p: usize| f64::from(grey(&frame.color.mean, p)) - f64::from(grey(&r.mean, p));
        tests.push(correlation(&against.blocks, usable, centre, reference));
        let worst = tests.into_iter().flatten().max_by(|a, b| a.z.abs().total_cmp(&b.z.abs()));
        if let Some(Correlation { rho, z, freedom }) = worst
            && rho.abs() >= LEAST_CORRELATION
            && p_value(z, freedom) <= ALPHA
        {
            return Some(told(rho, z));
        }
    }
    if r.halves.is_some() && frame.color.halves.is_some() {
        return None;
    }
    crate::variance::shared(against, frame, &sums(against, frame, invalid))
}

fn told(rho: f64, z: f64) -> Finding {
    let text = format!(
        "its errors and the reference's are correlated ({rho:.2}, {:.1} standard errors): they share samples",
        z.abs()
    );
    Finding::new(FindingKind::Dependent, "", text).with_value(z).with_standard_errors(z.abs())
}

fn difference(a: &Image, b: &Image, pixel: usize) -> f64 {
    f64::from(grey(a, pixel)) - f64::from(grey(b, pixel))
}
