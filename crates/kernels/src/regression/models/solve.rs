//! Inverse normal matrices.

use super::size::COLUMNS;

/// Row length of a [`Square`]: whole vectors.
const ROW: usize = 12;
/// A ridge below this is none: pivots of equal columns would be rounding.
const LEAST_RIDGE: f64 = 1e-10;
/// Eigenvalues below this share of the largest are dropped, where there is no ridge.
const LEAST: f64 = 1e-9;

/// A symmetric matrix of all columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Square(pub [[f64; ROW]; COLUMNS]);

impl Square {
    /// The inverse of XᵀWX with `ridge`·Σw on its diagonal but for the intercept, or the one that leaves out what the data do not
    /// determine. S = Σw, the first element, is above 0.
    #[inline(always)]
    pub fn inverse(&self, ridge: f64) -> Self {
        if ridge >= LEAST_RIDGE { self.with_ridge(ridge) } else { self.truncated() }
    }

    /// Gauss and Jordan's elimination; the matrix is positive definite by its ridge, so that it needs no pivots.
    #[inline(always)]
    fn with_ridge(&self, ridge: f64) -> Self {
        let mut m = self.0;
        let weight = m[0][0];
        for (i, row) in m.iter_mut().enumerate().skip(1) {
            row[i] += ridge * weight;
        }
        for k in 0..COLUMNS {
            let over = 1.0 / m[k][k];
            m[k][k] = 1.0;
            let mut pivot = m[k];
            for value in &mut pivot {
                *value *= over;
            }
            for (i, row) in m.iter_mut().enumerate() {
                if i == k {
                    *row = pivot;
                } else {
                    let factor = row[k];
                    row[k] = 0.0;
                    for (value, pivot) in row.iter_mut().zip(&pivot) {
                        *value -= factor * pivot;
                    }
                }
            }
        }
        Self(m)
    }

    /// With the columns' weighted means taken off, whose part of the inverse is then put together again.
    fn truncated(&self) -> Self {
        const D: usize = COLUMNS - 1;
        let m = &self.0;
        let weight = m[0][0];
        let mean: [f64; D] = std::array::from_fn(|i| m[0][i + 1] / weight);
        let mut centred = [[0.0; D]; D];
        for i in 0..D {
            for j in 0..D {
                centred[i][j] = m[i + 1][j + 1] - weight * mean[i] * mean[j];
            }
        }
        let (values, vectors) = eigen(centred);
        let largest = values.iter().fold(0.0f64, |most, v| most.max(*v));
        let mut out = [[0.0; ROW]; COLUMNS];
        for (value, vector) in values.iter().zip(&vectors) {
            if *value > LEAST * largest {
                for i in 0..D {
                    for j in 0..D {
                        out[i + 1][j + 1] += vector[i] * vector[j] / value;
                    }
                }
            }
        }
        for i in 0..D {
            let along: f64 = (0..D).map(|j| out[i + 1][j + 1] * mean[j]).sum();
            out[0][i + 1] = -along;
            out[i + 1][0] = -along;
        }
        out[0][0] = 1.0 / weight - (0..D).map(|i| out[0][i + 1] * mean[i]).sum::<f64>();
        Self(out)
    }

    /// K b.
    #[inline(always)]
    pub fn times(&self, b: &[f64; COLUMNS]) -> [f64; COLUMNS] {
        let mut out = [0.0; COLUMNS];
        for (row, b) in self.0.iter().zip(b) {
            for (out, value) in out.iter_mut().zip(row) {
                *out += value * b;
            }
        }
        out
    }

    /// K A K.
    #[inline(always)]
    pub fn around(&self, a: &Self) -> Self {
        product(&product(self, a), self)
    }
}

#[inline(always)]
fn product(a: &Square, b: &Square) -> Square {
    let mut out = Square::default();
    for (out, a) in out.0.iter_mut().zip(&a.0) {
        for (factor, b) in a.iter().zip(&b.0) {
            for (out, b) in out.iter_mut().zip(b) {
                *out += factor * b;
            }
        }
    }
    out
}

/// Eigenvalues and vectors of a symmetric matrix by Jacobi's rotations.
fn eigen<const D: usize>(mut m: [[f64; D]; D]) -> ([f64; D], [[f64; D]; D]) {
    let mut v = [[0.0; D]; D];
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..40 {
        let off: f64 = (0..D).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| m[i][j].powi(2)).sum();
        let diagonal: f64 = (0..D).map(|i| m[i][i].powi(2)).sum();
        if off <= 1e-30 * diagonal {
            break;
        }
        for p in 0..D {
            for q in p + 1..D {
                if m[p][q] == 0.0 {
                    continue;
                }
                let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                // A quotient may be infinite: then there is nothing to turn.
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in &mut m {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                for k in 0..D {
                    (m[p][k], m[q][k]) = (c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]);
                    (v[p][k], v[q][k]) = (c * v[p][k] - s * v[q][k], s * v[p][k] + c * v[q][k]);
                }
            }
        }
    }
    (std::array::from_fn(|i| m[i][i]), v)
}
