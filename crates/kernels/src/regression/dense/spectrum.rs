//! Symmetric systems without the directions of small eigenvalues: reflections to a tridiagonal matrix, then rotations to a
//! diagonal one (the implicit QL method). No eigenvector is formed: right sides go through reflections and rotations, and
//! solutions back.

#![expect(clippy::needless_range_loop, reason = "indices of matrices, as formulas have them")]

use super::params::MOST;

/// Most rounds of rotations for one eigenvalue; two are usual.
const ROUNDS: usize = 50;

/// A rotation of the rows `first` and `first + 1`.
#[derive(Clone, Copy, Debug)]
struct Turn {
    first: usize,
    cosine: f64,
    sine: f64,
}

/// Memory of a solution.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    /// Reflections I − β·v·vᵀ: v in the rows, and β.
    reflections: [[f64; MOST]; MOST],
    factors: [f64; MOST],
    diagonal: [f64; MOST],
    /// Beside the diagonal, and 0 at the end.
    beside: [f64; MOST],
    turns: Vec<Turn>,
}

impl Spectrum {
    pub fn new() -> Self {
        Self {
            reflections: [[0.0; MOST]; MOST],
            factors: [0.0; MOST],
            diagonal: [0.0; MOST],
            beside: [0.0; MOST],
            turns: Vec::new(),
        }
    }

    /// Solves `matrix`·x = `right` for its first `size` rows in the directions whose eigenvalue is above `least` of the largest; x is
    /// nothing in the others.
    pub fn solve(
        &mut self,
        mut matrix: [[f64; MOST]; MOST],
        mut right: [[f64; 3]; MOST],
        size: usize,
        least: f64,
    ) -> [[f64; 3]; MOST] {
        self.reflect(&mut matrix, &mut right, size);
        self.turn(&mut right, size);
        let largest = self.diagonal[..size].iter().copied().fold(0.0, f64::max);
        for i in 0..size {
            let value = self.diagonal[i];
            let over = if value > least * largest { 1.0 / value } else { 0.0 };
            right[i] = right[i].map(|v| v * over);
        }
        for &Turn { first, cosine, sine } in self.turns.iter().rev() {
            for c in 0..3 {
                let (a, b) = (right[first][c], right[first + 1][c]);
                right[first][c] = cosine * a + sine * b;
                right[first + 1][c] = cosine * b - sine * a;
            }
        }
        for k in (0..size.saturating_sub(2)).rev() {
            self.reflected(k, &mut right, size);
        }
        right
    }

    /// Applies reflection `k` to the right sides.
    fn reflected(&self, k: usize, right: &mut [[f64; 3]; MOST], size: usize) {
        let v = &self.reflections[k];
        for c in 0..3 {
            let along: f64 = (k + 1..size).map(|i| v[i] * right[i][c]).sum::<f64>() * self.factors[k];
            (k + 1..size).for_each(|i| right[i][c] -= along * v[i]);
        }
    }

    /// Makes the matrix tridiagonal, column by column.
    fn reflect(&mut self, matrix: &mut [[f64; MOST]; MOST], right: &mut [[f64; 3]; MOST], size: usize) {
        for k in 0..size.saturating_sub(2) {
            let length = (k + 1..size).map(|i| matrix[i][k] * matrix[i][k]).sum::<f64>().sqrt();
            self.factors[k] = 0.0;
            self.beside[k] = matrix[k + 1][k];
            if length > 0.0 {
                // Away from the first entry, so that nothing cancels.
                let end = if matrix[k + 1][k] > 0.0 { -length } else { length };
                let mut v = [0.0; MOST];
                (k + 1..size).for_each(|i| v[i] = matrix[i][k]);
                v[k + 1] -= end;
                // At least the squared length.
                let factor = 2.0 / (k + 1..size).map(|i| v[i] * v[i]).sum::<f64>();
                let mut image = [0.0; MOST];
                for i in k + 1..size {
                    image[i] = factor * (k + 1..size).map(|j| matrix[i][j] * v[j]).sum::<f64>();
                }
                let half = 0.5 * factor * (k + 1..size).map(|i| v[i] * image[i]).sum::<f64>();
                (k + 1..size).for_each(|i| image[i] -= half * v[i]);
                for i in k + 1..size {
                    for j in k + 1..size {
                        matrix[i][j] -= v[i] * image[j] + image[i] * v[j];
                    }
                }
                self.beside[k] = end;
                self.factors[k] = factor;
                self.reflections[k] = v;
            }
            self.reflected(k, right, size);
        }
        for i in 0..size {
            self.diagonal[i] = matrix[i][i];
        }
        if size >= 2 {
            self.beside[size - 2] = matrix[size - 1][size - 2];
        }
        if size >= 1 {
            self.beside[size - 1] = 0.0;
        }
    }

    /// Makes the tridiagonal matrix diagonal, eigenvalue by eigenvalue.
    fn turn(&mut self, right: &mut [[f64; 3]; MOST], size: usize) {
        let (d, e) = (&mut self.diagonal, &mut self.beside);
        self.turns.clear();
        for l in 0..size {
            for _ in 0..ROUNDS {
                // The block from l on that hangs together.
                let small = |i: usize| e[i].abs() <= f64::EPSILON * (d[i].abs() + d[i + 1].abs());
                let m = (l..size - 1).find(|&i| small(i)).unwrap_or(size - 1);
                if m == l {
                    break;
                }
                // A shift by the eigenvalue of the first two rows that is nearer to the first.
                let half = (d[l + 1] - d[l]) / (2.0 * e[l]);
                let root = (half * half + 1.0).sqrt();
                let mut g = d[m] - d[l] + e[l] / (half + root.copysign(half));
                let (mut sine, mut cosine, mut moved) = (1.0, 1.0, 0.0);
                let (mut i, mut apart) = (m, false);
                while i > l {
                    i -= 1;
                    let (f, b) = (sine * e[i], cosine * e[i]);
                    let r = (f * f + g * g).sqrt();
                    e[i + 1] = r;
                    if r == 0.0 {
                        // The block falls apart here.
                        d[i + 1] -= moved;
                        apart = true;
                        break;
                    }
                    sine = f / r;
                    cosine = g / r;
                    let before = d[i + 1] - moved;
                    let turned = (d[i] - before) * sine + 2.0 * cosine * b;
                    moved = sine * turned;
                    d[i + 1] = before + moved;
                    g = cosine * turned - b;
                    for c in 0..3 {
                        let (a, b) = (right[i][c], right[i + 1][c]);
                        right[i][c] = cosine * a - sine * b;
                        right[i + 1][c] = sine * a + cosine * b;
                    }
                    self.turns.push(Turn { first: i, cosine, sine });
                }
                e[m] = 0.0;
                if apart {
                    continue;
                }
                d[l] -= moved;
                e[l] = g;
            }
        }
    }
}
