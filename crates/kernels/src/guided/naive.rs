//! The filter as nested loops in `f64`, straight from the formulas: the oracle of the tests.

use super::params::GuidedParams;
use crate::KernelError;

/// a and b of one window.
type Line = (Vec<f64>, f64);

/// [`super::filter`] with loops over windows, and a solver that pivots.
///
/// # Errors
/// As [`GuidedParams::check`].
pub fn filter_f64(
    params: &GuidedParams,
    guide: &[&[f32]],
    targets: &[&[f32]],
) -> Result<Vec<Vec<f64>>, KernelError> {
    params.check(guide, targets)?;
    let pixels = params.width * params.height;
    let mut out = vec![vec![0.0; pixels]; targets.len()];
    for (target, out) in targets.iter().zip(&mut out) {
        // a and b of the window around every pixel.
        let fits: Vec<Line> = (0..pixels).map(|k| fit(params, guide, target, k)).collect();
        for (p, out) in out.iter_mut().enumerate() {
            // Windows that contain p are those around the pixels of its own.
            let windows = window(params, p);
            let of = |f: &dyn Fn(&Line) -> f64| {
                windows.iter().map(|&k| f(&fits[k])).sum::<f64>() / windows.len() as f64
            };
            *out = of(&|fit| fit.1);
            for (i, plane) in guide.iter().enumerate() {
                *out += of(&|fit| fit.0[i]) * f64::from(plane[p]);
            }
        }
    }
    Ok(out)
}

fn window(params: &GuidedParams, p: usize) -> Vec<usize> {
    let (x, y, r) = (p % params.width, p / params.width, params.radius);
    let columns = x.saturating_sub(r)..(x + r + 1).min(params.width);
    let rows = y.saturating_sub(r)..(y + r + 1).min(params.height);
    rows.flat_map(|j| columns.clone().map(move |i| j * params.width + i)).collect()
}

fn fit(params: &GuidedParams, guide: &[&[f32]], target: &[f32], k: usize) -> Line {
    let window = window(params, k);
    let mean = |plane: &[f32]| window.iter().map(|&p| f64::from(plane[p])).sum::<f64>() / window.len() as f64;
    let covariance = |a: &[f32], b: &[f32]| {
        let (ma, mb) = (mean(a), mean(b));
        let product = |&p: &usize| (f64::from(a[p]) - ma) * (f64::from(b[p]) - mb);
        window.iter().map(product).sum::<f64>() / window.len() as f64
    };
    let n = guide.len();
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let mut row: Vec<f64> = (0..n).map(|j| covariance(guide[i], guide[j])).collect();
            row[i] += params.epsilon;
            row.push(covariance(guide[i], target));
            row
        })
        .collect();
    let a = eliminate(&mut rows);
    let b = mean(target) - a.iter().zip(guide).map(|(a, plane)| a * mean(plane)).sum::<f64>();
    (a, b)
}

/// Gaussian elimination; what no pivot determines is 0.
fn eliminate(rows: &mut [Vec<f64>]) -> Vec<f64> {
    let n = rows.len();
    let scale: f64 = rows.iter().enumerate().map(|(i, row)| row[i]).sum();
    let mut x = vec![0.0; n];
    let mut used = Vec::new();
    for column in 0..n {
        let free = (0..n).filter(|row| !used.iter().any(|(r, _)| r == row));
        let Some(pivot) = free.max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))
        else {
            break;
        };
        if rows[pivot][column].abs() <= 1e-13 * scale {
            continue;
        }
        used.push((pivot, column));
        for row in (0..n).filter(|row| *row != pivot) {
            let factor = rows[row][column] / rows[pivot][column];
            let from = rows[pivot].clone();
            for (value, from) in rows[row].iter_mut().zip(&from).skip(column) {
                *value -= factor * from;
            }
        }
    }
    for (row, column) in used {
        x[column] = rows[row][n] / rows[row][column];
    }
    x
}
