//! Standard errors over replicates: the delete-one jackknife (Miller 1974), in closed form.

use crate::interval::mean_and_variance;

/// Of a mean over replicates, from their values up to a constant: s/√R, which the jackknife of a mean is.
pub(super) fn of_means(values: &[f64]) -> f64 {
    mean_and_variance(values).map_or(0.0, |(_, variance)| (variance / values.len() as f64).sqrt())
}

/// Of the mean B̂² and the mean V̂, from the means of ½(D̄−A + D̄−B)(D_r−D̄) and of (D_r−D̄)² per replicate; `None` below 3
/// replicates, of which one deleted leaves no variance.
///
/// Without replicate r the variance is V₍₋ᵣ₎ = (Σ_q K_q − R/(R−1)·K_r)/(R−2) and the squared bias differs from that of the
/// mean image by −2l_r/(R−1) + K_r/(R−1)² − V₍₋ᵣ₎/(R−1).
pub(super) fn of_pairs(cross: &[f64], squares: &[f64]) -> (Option<f64>, Option<f64>) {
    let count = squares.len();
    if count < 3 {
        return (None, None);
    }
    let replicates = count as f64;
    let others = replicates - 1.0;
    let all: f64 = squares.iter().sum();
    let variances: Vec<f64> =
        squares.iter().map(|k| ((all - k * replicates / others) / (replicates - 2.0)).max(0.0)).collect();
    let biases: Vec<f64> = cross
        .iter()
        .zip(squares)
        .zip(&variances)
        .map(|((l, k), v)| (-2.0 * l + (k / others - v)) / others)
        .collect();
    let error = |values: &[f64]| {
        mean_and_variance(values).map(|(_, variance)| (variance / replicates).sqrt() * others)
    };
    (error(&biases), error(&variances))
}
