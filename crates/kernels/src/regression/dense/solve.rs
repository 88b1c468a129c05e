//! Coefficients of one model from its moments.

use super::moments::Slots;

/// What must be left of a column's square after the others have taken their part, in units of the largest square: the square
/// of the precision of `f32`, in which the program decides.
const LEAST_PIVOT: f64 = (f32::EPSILON as f64) * (f32::EPSILON as f64);

/// Most columns of a model.
pub(super) const MOST: usize = 3 + super::params::MAX_FEATURES;

/// Normal equations: Σ w·x·xᵀ, of which the upper half is read, and Σ w·x·y.
#[derive(Clone, Debug)]
pub(super) struct Normal {
    pub square: [[f64; MOST]; MOST],
    pub right: [[f64; 3]; MOST],
}

impl Normal {
    pub fn new() -> Self {
        Self { square: [[0.0; MOST]; MOST], right: [[0.0; 3]; MOST] }
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
    pub fn dropped(
        &mut self,
        count: usize,
        absent: std::ops::Range<usize>,
        pixels: usize,
    ) -> [[f64; 3]; MOST] {
        let mut out = [[0.0; 3]; MOST];
        let mut columns = [0; MOST];
        let mut present = 0;
        for j in (0..count).filter(|j| !absent.contains(j)) {
            columns[present] = j;
            present += 1;
        }
        let columns = &mut columns[..present];
        for (i, &a) in columns.iter().enumerate() {
            for &b in &columns[i + 1..] {
                self.square[b][a] = self.square[a][b];
            }
        }
        let largest = columns.iter().map(|&j| self.square[j][j]).fold(0.0, f64::max);
        let mut rank = 0;
        while rank < columns.len() {
            let mut best = rank;
            for k in rank + 1..columns.len() {
                let (a, b) = (columns[k], columns[best]);
                if self.square[a][a] > self.square[b][b] {
                    best = k;
                }
            }
            columns.swap(rank, best);
            let pivot = columns[rank];
            let left = self.square[pivot][pivot];
            // Its threshold falls with the rows that are left to it.
            let rows = pixels.saturating_sub(rank) as f64 / pixels as f64;
            if left <= 0.0 || left < LEAST_PIVOT * largest * rows {
                break;
            }
            for k in rank + 1..columns.len() {
                let a = columns[k];
                let share = self.square[pivot][a] / left;
                for &b in &columns[k..] {
                    let value = self.square[a][b] - share * self.square[pivot][b];
                    self.square[a][b] = value;
                    self.square[b][a] = value;
                }
                for c in 0..3 {
                    self.right[a][c] -= share * self.right[pivot][c];
                }
            }
            rank += 1;
        }
        for i in (0..rank).rev() {
            let a = columns[i];
            let mut value = self.right[a];
            for &b in &columns[i + 1..rank] {
                for c in 0..3 {
                    value[c] -= self.square[a][b] * out[b][c];
                }
            }
            // A pivot, above 0.
            out[a] = value.map(|v| v / self.square[a][a]);
        }
        out
    }
}
