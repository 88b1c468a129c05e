//! Sums of one filter over the offsets of a row of neighbours, in registers.

use super::layout::{Factors, LANES, Lanes, TILE};
use super::rows::Rows;

/// Adds the row of neighbours to a filter's sums: those of its planes, then that of its weights.
#[inline(always)]
pub(super) fn add(pair: &Rows<'_>, filter: &Factors, shared: &[f32], factors: &mut [f32], sums: &mut [f32]) {
    let reach = filter.reach as isize;
    let (first, last) = (pair.columns.first.max(-reach), pair.columns.last.min(reach));
    let skipped = (first - pair.columns.first) as usize * TILE.0;
    let factors = &mut factors[..(last - first + 1) as usize];
    for (dx, factor) in (first..=last).zip(&mut *factors) {
        *factor = (filter.table[pair.dy.unsigned_abs()] * filter.table[dx.unsigned_abs()]) as f32;
    }
    let line = Line { pair, shared: &shared[skipped..], factors, first, last };
    let (mut k, averaged) = (0, pair.layout.averaged);
    // As many together as their sums stay in registers, the weights with the last.
    while k + 3 < averaged {
        line.sums::<3, false>(k, sums);
        k += 3;
    }
    match averaged - k {
        3 => line.sums::<3, true>(k, sums),
        2 => line.sums::<2, true>(k, sums),
        _ => line.sums::<1, true>(k, sums),
    }
}

/// The offsets of one filter in one row of neighbours.
struct Line<'a> {
    pair: &'a Rows<'a>,
    /// e^−D from the first of them on.
    shared: &'a [f32],
    /// Spatial factors of all of them.
    factors: &'a [f32],
    first: isize,
    last: isize,
}

impl Line<'_> {
    /// Adds Σ w·x of the planes from `k` on, and with `WEIGHTS` Σ w after them.
    #[inline(always)]
    fn sums<const N: usize, const WEIGHTS: bool>(&self, k: usize, to: &mut [f32]) {
        let mut rows = [&[][..]; N];
        for (i, row) in rows.iter_mut().enumerate() {
            *row = self.pair.others(2 * self.pair.layout.guides + k + i, self.first, self.last);
        }
        for x in (0..self.pair.columns.width).step_by(LANES) {
            let mut from = rows;
            for from in &mut from {
                *from = &from[x..][..self.factors.len() + LANES - 1];
            }
            let (mut sums, mut weights) = ([[0.0f32; LANES]; N], [0.0f32; LANES]);
            for (o, factor) in self.factors.iter().enumerate() {
                let w = self.weight(o, x, *factor);
                for i in 0..N {
                    let value = lanes(from[i], o);
                    for l in 0..LANES {
                        sums[i][l] = w[l].mul_add(value[l], sums[i][l]);
                    }
                }
                if WEIGHTS {
                    for l in 0..LANES {
                        weights[l] += w[l];
                    }
                }
            }
            for (i, sum) in sums.iter().enumerate() {
                add_to(&mut to[(k + i) * TILE.0 + x..][..LANES], sum);
            }
            if WEIGHTS {
                add_to(&mut to[(k + N) * TILE.0 + x..][..LANES], &weights);
            }
        }
    }

    /// w at offset number `o`, 0 below the range of normal numbers.
    #[inline(always)]
    fn weight(&self, o: usize, x: usize, factor: f32) -> Lanes {
        let mut w = lanes(self.shared, o * TILE.0 + x);
        for w in &mut w {
            let product = *w * factor;
            *w = if product >= f32::MIN_POSITIVE { product } else { 0.0 };
        }
        w
    }
}

#[inline(always)]
fn add_to(to: &mut [f32], sum: &Lanes) {
    for (to, sum) in to.iter_mut().zip(sum) {
        *to += sum;
    }
}

/// Values from `at` on. Copies, which share no memory with what is written, become vectors.
#[inline(always)]
fn lanes(values: &[f32], at: usize) -> Lanes {
    let mut out = [0.0; LANES];
    out.copy_from_slice(&values[at..][..LANES]);
    out
}
