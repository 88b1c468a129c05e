//! How well a change makes a frame fit.

/// L with its standard error, from sums per row.
pub(super) fn position(rows: &[[f64; 2]]) -> Option<(f64, f64)> {
    let (q, a) = rows.iter().fold((0.0, 0.0), |(q, a), row| (q + row[0], a + row[1]));
    let used = rows.iter().filter(|row| row[1] > 0.0).count();
    if a <= 0.0 || used < 5 {
        return None;
    }
    let l = q / a;
    let spread: f64 = rows.iter().map(|row| (row[0] - l * row[1]).powi(2)).sum();
    Some((l, (spread * used as f64 / (used as f64 - 1.0)).sqrt() / a))
}

/// Correlation of the logarithms of block means.
pub(super) fn correlation(means: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> =
        means.iter().filter(|(a, b)| *a > 0.0 && *b > 0.0).map(|(a, b)| (a.ln(), b.ln())).collect();
    let n = logs.len().max(1) as f64;
    let (a, b) = logs.iter().fold((0.0, 0.0), |s, m| (s.0 + m.0 / n, s.1 + m.1 / n));
    let product = |f: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>();
    let (aa, bb) = (product(&|m| (m.0 - a).powi(2)), product(&|m| (m.1 - b).powi(2)));
    if aa > 0.0 && bb > 0.0 { product(&|m| (m.0 - a) * (m.1 - b)) / (aa * bb).sqrt() } else { 0.0 }
}
