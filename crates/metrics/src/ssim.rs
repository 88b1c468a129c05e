//! Structural similarity (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment:
//! From Error Visibility to Structural Similarity", IEEE Trans. Image Processing 13(4), 2004), with a mask.

const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// SSIM of each pixel of two planes with values in [0, 1]. Pixels that are not `valid` enter no window; their
/// own entry is meaningless.
pub(crate) fn ssim_map(x: &[f64], y: &[f64], valid: &[bool], width: usize) -> Vec<f64> {
    let mask: Vec<f64> = valid.iter().map(|&v| f64::from(u8::from(v))).collect();
    let weighted = |f: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let plane = mask.iter().enumerate().map(|(i, m)| m * f(i)).collect();
        blur(plane, width)
    };
    let total = weighted(&|_| 1.0);
    let (mx, my) = (weighted(&|i| x[i]), weighted(&|i| y[i]));
    let (xx, yy, xy) = (weighted(&|i| x[i] * x[i]), weighted(&|i| y[i] * y[i]), weighted(&|i| x[i] * y[i]));
    (0..x.len())
        .map(|i| {
            // A valid pixel lies in its own window; the floor only matters for invalid ones.
            let inverse = 1.0 / total[i].max(f64::MIN_POSITIVE);
            let (mx, my) = (mx[i] * inverse, my[i] * inverse);
            // Values in [0, 1] in f64: these differences are good to 1e-16 beside C2 = 9e-4.
            let (vx, vy) = ((xx[i] * inverse - mx * mx).max(0.0), (yy[i] * inverse - my * my).max(0.0));
            let covariance = xy[i] * inverse - mx * my;
            ((2.0 * mx * my + C1) * (2.0 * covariance + C2)) / ((mx * mx + my * my + C1) * (vx + vy + C2)) // at least C1·C2
        })
        .collect()
}

/// One side of the window from its middle; normalised over the full window.
fn kernel() -> [f64; RADIUS + 1] {
    let raw: [f64; RADIUS + 1] = std::array::from_fn(|d| (-((d * d) as f64) / (2.0 * SIGMA * SIGMA)).exp());
    let total = raw[0] + 2.0 * raw[1..].iter().sum::<f64>();
    raw.map(|w| w / total)
}

/// Separable Gaussian sum with zeros outside.
fn blur(mut plane: Vec<f64>, width: usize) -> Vec<f64> {
    let kernel = kernel();
    let mut row = vec![0.0; width];
    for line in plane.chunks_exact_mut(width) {
        row.copy_from_slice(line);
        line.iter_mut().zip(&row).for_each(|(out, v)| *out = kernel[0] * v);
        for (d, &w) in kernel.iter().enumerate().skip(1).take_while(|&(d, _)| d < width) {
            line[d..].iter_mut().zip(&row).for_each(|(out, v)| *out += w * v);
            line.iter_mut().zip(&row[d..]).for_each(|(out, v)| *out += w * v);
        }
    }
    let height = plane.len() / width;
    let mut out = vec![0.0; plane.len()];
    for (y, line) in out.chunks_exact_mut(width).enumerate() {
        for source in y.saturating_sub(RADIUS)..(y + RADIUS + 1).min(height) {
            let w = kernel[y.abs_diff(source)];
            line.iter_mut().zip(&plane[source * width..]).for_each(|(out, v)| *out += w * v);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, pixel by pixel, with two passes for the moments.
    fn naive(x: &[f64], y: &[f64], valid: &[bool], width: usize) -> Vec<f64> {
        let height = x.len() / width;
        (0..x.len())
            .map(|p| {
                let (px, py) = (p % width, p / width);
                let window: Vec<(f64, usize)> = (0..x.len())
                    .filter(|&q| valid[q])
                    .filter(|&q| (q % width).abs_diff(px) <= 5 && (q / width).abs_diff(py) <= 5)
                    .map(|q| {
                        let d2 = (q % width).abs_diff(px).pow(2) + (q / width).abs_diff(py).pow(2);
                        ((-(d2 as f64) / 4.5).exp(), q)
                    })
                    .collect();
                let total: f64 = window.iter().map(|w| w.0).sum();
                let mean =
                    |f: &dyn Fn(usize) -> f64| window.iter().map(|&(w, q)| w * f(q)).sum::<f64>() / total;
                let (mx, my) = (mean(&|q| x[q]), mean(&|q| y[q]));
                let vx = mean(&|q| (x[q] - mx).powi(2));
                let vy = mean(&|q| (y[q] - my).powi(2));
                let cov = mean(&|q| (x[q] - mx) * (y[q] - my));
                assert!(py < height);
                (2.0 * mx * my + 1e-4) * (2.0 * cov + 9e-4) / ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4))
            })
            .collect()
    }

    #[test]
    fn agrees_with_the_definition_at_any_size_and_with_holes() {
        for (w, h) in [(1, 1), (1, 7), (13, 1), (4, 4), (23, 17)] {
            let n = w * h;
            let x: Vec<f64> = (0..n).map(|i| ((i * 37) % 101) as f64 / 101.0).collect();
            let y: Vec<f64> = (0..n).map(|i| ((i * 61 + 5) % 89) as f64 / 89.0).collect();
            let valid: Vec<bool> = (0..n).map(|i| i % 11 != 3).collect();
            let (fast, slow) = (ssim_map(&x, &y, &valid, w), naive(&x, &y, &valid, w));
            for i in (0..n).filter(|&i| valid[i]) {
                assert!((fast[i] - slow[i]).abs() < 1e-12, "{w}×{h} at {i}: {} {}", fast[i], slow[i]);
            }
        }
    }
}
