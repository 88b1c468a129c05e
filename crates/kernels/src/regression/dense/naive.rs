//! Both filters as nested loops in `f64`: the oracle of the tests.
//!
//! One thread; every distance is computed from the pixels of both patches, every model from the rows of its window: the
//! square root of each weight on its row, columns made orthogonal one by one or by rotations of pairs.

use super::{Alone, Channel, Fit, Join, Planes, Solver, Weighting};
use crate::KernelError;

/// Largest Δ² of one pair of pixels.
const LARGEST: f64 = 1e4;
/// Least weight of a pixel for itself.
const LEAST_OWN: f64 = 1e-4;

/// Column and row.
type At = (isize, isize);

fn index(weighting: &Weighting, (x, y): At) -> Option<usize> {
    let inside = (0..weighting.width as isize).contains(&x) && (0..weighting.height as isize).contains(&y);
    inside.then(|| y as usize * weighting.width + x as usize)
}

fn square(radius: usize) -> impl Iterator<Item = At> {
    let r = radius as isize;
    (-r..=r).flat_map(move |y| (-r..=r).map(move |x| (x, y)))
}

/// d² of a pixel and its neighbour at an offset, both inside the image, in one channel.
fn distance(weighting: &Weighting, guide: &Channel<'_>, (x, y): At, (dx, dy): At) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for (nx, ny) in square(weighting.patch) {
        let p = index(weighting, (x + nx, y + ny));
        let q = index(weighting, (x + nx + dx, y + ny + dy));
        let (Some(p), Some(q)) = (p, q) else { continue };
        let value = |i: usize| f64::from(guide.value[i]);
        let variance = |i: usize| f64::from(weighting.scale) * f64::from(guide.variance[i]);
        let (a, b) = (variance(p), variance(q));
        let taken = if a < b { a + a } else { a + b };
        let over = f64::from(weighting.k).powi(2) * (a + b) + f64::from(weighting.epsilon);
        // A NaN is dropped by the minimum.
        sum += (((value(p) - value(q)).powi(2) - taken) / over).min(LARGEST);
        count += 1;
    }
    // The pixels themselves at least.
    sum / f64::from(count)
}

fn weight(distance: f64, d: At) -> f64 {
    let weight = (-distance.max(0.0)).exp();
    if d == (0, 0) { weight.max(LEAST_OWN) } else { weight }
}

/// [`super::means`].
///
/// # Errors
/// As there.
pub fn means(weighting: &Weighting, channels: &[Alone<'_>]) -> Result<Vec<Vec<Vec<f64>>>, KernelError> {
    weighting.check_means(channels)?;
    let pixels = weighting.width * weighting.height;
    let mut out: Vec<Vec<Vec<f64>>> =
        channels.iter().map(|channel| vec![vec![0.0; pixels]; channel.targets.len()]).collect();
    for (channel, out) in channels.iter().zip(&mut out) {
        for p in 0..pixels {
            let (x, y) = ((p % weighting.width) as isize, (p / weighting.width) as isize);
            let mut total = 0.0;
            for (dx, dy) in square(weighting.window) {
                let Some(q) = index(weighting, (x + dx, y + dy)) else { continue };
                let w = weight(distance(weighting, &channel.guide, (x, y), (dx, dy)), (dx, dy));
                total += w;
                for (target, out) in channel.targets.iter().zip(out.iter_mut()) {
                    out[p] += w * f64::from(target[q]);
                }
            }
            out.iter_mut().for_each(|out| out[p] /= total);
        }
    }
    Ok(out)
}

/// Weight of a regression.
#[must_use]
pub fn joined_weight(fit: &Fit, guide: &[Channel<'_>], p: At, d: At) -> f64 {
    let distances = guide.iter().map(|channel| distance(&fit.weighting, channel, p, d));
    let joined = match fit.join {
        Join::Minimum => distances.fold(f64::NEG_INFINITY, f64::max),
        Join::Mean => distances.sum::<f64>() / guide.len() as f64,
    };
    weight(joined, d)
}

/// [`super::regress`].
///
/// # Errors
/// As there.
pub fn regress(fit: &Fit, planes: &Planes<'_>) -> Result<[Vec<f64>; 3], KernelError> {
    fit.check(planes)?;
    let weighting = &fit.weighting;
    let pixels = weighting.width * weighting.height;
    let ranges: Vec<f64> = planes.features.iter().map(|f| range(f.iter().copied())).collect();
    let mut sums = [0, 1, 2].map(|_| vec![0.0; pixels]);
    let mut totals = vec![0.0; pixels];
    for p in 0..pixels {
        let (x, y) = ((p % weighting.width) as isize, (p / weighting.width) as isize);
        let inside: Vec<(At, usize)> = square(weighting.window)
            .filter_map(|d| Some((d, index(weighting, (x + d.0, y + d.1))?)))
            .collect();
        let weights: Vec<f64> =
            inside.iter().map(|(d, _)| joined_weight(fit, &planes.guide, (x, y), *d)).collect();
        let rows: Vec<Vec<f64>> = inside
            .iter()
            .map(|&((dx, dy), q)| {
                let mut row = vec![1.0];
                if fit.positions {
                    row.extend([dx as f64, dy as f64]);
                }
                row.extend(planes.features.iter().map(|f| f64::from(f[q]) - f64::from(f[p])));
                row
            })
            .collect();
        let right: Vec<[f64; 3]> =
            inside.iter().map(|&(_, q)| planes.image.map(|image| f64::from(image[q]))).collect();
        let predicted = match fit.solver {
            Solver::Dropped => dropped(&rows, &right, &weights),
            Solver::MinimalNorm => {
                minimal_norm(&rows, &right, &weights, (fit.positions, weighting.window), &ranges)
            }
        };
        for (((_, q), w), predicted) in inside.iter().zip(&weights).zip(predicted) {
            for (sum, value) in sums.iter_mut().zip(predicted) {
                sum[*q] += w * value;
            }
            totals[*q] += w;
        }
    }
    // Every pixel is in its own window with a weight above 0.
    for sum in &mut sums {
        sum.iter_mut().zip(&totals).for_each(|(sum, total)| *sum /= total);
    }
    Ok(sums)
}

fn range(values: impl Iterator<Item = f32>) -> f64 {
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), v| {
        (least.min(f64::from(v)), most.max(f64::from(v)))
    });
    most - least
}

/// The rows' predictions with columns dropped by pivoting: those of which less is left after the others than rounding of `f32`
/// leaves of the largest.
fn dropped(rows: &[Vec<f64>], right: &[[f64; 3]], weights: &[f64]) -> Vec<[f64; 3]> {
    let square = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
    let mut left: Vec<Vec<f64>> = (0..rows[0].len())
        .map(|j| rows.iter().zip(weights).map(|(row, w)| w.sqrt() * row[j]).collect())
        .collect();
    let largest = left.iter().map(|v| square(v)).fold(0.0, f64::max);
    // Gram-Schmidt, the longest first, and twice.
    let mut basis: Vec<Vec<f64>> = Vec::new();
    while !left.is_empty() && basis.len() < rows.len() {
        let longest =
            (0..left.len()).max_by(|&a, &b| square(&left[a]).total_cmp(&square(&left[b])).then(b.cmp(&a)));
        let mut column = left.remove(longest.unwrap_or(0));
        let length = square(&column);
        let share = (rows.len() as f64 - basis.len() as f64).max(0.0) / rows.len() as f64;
        if length <= 0.0 || length < f64::from(f32::EPSILON).powi(2) * largest * share {
            break;
        }
        column.iter_mut().for_each(|v| *v /= length.sqrt());
        for other in &mut left {
            for _ in 0..2 {
                let along: f64 = other.iter().zip(&column).map(|(a, b)| a * b).sum();
                other.iter_mut().zip(&column).for_each(|(a, b)| *a -= along * b);
            }
        }
        basis.push(column);
    }
    projected(&basis, right, weights)
}

/// Least squares on an orthonormal basis of √w times the columns: the predictions are what of √w·y lies in it, over √w.
fn projected(basis: &[Vec<f64>], right: &[[f64; 3]], weights: &[f64]) -> Vec<[f64; 3]> {
    let mut out = vec![[0.0; 3]; right.len()];
    for column in basis {
        for c in 0..3 {
            let along: f64 =
                column.iter().zip(right).zip(weights).map(|((v, y), w)| v * w.sqrt() * y[c]).sum();
            out.iter_mut().zip(column).for_each(|(out, v)| out[c] += along * v);
        }
    }
    // A row without weight has no say in the sums.
    for (out, w) in out.iter_mut().zip(weights) {
        *out = out.map(|v| if *w > 0.0 { v / w.sqrt() } else { 0.0 });
    }
    out
}

/// The rows' predictions with the solution of least norm: columns less their weighted mean, in units of their range, singular
/// values whose square is above 1e-9 of the largest.
fn minimal_norm(
    rows: &[Vec<f64>],
    right: &[[f64; 3]],
    weights: &[f64],
    (positions, window): (bool, usize),
    ranges: &[f64],
) -> Vec<[f64; 3]> {
    let total: f64 = weights.iter().sum();
    let mean = |value: &dyn Fn(usize) -> f64| -> f64 {
        weights.iter().enumerate().map(|(i, w)| w * value(i)).sum::<f64>() / total
    };
    let level = [0, 1, 2].map(|c| mean(&|i| right[i][c]));
    let first = if positions { 3 } else { 1 };
    let mut columns: Vec<Vec<f64>> = (1..rows[0].len())
        .map(|j| {
            let unit = if j < first {
                2.0 * window as f64
            } else {
                let of_window = rows.iter().map(|row| row[j]).fold(f64::NEG_INFINITY, f64::max)
                    - rows.iter().map(|row| row[j]).fold(f64::INFINITY, f64::min);
                of_window.max(1e-3 * ranges[j - first])
            };
            let unit = if unit > 0.0 { unit } else { 1.0 };
            let middle = mean(&|i| rows[i][j]);
            rows.iter().zip(weights).map(|(row, w)| w.sqrt() * (row[j] - middle) / unit).collect()
        })
        .collect();
    rotate(&mut columns);
    let square = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
    let largest = columns.iter().map(|v| square(v)).fold(0.0, f64::max);
    columns.retain(|v| square(v) > 1e-9 * largest);
    for column in &mut columns {
        let length = square(column).sqrt();
        column.iter_mut().for_each(|v| *v /= length);
    }
    let apart: Vec<[f64; 3]> = right.iter().map(|y| [0, 1, 2].map(|c| y[c] - level[c])).collect();
    let mut out = projected(&columns, &apart, weights);
    out.iter_mut().for_each(|out| (0..3).for_each(|c| out[c] += level[c]));
    out
}

/// Rotates pairs of columns until all are at right angles: what is left are singular vectors times singular values.
fn rotate(columns: &mut [Vec<f64>]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for _ in 0..60 {
        let mut done = true;
        for i in 0..columns.len() {
            for j in i + 1..columns.len() {
                let (a, b) = (dot(&columns[i], &columns[i]), dot(&columns[j], &columns[j]));
                let both = dot(&columns[i], &columns[j]);
                if both.abs() <= 1e-15 * (a * b).sqrt() {
                    continue;
                }
                done = false;
                let half = (b - a) / (2.0 * both);
                let t = half.signum() / (half.abs() + (1.0 + half * half).sqrt());
                let cosine = 1.0 / (1.0 + t * t).sqrt();
                let sine = t * cosine;
                for k in 0..columns[i].len() {
                    let (u, v) = (columns[i][k], columns[j][k]);
                    columns[i][k] = cosine * u - sine * v;
                    columns[j][k] = sine * u + cosine * v;
                }
            }
        }
        if done {
            break;
        }
    }
}
