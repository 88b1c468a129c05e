//! One model in `f64` with its hat matrix, straight from the equations: the oracle of the tests.

use super::field::{Planes, Rules};
use crate::engine::mirror;

/// A model around one pixel.
#[derive(Clone, Debug)]
pub struct Twin {
    /// Pixels of the window, as indices into the image.
    pub pixels: Vec<usize>,
    /// w(i,j) of each, 0 where it is below the limit.
    pub weights: Vec<f64>,
    /// H, a row for every pixel.
    pub hat: Vec<Vec<f64>>,
}

impl Twin {
    /// The model with bandwidth `k` in the window of `radius` around `center`.
    #[must_use]
    pub fn new(
        (width, height): (usize, usize),
        planes: &Planes<'_>,
        rules: &Rules,
        center: (usize, usize),
        radius: usize,
        k: f64,
    ) -> Self {
        let (x, y) = center;
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(height);
        let pixels: Vec<usize> = rows.flat_map(|j| columns.clone().map(move |i| j * width + i)).collect();
        let weight = |&p: &usize| {
            let distance = patch_distance((width, height), planes, rules, center, (p % width, p / width));
            let w = (-distance / (2.0 * (f64::from(rules.range_sigma) * k).powi(2))).exp();
            if w < f64::from(rules.least_weight) { 0.0 } else { w }
        };
        let weights: Vec<f64> = pixels.iter().map(weight).collect();
        let design = design((width, height), planes, &pixels, y * width + x);
        let hat = hat(&design, &weights, rules.ridge);
        Self { pixels, weights, hat }
    }

    /// H y.
    #[must_use]
    pub fn times(&self, y: &[f64]) -> Vec<f64> {
        self.hat.iter().map(|row| row.iter().zip(y).map(|(h, y)| h * y).sum()).collect()
    }

    /// Σ_s H_js² Var(s).
    #[must_use]
    pub fn variance(&self, variance: &[f64]) -> Vec<f64> {
        self.hat.iter().map(|row| row.iter().zip(variance).map(|(h, v)| h * h * v).sum()).collect()
    }
}

/// P of Eq. 4 with d of Eq. 5 at k = 1 and ε = 0.
fn patch_distance(
    (width, height): (usize, usize),
    planes: &Planes<'_>,
    rules: &Rules,
    (x, y): (usize, usize),
    (i, j): (usize, usize),
) -> f64 {
    let f = rules.patch_radius as isize;
    let at = |x: usize, y: usize, (dx, dy): (isize, isize)| {
        mirror(y as isize + dy, height) * width + mirror(x as isize + dx, width)
    };
    let mut sum = 0.0;
    for tap in (-f..=f).flat_map(|dx| (-f..=f).map(move |dy| (dx, dy))) {
        let (p, q) = (at(x, y, tap), at(i, j, tap));
        for c in 0..3 {
            let of = |planes: &[&[f32]; 3], p: usize| f64::from(planes[c][p]);
            let square = (of(&planes.guide, p) - of(&planes.guide, q)).powi(2);
            let (vp, vq) = (of(&planes.guide_variance, p), of(&planes.guide_variance, q));
            sum += if vp + vq > 0.0 {
                ((square - (vp + vp.min(vq))) / (vp + vq)).min(1e4)
            } else if square > 0.0 {
                1e4
            } else {
                0.0
            };
        }
    }
    (sum / (3 * (2 * f + 1).pow(2)) as f64).max(0.0)
}

/// Rows of X.
fn design(
    (width, height): (usize, usize),
    planes: &Planes<'_>,
    pixels: &[usize],
    center: usize,
) -> Vec<Vec<f64>> {
    let range = |of: &mut dyn Iterator<Item = f64>| {
        let (low, high) = of.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let column = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let there = range(&mut pixels.iter().map(|p| value(*p)));
        let everywhere = range(&mut (0..width * height).map(value));
        let by = there.max(1e-3 * everywhere);
        let by = if by > 0.0 { by } else { 1.0 };
        pixels.iter().map(|p| (value(*p) - value(center)) / by).collect()
    };
    let mut columns = vec![column(&|p| (p % width) as f64), column(&|p| (p / width) as f64)];
    columns.extend(planes.features.iter().map(|plane| column(&|p| f64::from(plane[p]))));
    (0..pixels.len()).map(|j| std::iter::once(1.0).chain(columns.iter().map(|c| c[j])).collect()).collect()
}

/// X (XᵀWX + R)⁻¹ XᵀW. Without ridge columns that the others determine are left out.
fn hat(design: &[Vec<f64>], weights: &[f64], ridge: f64) -> Vec<Vec<f64>> {
    let n = design[0].len();
    let total: f64 = weights.iter().sum();
    let normal =
        |i: usize, j: usize| -> f64 { design.iter().zip(weights).map(|(row, w)| w * row[i] * row[j]).sum() };
    let matrix: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| normal(i, j) + if i == j && i > 0 { ridge * total } else { 0.0 }).collect())
        .collect();
    let inverse = inverse(matrix);
    design
        .iter()
        .map(|row| {
            let left: Vec<f64> =
                (0..n).map(|j| row.iter().zip(&inverse).map(|(x, k)| x * k[j]).sum()).collect();
            let h =
                |(other, w): (&Vec<f64>, &f64)| w * other.iter().zip(&left).map(|(x, l)| x * l).sum::<f64>();
            design.iter().zip(weights).map(h).collect()
        })
        .collect()
}

/// Gauss and Jordan's elimination; rows and columns of a pivot that is rounding are 0 in the result.
fn inverse(mut m: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = m.len();
    let first: Vec<f64> = (0..n).map(|i| m[i][i]).collect();
    let mut left_out = Vec::new();
    for k in 0..n {
        if m[k][k] <= 1e-10 * first[k] || m[k][k] <= 0.0 {
            left_out.push(k);
            continue;
        }
        let pivot = m[k][k];
        m[k][k] = 1.0;
        m[k].iter_mut().for_each(|v| *v /= pivot);
        for i in (0..n).filter(|i| *i != k) {
            let factor = m[i][k];
            m[i][k] = 0.0;
            let from = m[k].clone();
            m[i].iter_mut().zip(&from).for_each(|(value, from)| *value -= factor * from);
        }
    }
    for k in left_out {
        m.iter_mut().for_each(|row| row[k] = 0.0);
        m[k].fill(0.0);
    }
    m
}
