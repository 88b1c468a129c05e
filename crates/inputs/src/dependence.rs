//! Are the errors of frame and reference independent?
//!
//! With half buffers A and B on both sides: Σ (x_A − x_B)(r_A − r_B), whose factors are free of the picture and symmetric
//! about zero, is symmetric about zero if frame and reference are independent, whatever the law of the samples. Frames
//! whose samples are the first of the reference's, split by parity, have the correlation √(n/n_r) instead. Without half
//! buffers of the frame: Σ (x − r̄)(r_A − r_B), which finds samples that are in one half of the reference only. Both are
//! divided by the root mean square of their factors around, so that bright spots do not rule, and by the larger of the
//! standard errors over pixels and over blocks.

use noisefloor_frame::{Finding, FindingKind, Frame, Image};

use crate::against::{Against, grey};
use crate::chance::{ALPHA, p_value};
use crate::sums::sums;

/// Smallest correlation that is told.
const LEAST_CORRELATION: f64 = 0.03;

pub(crate) fn frame(against: &Against<'_>, frame: &Frame, invalid: &[bool]) -> Option<Finding> {
    let r = &against.reference.frame.color;
    if let Some([r_a, r_b]) = &r.halves {
        let reference = |p: usize| difference(r_a, r_b, p);
        let mut tests = Vec::new();
        if let Some([a, b]) = &frame.color.halves {
            tests.push(correlation(against, invalid, |p| difference(a, b, p), reference));
        }
        let centre = |p: usize| f64::from(grey(&frame.color.mean, p)) - f64::from(grey(&r.mean, p));
        tests.push(correlation(against, invalid, centre, reference));
        let worst = tests.into_iter().flatten().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        if let Some((rho, z, blocks)) = worst
            && rho.abs() >= LEAST_CORRELATION
            && p_value(z, blocks) <= ALPHA
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

/// Correlation of two fields of errors about zero, its size in standard errors, and degrees of freedom.
fn correlation(
    against: &Against<'_>,
    invalid: &[bool],
    a: impl Fn(usize) -> f64,
    b: impl Fn(usize) -> f64,
) -> Option<(f64, f64, u64)> {
    let blocks = &against.blocks;
    let pixels = against.reference.mean().pixels();
    let mut squares = vec![[0.0f64; 3]; blocks.count()];
    for pixel in (0..pixels).filter(|&p| against.usable(p, invalid)) {
        let (a, b) = (a(pixel), b(pixel));
        if a.is_finite() && b.is_finite() {
            let s = &mut squares[blocks.of(pixel)];
            *s = [s[0] + a * a, s[1] + b * b, s[2] + 1.0];
        }
    }
    // Products in units of the root mean squares around: [Σ, Σ of squares, pixels] per block.
    let mut products = vec![[0.0f64; 3]; blocks.count()];
    for pixel in (0..pixels).filter(|&p| against.usable(p, invalid)) {
        let block = blocks.of(pixel);
        let [aa, bb, n] = squares[block];
        let (a, b) = (a(pixel), b(pixel));
        if aa > 0.0 && bb > 0.0 && a.is_finite() && b.is_finite() {
            let p = a * b * n / (aa * bb).sqrt();
            let s = &mut products[block];
            *s = [s[0] + p, s[1] + p * p, s[2] + 1.0];
        }
    }
    products.retain(|p| p[2] > 0.0);
    let all = products.iter().fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
    let [sum, squares, n] = all;
    if products.len() < 16 || n < 100.0 || squares <= 0.0 {
        return None;
    }
    let mean = sum / n;
    let count = products.len() as f64;
    let between = products.iter().map(|p| (p[0] - p[2] * mean).powi(2)).sum::<f64>() * count / (count - 1.0);
    // Uncentred over pixels: the bound for symmetric terms.
    let error = squares.max(between).sqrt();
    Some((mean, sum / error, products.len() as u64 - 1))
}
