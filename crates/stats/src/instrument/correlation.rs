use crate::instrument::Blocks;

/// Correlation of two fields of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correlation {
    /// ρ about zero: mean product in units of the root mean squares around.
    pub rho: f64,
    /// Its size in standard errors.
    pub z: f64,
    /// Blocks less one: degrees of freedom of z.
    pub freedom: u64,
}

/// Fewest blocks and pixels of which a correlation is told.
pub(crate) const LEAST_BLOCKS: usize = 16;
const LEAST_PIXELS: f64 = 100.0;

/// Correlation about zero of two fields of errors of which one at least is symmetric about zero and independent of the other
/// unless they share samples; `None` below 16 blocks or 100 pixels that are `usable` and finite, or where nothing differs.
///
/// Products are divided by the root mean square of their factors in each block, so that bright spots do not rule. The
/// standard error is the larger of those over pixels and over blocks: the first is the bound for independent symmetric
/// terms, the second knows of correlated neighbours.
#[must_use]
pub fn correlation(
    blocks: &Blocks,
    usable: impl Fn(usize) -> bool,
    a: impl Fn(usize) -> f64,
    b: impl Fn(usize) -> f64,
) -> Option<Correlation> {
    let pixels = blocks.pixels();
    let mut squares = vec![[0.0f64; 3]; blocks.count()];
    for pixel in (0..pixels).filter(|&p| usable(p)) {
        let (a, b) = (a(pixel), b(pixel));
        if a.is_finite() && b.is_finite() {
            let s = &mut squares[blocks.of(pixel)];
            *s = [s[0] + a * a, s[1] + b * b, s[2] + 1.0];
        }
    }
    // Products in units of the root mean squares around: [Σ, Σ of squares, pixels] per block.
    let mut products = vec![[0.0f64; 3]; blocks.count()];
    for pixel in (0..pixels).filter(|&p| usable(p)) {
        let block = blocks.of(pixel);
        let [aa, bb, n] = squares[block];
        let (a, b) = (a(pixel), b(pixel));
        if aa > 0.0 && bb > 0.0 && a.is_finite() && b.is_finite() {
            let p = a * b * n / (aa * bb).sqrt();
            let s = &mut products[block];
            *s = [s[0] + p, s[1] + p * p, s[2] + 1.0];
        }
    }
    products.retain(|p| p[2] > 0.0);
    let all = products.iter().fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
    let [sum, squares, n] = all;
    if products.len() < LEAST_BLOCKS || n < LEAST_PIXELS || squares <= 0.0 {
        return None;
    }
    let mean = sum / n;
    let count = products.len() as f64;
    let between = products.iter().map(|p| (p[0] - p[2] * mean).powi(2)).sum::<f64>() * count / (count - 1.0);
    // Uncentred over pixels: the bound for symmetric terms.
    let error = squares.max(between).sqrt();
    Some(Correlation { rho: mean, z: sum / error, freedom: products.len() as u64 - 1 })
}
