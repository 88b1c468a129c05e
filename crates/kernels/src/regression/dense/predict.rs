//! What models say of the pixels of their windows.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use super::moments::Area;
use crate::engine::{Plane, Simd};

/// One row of the tile and one row of its windows.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// Where the row's pixels are in the area, and their neighbours at dx = −R.
    pub here: usize,
    pub there: usize,
    /// Where weights of dx = −R start, and how far those of the next dx are.
    pub weights: usize,
    pub step: usize,
    /// Where the sums of those neighbours start, and the distance of their planes: three colours, then Σ w.
    pub sums: usize,
    pub plane: usize,
    pub dy: isize,
    pub reach: isize,
    /// Columns of the tile.
    pub width: usize,
    /// Distance of the coefficients' planes: column by column of the model, three colours each.
    pub wide: usize,
}

/// The models of a row.
pub(super) struct Models<'a> {
    pub features: usize,
    pub area: Area<'a>,
    pub weights: &'a Plane,
    pub coefficients: &'a Plane<f64>,
}

impl Models<'_> {
    /// Adds w·x·β and w to the sums of one row of all windows. `base` is memory for three rows.
    #[inline(always)]
    pub fn add<S: Simd>(&self, s: S, line: Line, base: &mut Plane<f64>, sums: &mut Plane<f64>) {
        let lanes = S::DOUBLES;
        let dy = s.splat_double(line.dy as f64);
        let mut x = 0;
        while x < line.width {
            for c in 0..3 {
                let constant = s.load_doubles(self.coefficients, c * line.wide + x);
                let slope = s.load_doubles(self.coefficients, (6 + c) * line.wide + x);
                s.store_doubles(base, c * line.wide + x, s.fma_doubles(slope, dy, constant));
            }
            x += lanes;
        }
        // Two neighbours at a time share what they load; far enough apart that their sums do not overlap.
        let side = 2 * line.reach as usize + 1;
        let half = side.div_ceil(2);
        for i in 0..half {
            let mut x = 0;
            while x < line.width {
                if i + half < side {
                    self.some::<S, 2>(s, &line, [i, i + half], x, base, sums);
                } else {
                    self.some::<S, 1>(s, &line, [i], x, base, sums);
                }
                x += lanes;
            }
        }
    }

    #[inline(always)]
    fn some<S: Simd, const N: usize>(
        &self,
        s: S,
        line: &Line,
        offsets: [usize; N],
        x: usize,
        base: &Plane<f64>,
        sums: &mut Plane<f64>,
    ) {
        let zero = s.splat_double(0.0);
        let mut weights = [zero; N];
        let mut any = false;
        for k in 0..N {
            weights[k] = s.load_widened(self.weights, line.weights + offsets[k] * line.step + x);
            any |= s.any_double(weights[k]);
        }
        if !any {
            return;
        }
        let mut values = [[zero; 3]; N];
        for c in 0..3 {
            let constant = s.load_doubles(base, c * line.wide + x);
            let slope = s.load_doubles(self.coefficients, (3 + c) * line.wide + x);
            for k in 0..N {
                let dx = s.splat_double((offsets[k] as isize - line.reach) as f64);
                values[k][c] = s.fma_doubles(slope, dx, constant);
            }
        }
        for j in 0..self.features {
            let plane = j * self.area.plane;
            let here = s.load_doubles(self.area.planes, plane + line.here + x);
            let mut differences = [zero; N];
            for k in 0..N {
                let there = s.load_doubles(self.area.planes, plane + line.there + offsets[k] + x);
                differences[k] = s.sub_doubles(there, here);
            }
            for c in 0..3 {
                let slope = s.load_doubles(self.coefficients, (9 + 3 * j + c) * line.wide + x);
                for k in 0..N {
                    values[k][c] = s.fma_doubles(slope, differences[k], values[k][c]);
                }
            }
        }
        for k in 0..N {
            let at = line.sums + offsets[k] + x;
            for c in 0..3 {
                let old = s.load_doubles(sums, c * line.plane + at);
                s.store_doubles(sums, c * line.plane + at, s.fma_doubles(weights[k], values[k][c], old));
            }
            let old = s.load_doubles(sums, 3 * line.plane + at);
            s.store_doubles(sums, 3 * line.plane + at, s.add_doubles(old, weights[k]));
        }
    }
}
