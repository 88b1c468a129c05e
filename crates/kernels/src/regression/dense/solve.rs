//! Coefficients of one model from its moments.

use super::moments::Slots;
use super::params::MOST;
use super::spectrum::Spectrum;

/// What must be left of a column's square after the others have taken their part, in units of the largest square: the square
/// of the precision of `f32`, in which the program decides.
const LEAST_PIVOT: f64 = (f32::EPSILON as f64) * (f32::EPSILON as f64);

/// Values of a row that are computed at a time; divides [`MOST`].
const BLOCK: usize = 4;

/// Normal equations: Σ w·x·xᵀ, of which the upper half is read, and Σ w·x·y.
#[derive(Clone, Debug)]
pub(super) struct Normal {
    pub square: [[f64; MOST]; MOST],
    pub right: [[f64; 3]; MOST],
    rows: [[[f64; BLOCK]; 1 + MOST / BLOCK]; MOST],
    pub spectrum: Spectrum,
}

impl Normal {
    pub fn new() -> Self {
        Self {
            square: [[0.0; MOST]; MOST],
            right: [[0.0; 3]; MOST],
            rows: [[[0.0; BLOCK]; 1 + MOST / BLOCK]; MOST],
            spectrum: Spectrum::new(),
        }
    }

    /// Takes over one model's sums, see [`Slots::sum`].
    pub fn fill(&mut self, slots: &Slots, sum: impl Fn(usize) -> f64) {
        let [one, by_x, by_xx, by_y, by_xy, by_yy] = [0, 1, 2, 3, 4, 5].map(&sum);
        self.square[0][..3].copy_from_slice(&[one, by_x, by_y]);
        self.square[1][1..3].copy_from_slice(&[by_xx, by_xy]);
        self.square[2][2] = by_yy;
        // Factors on the left: w, w·dx, w·dy.
        for (column, left) in [0, 1, slots.left()].into_iter().enumerate() {
            for j in 0..slots.features {
                self.square[column][3 + j] = sum(slots.sum(left, j));
            }
            self.right[column] = [0, 1, 2].map(|c| sum(slots.sum(left, slots.features + c)));
        }
        for i in 0..slots.features {
            for j in i..slots.features {
                self.square[3 + i][3 + j] = sum(slots.sum(2 + i, j));
            }
            self.right[3 + i] = [0, 1, 2].map(|c| sum(slots.sum(2 + i, slots.features + c)));
        }
    }

    /// Coefficients of the first `count` columns but for those marked as absent, of a window of `pixels`. Column by column, the one
    /// of which most is left first, until what is left is rounding to a solver that reflects columns of `f32`; the others are
    /// dropped.
    #[inline(always)]
    pub fn dropped(
        &mut self,
        count: usize,
        absent: std::ops::Range<usize>,
        pixels: usize,
    ) -> [[f64; 3]; MOST] {
        self.fill_rows(count);
        let rows = &mut self.rows[..count];
        let blocks = count.div_ceil(BLOCK) + 1;
        // Columns in the order of their pivots, and those that wait.
        let mut pivots = [0; MOST];
        let mut waits = [false; MOST];
        waits[..count].fill(true);
        waits[absent].fill(false);
        let largest =
            (0..count).filter(|&j| waits[j]).map(|j| rows[j][1 + j / BLOCK][j % BLOCK]).fold(0.0, f64::max);
        let mut rank = 0;
        loop {
            let mut best = (0.0, count);
            for j in (0..count).filter(|&j| waits[j]) {
                let left = rows[j][1 + j / BLOCK][j % BLOCK];
                if left > best.0 {
                    best = (left, j);
                }
            }
            let (left, pivot) = best;
            // The threshold falls with the rows of the window that are left.
            let share = pixels.saturating_sub(rank) as f64 / pixels as f64;
            // Nor are there more columns than pixels: what were left of another is rounding.
            if pivot == count || rank == pixels || left < LEAST_PIVOT * largest * share {
                break;
            }
            waits[pivot] = false;
            pivots[rank] = pivot;
            rank += 1;
            let of_pivot = rows[pivot];
            // Above 0.
            let over = 1.0 / left;
            for j in (0..count).filter(|&j| waits[j]) {
                let share = of_pivot[1 + j / BLOCK][j % BLOCK] * over;
                for (to, from) in rows[j][..blocks].iter_mut().zip(&of_pivot) {
                    for i in 0..BLOCK {
                        to[i] -= share * from[i];
                    }
                }
            }
        }
        let mut out = [[0.0; 3]; MOST];
        for i in (0..rank).rev() {
            let a = pivots[i];
            let mut value = [rows[a][0][0], rows[a][0][1], rows[a][0][2]];
            for &b in &pivots[i + 1..rank] {
                let factor = rows[a][1 + b / BLOCK][b % BLOCK];
                for c in 0..3 {
                    value[c] -= factor * out[b][c];
                }
            }
            let over = 1.0 / rows[a][1 + a / BLOCK][a % BLOCK];
            out[a] = value.map(|v| v * over);
        }
        out
    }

    /// Whole rows: the right sides in the first block, then the square.
    #[inline(always)]
    fn fill_rows(&mut self, count: usize) {
        for i in 0..count {
            let [x, y, z] = self.right[i];
            self.rows[i][0] = [x, y, z, 0.0];
            for j in 0..count {
                let value = if j < i { self.square[j][i] } else { self.square[i][j] };
                self.rows[i][1 + j / BLOCK][j % BLOCK] = value;
            }
        }
    }
}
