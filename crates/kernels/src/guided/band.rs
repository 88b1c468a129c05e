//! A few rows of the result, with the rows above and below that they need.

use std::ops::Range;

use super::params::GuidedParams;
use super::solve::{Normal, solve};
use super::sums::{Boxes, Room, Rows};
use crate::engine::Vectorised;

/// Rows from `first` on, as many as `out` holds of each target.
pub(super) struct Band<'a, 'b> {
    pub params: &'a GuidedParams,
    pub guide: &'a [&'a [f32]],
    pub targets: &'a [&'a [f32]],
    pub guide_means: &'a [f64],
    pub target_means: &'a [f64],
    pub first: usize,
    pub out: Vec<&'b mut [f32]>,
}

impl Vectorised for Band<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run(mut self) {
        let GuidedParams { width, height, radius, epsilon } = *self.params;
        let wider = |rows: &Range<usize>| rows.start.saturating_sub(radius)..(rows.end + radius).min(height);
        let Some(out) = self.out.first() else { return };
        let rows = self.first..self.first + out.len() / width;
        // Windows that contain a pixel of the band, and what they see.
        let centers = wider(&rows);
        let seen = wider(&centers);
        let boxes = Boxes::new(width, height, radius);
        let mut room = Room::new(width, seen.len());
        let means_of = Rows { boxes: &boxes, seen: &seen, centers: &centers };

        let mut guide: Vec<Vec<f64>> = Vec::new();
        let mut means: Vec<Vec<f64>> = Vec::new();
        for (plane, mean) in self.guide.iter().zip(self.guide_means) {
            guide.push(part(plane, *mean, width, &seen));
            means.push(means_of.mean(&guide[guide.len() - 1], &mut room));
        }
        let n = guide.len();
        // Cov(I, I), lower triangle by rows.
        let mut covariances = Vec::new();
        for i in 0..n {
            for j in 0..=i {
                let (a, b) = ((&*guide[i], &*means[i]), (&*guide[j], &*means[j]));
                covariances.push(means_of.covariance(a, b, &mut room));
            }
        }
        let mut band_mean = vec![0.0; rows.len() * width];
        let skip = (rows.start - seen.start) * width;
        for (t, out) in self.out.iter_mut().enumerate() {
            let target = part(self.targets[t], self.target_means[t], width, &seen);
            let mut b = means_of.mean(&target, &mut room);
            // Cov(I, y), which become a.
            let mut a: Vec<Vec<f64>> = Vec::new();
            for (guide, mean) in guide.iter().zip(&means) {
                a.push(means_of.covariance((guide, mean), (&target, &b), &mut room));
            }
            if n == 1 {
                for (a, variance) in a[0].iter_mut().zip(&covariances[0]) {
                    // Rounding may leave a variance below 0; without one and without ε there is nothing to follow.
                    let over = variance.max(0.0) + epsilon;
                    *a = if over > 0.0 { *a / over } else { 0.0 };
                }
            } else {
                for p in 0..b.len() {
                    let mut normal = Normal::new(n, |i, j| covariances[i * (i + 1) / 2 + j][p], epsilon);
                    let solution = solve(&mut normal, |i| a[i][p]);
                    a.iter_mut().zip(solution).for_each(|(a, s)| a[p] = s);
                }
            }
            for (a, mean) in a.iter().zip(&means) {
                for ((b, a), mean) in b.iter_mut().zip(a).zip(mean) {
                    *b -= a * mean;
                }
            }
            boxes.means(&b, &centers, &mut band_mean, &rows, &mut room);
            let mut sum: Vec<f64> = band_mean.iter().map(|b| b + self.target_means[t]).collect();
            for (a, guide) in a.iter().zip(&guide) {
                boxes.means(a, &centers, &mut band_mean, &rows, &mut room);
                for ((sum, a), i) in sum.iter_mut().zip(&band_mean).zip(&guide[skip..]) {
                    *sum += a * i;
                }
            }
            for (out, sum) in out.iter_mut().zip(&sum) {
                *out = *sum as f32;
            }
        }
    }
}

/// Rows of a plane, less its mean.
#[inline(always)]
fn part(plane: &[f32], mean: f64, width: usize, rows: &Range<usize>) -> Vec<f64> {
    plane[rows.start * width..rows.end * width].iter().map(|v| f64::from(*v) - mean).collect()
}
