//! Sums over the pixels of a window.

use super::solve::Square;
use super::{COLUMNS, LANES, Lanes};

/// Σ weight·a·b of every pair of columns, in lanes.
#[inline(always)]
fn block<const A: usize, const B: usize>(
    weight: &[Lanes],
    a: [&[Lanes]; A],
    b: [&[Lanes]; B],
) -> [[f64; B]; A] {
    let mut sums = [[[0.0f32; LANES]; B]; A];
    let n = weight.len();
    let (a, b) = (a.map(|column| &column[..n]), b.map(|column| &column[..n]));
    for g in 0..n {
        for i in 0..A {
            let mut weighted = [0.0f32; LANES];
            for l in 0..LANES {
                weighted[l] = weight[g][l] * a[i][g][l];
            }
            for j in 0..B {
                for l in 0..LANES {
                    sums[i][j][l] = weighted[l].mul_add(b[j][g][l], sums[i][j][l]);
                }
            }
        }
    }
    sums.map(|row| row.map(|lanes| total(&lanes)))
}

/// Lanes added up in one order.
#[inline(always)]
pub(super) fn total(lanes: &Lanes) -> f64 {
    lanes.iter().fold(0.0, |sum, lane| sum + f64::from(*lane))
}

/// Σ weight·x xᵀ of columns that lie `stride` after each other. `fine` sums in `f64`: no digit is lost to the order, but slowly.
#[inline(always)]
pub(super) fn square(weight: &[Lanes], x: &[Lanes], stride: usize, fine: bool) -> Square {
    let column = |i: usize| &x[i * stride..][..weight.len()];
    let mut out = Square::default();
    if fine {
        for i in 0..COLUMNS {
            for j in i..COLUMNS {
                out.0[i][j] = exact(weight, column(i), column(j));
            }
        }
    } else {
        for i in (0..COLUMNS).step_by(2) {
            for j in (i..COLUMNS).step_by(3) {
                // The last block may begin earlier than it must.
                let j = j.min(COLUMNS - 3);
                let sums = block(weight, [0, 1].map(|d| column(i + d)), [0, 1, 2].map(|d| column(j + d)));
                for (a, row) in sums.iter().enumerate() {
                    out.0[i + a][j..j + 3].copy_from_slice(row);
                }
            }
        }
    }
    for i in 0..COLUMNS {
        for j in 0..i {
            out.0[i][j] = out.0[j][i];
        }
    }
    out
}

/// Σ weight·x·y of three planes.
#[inline(always)]
pub(super) fn sides(
    weight: &[Lanes],
    x: &[Lanes],
    stride: usize,
    y: [&[Lanes]; 3],
    fine: bool,
) -> [[f64; COLUMNS]; 3] {
    let column = |i: usize| &x[i * stride..][..weight.len()];
    let mut out = [[0.0; COLUMNS]; 3];
    for i in (0..COLUMNS).step_by(2) {
        if fine {
            for (c, out) in out.iter_mut().enumerate() {
                out[i] = exact(weight, column(i), y[c]);
                out[i + 1] = exact(weight, column(i + 1), y[c]);
            }
        } else {
            let sums = block(weight, [0, 1].map(|d| column(i + d)), y);
            for (c, out) in out.iter_mut().enumerate() {
                out[i] = sums[0][c];
                out[i + 1] = sums[1][c];
            }
        }
    }
    out
}

/// Σ weight·a·b in `f64`.
#[inline(always)]
fn exact(weight: &[Lanes], a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sum = 0.0;
    for ((weight, a), b) in weight.iter().zip(a).zip(b) {
        for l in 0..LANES {
            sum += f64::from(weight[l]) * f64::from(a[l]) * f64::from(b[l]);
        }
    }
    sum
}
