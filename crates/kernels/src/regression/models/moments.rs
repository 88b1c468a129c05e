//! Sums over the pixels of a window.

use super::size::{COLUMNS, LANES, Lanes};
use super::solve::Square;

/// Rows and columns of sums that are made together: as many as stay in registers.
const TALL: usize = 2;
const WIDE: usize = 3;

/// Columns of X, `stride` lanes after each other, of which the first `groups` are in use.
#[derive(Clone, Copy)]
pub(super) struct Design<'a> {
    pub x: &'a [Lanes],
    pub stride: usize,
    pub groups: usize,
}

impl<'a> Design<'a> {
    #[inline(always)]
    pub fn column(&self, i: usize) -> &'a [Lanes] {
        &self.x[i * self.stride..][..self.groups]
    }
}

/// Σ weight·a·b of two columns and three, in lanes.
// Loops alone: a closure handed to a function of the standard library may be compiled without the instruction set.
#[inline(always)]
fn block(weight: &[Lanes], a: [&[Lanes]; TALL], b: [&[Lanes]; WIDE]) -> [[f64; WIDE]; TALL] {
    let mut sums = [[[0.0f32; LANES]; WIDE]; TALL];
    let columns = weight.iter().zip(a[0]).zip(a[1]).zip(b[0]).zip(b[1]).zip(b[2]);
    for (((((w, a0), a1), b0), b1), b2) in columns {
        for l in 0..LANES {
            let (a0, a1) = (w[l] * a0[l], w[l] * a1[l]);
            sums[0][0][l] = a0.mul_add(b0[l], sums[0][0][l]);
            sums[0][1][l] = a0.mul_add(b1[l], sums[0][1][l]);
            sums[0][2][l] = a0.mul_add(b2[l], sums[0][2][l]);
            sums[1][0][l] = a1.mul_add(b0[l], sums[1][0][l]);
            sums[1][1][l] = a1.mul_add(b1[l], sums[1][1][l]);
            sums[1][2][l] = a1.mul_add(b2[l], sums[1][2][l]);
        }
    }
    let mut out = [[0.0; WIDE]; TALL];
    for i in 0..TALL {
        for j in 0..WIDE {
            out[i][j] = total(&sums[i][j]);
        }
    }
    out
}

/// Lanes added up in one order, by halves.
#[inline(always)]
pub(super) fn total(lanes: &Lanes) -> f64 {
    let (mut eight, mut four) = ([0.0f32; 8], [0.0f32; 4]);
    for l in 0..8 {
        eight[l] = lanes[l] + lanes[l + 8];
    }
    for l in 0..4 {
        four[l] = eight[l] + eight[l + 4];
    }
    f64::from((four[0] + four[2]) + (four[1] + four[3]))
}

/// Σ weight·x xᵀ. `fine` sums in `f64`: no digit is lost to the order, but slowly.
#[inline(always)]
pub(super) fn square(weight: &[Lanes], design: Design<'_>, fine: bool) -> Square {
    let mut out = Square::default();
    if fine {
        for i in 0..COLUMNS {
            for j in i..COLUMNS {
                out.0[i][j] = exact(weight, design.column(i), design.column(j));
            }
        }
    } else {
        for i in (0..COLUMNS).step_by(TALL) {
            let mut j = i;
            while j < COLUMNS {
                // The last block may begin earlier than it must.
                let at = if j + WIDE > COLUMNS { COLUMNS - WIDE } else { j };
                let a = [design.column(i), design.column(i + 1)];
                let b = [design.column(at), design.column(at + 1), design.column(at + 2)];
                let sums = block(weight, a, b);
                for r in 0..TALL {
                    for c in 0..WIDE {
                        out.0[i + r][at + c] = sums[r][c];
                    }
                }
                j += WIDE;
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
    design: Design<'_>,
    y: [&[Lanes]; WIDE],
    fine: bool,
) -> [[f64; COLUMNS]; WIDE] {
    let mut out = [[0.0; COLUMNS]; WIDE];
    for i in (0..COLUMNS).step_by(TALL) {
        let a = [design.column(i), design.column(i + 1)];
        if fine {
            for r in 0..TALL {
                for c in 0..WIDE {
                    out[c][i + r] = exact(weight, a[r], y[c]);
                }
            }
        } else {
            let sums = block(weight, a, y);
            for r in 0..TALL {
                for c in 0..WIDE {
                    out[c][i + r] = sums[r][c];
                }
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

/// Xβ of three planes; `fine` in `f64`, where slopes of columns that are nearly one cancel.
#[inline(always)]
pub(super) fn predict(
    design: Design<'_>,
    slopes: &[[f64; COLUMNS]; WIDE],
    out: [&mut [Lanes]; WIDE],
    fine: bool,
) {
    if fine {
        for (slopes, out) in slopes.iter().zip(out) {
            for (group, out) in out.iter_mut().enumerate() {
                for l in 0..LANES {
                    let mut sum = 0.0;
                    for i in 0..COLUMNS {
                        sum += slopes[i] * f64::from(design.x[i * design.stride + group][l]);
                    }
                    out[l] = sum as f32;
                }
            }
        }
        return;
    }
    let mut factors = [[0.0f32; COLUMNS]; WIDE];
    for c in 0..WIDE {
        for i in 0..COLUMNS {
            factors[c][i] = slopes[c][i] as f32;
        }
    }
    let [r, g, b] = out;
    for (group, ((r, g), b)) in r.iter_mut().zip(g).zip(b).enumerate() {
        // The first column is 1.
        let mut sums = [[factors[0][0]; LANES], [factors[1][0]; LANES], [factors[2][0]; LANES]];
        for i in 1..COLUMNS {
            let x = &design.x[i * design.stride + group];
            for c in 0..WIDE {
                for l in 0..LANES {
                    sums[c][l] = factors[c][i].mul_add(x[l], sums[c][l]);
                }
            }
        }
        (*r, *g, *b) = (sums[0], sums[1], sums[2]);
    }
}

/// Half of the columns.
const HALF: usize = COLUMNS / 2;

/// xᵀ Q x for every row of X, at least 0; `fine` in `f64`, where entries of Q are large and cancel.
#[inline(always)]
pub(super) fn quadratic(design: Design<'_>, q: &Square, out: &mut [Lanes], fine: bool) {
    if fine {
        for (group, out) in out.iter_mut().enumerate() {
            for l in 0..LANES {
                let mut sum = 0.0;
                for i in 0..COLUMNS {
                    let mut inner = 0.0;
                    for j in 0..COLUMNS {
                        inner += q.0[i][j] * f64::from(design.x[j * design.stride + group][l]);
                    }
                    sum += inner * f64::from(design.x[i * design.stride + group][l]);
                }
                out[l] = if sum > 0.0 { sum as f32 } else { 0.0 };
            }
        }
        return;
    }
    // Of each half of the columns its own square, and twice what both have together.
    let mut factors = [[0.0f32; COLUMNS]; COLUMNS];
    for i in 0..COLUMNS {
        for j in 0..COLUMNS {
            let twice = if i < HALF && j >= HALF { 2.0 } else { 1.0 };
            factors[i][j] = (twice * q.0[i][j]) as f32;
        }
    }
    for (group, out) in out.iter_mut().enumerate() {
        let mut sum = [0.0f32; LANES];
        for first in [0, HALF] {
            let mut inner = [[0.0f32; LANES]; HALF];
            for j in first..COLUMNS {
                let x = &design.x[j * design.stride + group];
                for i in 0..HALF {
                    for l in 0..LANES {
                        inner[i][l] = factors[first + i][j].mul_add(x[l], inner[i][l]);
                    }
                }
            }
            for i in 0..HALF {
                let x = &design.x[(first + i) * design.stride + group];
                for l in 0..LANES {
                    sum[l] = inner[i][l].mul_add(x[l], sum[l]);
                }
            }
        }
        for l in 0..LANES {
            out[l] = if sum[l] > 0.0 { sum[l] } else { 0.0 };
        }
    }
}
