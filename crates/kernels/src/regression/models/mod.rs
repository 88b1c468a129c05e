//! First-order models at chosen centres: each predicts all pixels of its window at once (liu2018robust, Sec. 3.1, 3.3 and 3.4).
//!
//! For the model around pixel i with window N of n pixels, guide image M of variance V and bandwidth k:
//!
//! ```text
//! P(i,j)   = max(0, mean over patch and channels of ((M(i)−M(j))² − (V(i) + min(V(i), V(j)))) / (V(i) + V(j)))      Eq. 4, 5
//! w_k(i,j) = exp(−P(i,j)/(2σ_r²k²))                                                                              Sec. 3.3
//! y        = H Y,   H = X (XᵀWX + R)⁻¹ XᵀW,   rows of X: [1, (p_j − p_i)/s, (f_j − f_i)/s]                         Eq. 1, 2
//! bias_t   = H y_{t−1} − y_{t−1},   Var_t(j) = Σ_s H_js² Var_{t−1}(s)                                            Eq. 11
//! ```
//!
//! s is the range of a column in the window, but at least 10⁻³ of its range in the image; R = ridge·Σw on the diagonal but for the
//! intercept, so that rows of H sum to 1. Without ridge eigenvalues of the centred XᵀWX below 10⁻⁹ of the largest are dropped.
//! H is never made: with K = (XᵀWX + R)⁻¹ the variance is xᵀ K (Σ w² Var x xᵀ) K x.
//!
//! Patch distances are made once per window and serve all k. Pixels whose weight is below a limit at the largest k take no part. Sums
//! are taken in 16 lanes in an order that is the same for every instruction set, and added up in `f64`.

mod distances;
mod field;
#[allow(clippy::needless_range_loop, reason = "indices are those of a matrix")]
mod moments;
pub mod naive;
mod open;
mod size;
#[allow(clippy::needless_range_loop, reason = "indices are those of a matrix")]
mod solve;
mod steps;
mod window;

pub use distances::{Area, Distances};
pub use field::{Field, Planes, Rules};
pub use size::{COLUMNS, MAX_BANDWIDTHS, MAX_FEATURES, MAX_PATCH_RADIUS, MAX_RADIUS};
pub use steps::Start;
pub use window::Window;
