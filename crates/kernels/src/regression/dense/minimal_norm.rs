//! The solution of least norm of a model's normal equations.

#![expect(clippy::needless_range_loop, reason = "indices of matrices, as formulas have them")]

use super::params::MOST;
use super::solve::Normal;
use super::spectrum::Spectrum;

/// Share of the largest eigenvalue up to which others count as 0.
const LEAST: f64 = 1e-9;

impl Normal {
    /// Coefficients of the first `count` columns but for those marked as absent: the constant takes the weighted mean, and the
    /// other columns, less theirs and in these units, what least squares leave them; directions in which they do not vary get
    /// nothing.
    pub fn minimal_norm(
        &mut self,
        count: usize,
        absent: std::ops::Range<usize>,
        unit: impl Fn(usize) -> f64,
    ) -> [[f64; 3]; MOST] {
        let mut out = [[0.0; 3]; MOST];
        let total = self.square[0][0];
        if total <= 0.0 {
            return out;
        }
        let mut columns = [0; MOST];
        let mut present = 0;
        let mut system = System::new();
        for a in (1..count).filter(|a| !absent.contains(a)) {
            // The square left of a column is above the rounding of what is taken off: its own pixel, where it is 0, has a
            // weight of 1, so that both are alike up to the number of pixels.
            let left = self.square[a][a] - self.square[0][a] * self.square[0][a] / total;
            if left > 0.0 {
                columns[present] = a;
                present += 1;
            }
        }
        let columns = &columns[..present];
        for (i, &a) in columns.iter().enumerate() {
            let of_a = self.square[0][a] / total;
            for (j, &b) in columns.iter().enumerate().skip(i) {
                let value = (self.square[a][b] - of_a * self.square[0][b]) / (unit(a) * unit(b));
                system.matrix[i][j] = value;
                system.matrix[j][i] = value;
            }
            system.right[i] = [0, 1, 2].map(|c| (self.right[a][c] - of_a * self.right[0][c]) / unit(a));
        }
        let solution = system.solve(present, &mut self.spectrum);
        out[0] = self.right[0].map(|v| v / total);
        for (&a, solution) in columns.iter().zip(&solution) {
            out[a] = solution.map(|v| v / unit(a));
            for c in 0..3 {
                out[0][c] -= out[a][c] * self.square[0][a] / total;
            }
        }
        out
    }
}

/// A symmetric system with three right sides.
struct System {
    matrix: [[f64; MOST]; MOST],
    right: [[f64; 3]; MOST],
}

impl System {
    fn new() -> Self {
        Self { matrix: [[0.0; MOST]; MOST], right: [[0.0; 3]; MOST] }
    }

    fn solve(&self, size: usize, spectrum: &mut Spectrum) -> [[f64; 3]; MOST] {
        self.regular(size).unwrap_or_else(|| spectrum.solve(self.matrix, self.right, size, LEAST))
    }

    /// The solution if certainly no eigenvalue counts as 0: by the sum of the inverse's, the smallest is at least one over it, and
    /// the largest at most the sum of all.
    fn regular(&self, size: usize) -> Option<[[f64; 3]; MOST]> {
        let mut lower = [[0.0; MOST]; MOST];
        let mut sum = 0.0;
        for i in 0..size {
            sum += self.matrix[i][i];
            for j in 0..=i {
                let mut value = self.matrix[i][j];
                for k in 0..j {
                    value -= lower[i][k] * lower[j][k];
                }
                if i > j {
                    lower[i][j] = value / lower[j][j];
                } else if value > 0.0 {
                    lower[i][i] = value.sqrt();
                } else {
                    return None;
                }
            }
        }
        // Columns of the inverse of the lower triangle: their squares sum to the trace of the inverse.
        let mut inverse = 0.0;
        for c in 0..size {
            let mut column = [0.0; MOST];
            for i in c..size {
                let mut value = if i == c { 1.0 } else { 0.0 };
                for k in c..i {
                    value -= lower[i][k] * column[k];
                }
                column[i] = value / lower[i][i];
                inverse += column[i] * column[i];
            }
        }
        let regular = LEAST * sum * inverse < 1.0;
        if !regular {
            return None;
        }
        let mut out = self.right;
        for i in 0..size {
            for c in 0..3 {
                let mut value = out[i][c];
                for k in 0..i {
                    value -= lower[i][k] * out[k][c];
                }
                out[i][c] = value / lower[i][i];
            }
        }
        for i in (0..size).rev() {
            for c in 0..3 {
                let mut value = out[i][c];
                for k in i + 1..size {
                    value -= lower[k][i] * out[k][c];
                }
                out[i][c] = value / lower[i][i];
            }
        }
        Some(out)
    }
}
