//! Small symmetric systems.

use super::params::MAX_GUIDE_CHANNELS;

/// A matrix that is positive semidefinite, lower triangle.
pub(super) struct Normal {
    n: usize,
    m: [[f64; MAX_GUIDE_CHANNELS]; MAX_GUIDE_CHANNELS],
    /// Pivots up to this are rounding: what belongs to them takes no part.
    least: f64,
}

impl Normal {
    #[inline(always)]
    pub fn new(n: usize, at: impl Fn(usize, usize) -> f64, epsilon: f64) -> Self {
        let mut m = [[0.0; MAX_GUIDE_CHANNELS]; MAX_GUIDE_CHANNELS];
        let mut trace = 0.0;
        for i in 0..n {
            for j in 0..=i {
                m[i][j] = at(i, j);
            }
            m[i][i] = m[i][i].max(0.0) + epsilon;
            trace += m[i][i];
        }
        Self { n, m, least: 1e-13 * trace }
    }
}

/// Solution by Cholesky's decomposition, L D Lᵀ in its form without roots.
#[inline(always)]
pub(super) fn solve(normal: &mut Normal, right: impl Fn(usize) -> f64) -> [f64; MAX_GUIDE_CHANNELS] {
    let Normal { n, m, least } = normal;
    let mut x = [0.0; MAX_GUIDE_CHANNELS];
    let mut inverse = [0.0; MAX_GUIDE_CHANNELS];
    for i in 0..*n {
        for j in 0..i {
            let mut sum = m[i][j];
            for k in 0..j {
                sum -= m[i][k] * m[j][k];
            }
            // L times D: divided by D below, once the row is done.
            m[i][j] = sum;
        }
        let mut pivot = m[i][i];
        for k in 0..i {
            let scaled = m[i][k] * inverse[k];
            pivot -= scaled * m[i][k];
            m[i][k] = scaled;
        }
        inverse[i] = if pivot > *least { 1.0 / pivot } else { 0.0 };
        x[i] = right(i);
        for k in 0..i {
            x[i] -= m[i][k] * x[k];
        }
    }
    for i in (0..*n).rev() {
        x[i] *= inverse[i];
        for j in i + 1..*n {
            x[i] -= m[j][i] * x[j];
        }
    }
    x
}
