//! The table of optional statistics.
//!
//! Central moments are added and merged by the formulas of Pébay, "Formulas for robust, one-pass parallel computation of
//! covariances and arbitrary-order statistical moments" (Sandia report SAND2008-6212, 2008): no large near-equal numbers
//! are subtracted.

use std::cmp::Ordering;

use super::statistic::{BoxCox, Statistic};

/// One optional statistic: what is kept of a channel's samples, and what comes of it.
#[derive(Debug)]
pub struct Row {
    /// Id in layer names and messages, lower case.
    pub id: &'static str,
    /// What a frame has of it, for each channel: names of its images, in order.
    pub images: &'static [&'static str],
    /// Fewest samples per pixel that give it a meaning.
    pub least: u32,
    /// What is kept of a channel before any sample.
    pub(super) start: &'static [f64],
    /// Adds samples.
    pub(super) add: fn(Statistic, &mut [f64], &Run<'_>),
    /// Puts what is kept of other samples to what is kept of some. Neither set of samples is empty.
    pub(super) merge: fn(&mut [f64], &[f64], [f64; 2]),
    /// The value of each image, from what is kept of so many samples.
    pub(super) finish: fn(&[f64], f64, &mut [f64]),
}

/// Samples of one channel, in their order.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// Samples that came before.
    pub before: u64,
    /// Index of the first.
    pub first: u32,
    /// Values.
    pub values: &'a [f64],
    /// Positions in the pixel.
    pub positions: &'a [[f32; 2]],
}

/// Every optional statistic, in the order of [`Statistic`].
pub static TABLE: [Row; 6] = [
    Row {
        id: "third-moment",
        images: &["thirdMoment"],
        least: 3,
        // Mean, and sums of the squares and cubes of the deviations from it.
        start: &[0.0; 3],
        add: add_third,
        merge: merge_third,
        finish: |kept, n, out| out[0] = kept[2] * (n / ((n - 1.0) * (n - 2.0))),
    },
    Row {
        id: "least",
        images: &["least"],
        least: 1,
        start: &[f64::INFINITY],
        add: |_, kept, run| kept[0] = run.values.iter().fold(kept[0], |least, x| least.min(*x)),
        merge: |kept, other, _| kept[0] = kept[0].min(other[0]),
        finish: |kept, _, out| out[0] = kept[0],
    },
    Row {
        id: "greatest",
        images: &["greatest"],
        least: 1,
        start: &[f64::NEG_INFINITY],
        add: |_, kept, run| kept[0] = run.values.iter().fold(kept[0], |greatest, x| greatest.max(*x)),
        merge: |kept, other, _| kept[0] = kept[0].max(other[0]),
        finish: |kept, _, out| out[0] = kept[0],
    },
    Row {
        id: "four-parts",
        images: &["part0", "part1", "part2", "part3"],
        least: 4,
        // Sums of the parts, then their numbers of samples.
        start: &[0.0; 8],
        add: add_parts,
        merge: |kept, other, _| kept.iter_mut().zip(other).for_each(|(kept, other)| *kept += other),
        finish: |kept, _, out| {
            let (sums, counts) = kept.split_at(4);
            for ((out, sum), count) in out.iter_mut().zip(sums).zip(counts) {
                *out = sum / count.max(1.0);
            }
        },
    },
    Row {
        id: "box-cox",
        images: &["mean", "variance", "floored"],
        least: 2,
        // Of transformed samples the mean and the sum of the squares of the deviations from it; samples below the floor.
        start: &[0.0; 3],
        add: add_box_cox,
        merge: merge_box_cox,
        finish: |kept, n, out| {
            out[0] = kept[0];
            out[1] = kept[1] / ((n - 1.0) * n);
            out[2] = kept[2] / n;
        },
    },
    Row {
        id: "position",
        images: &["right", "down"],
        least: 2,
        // Means of the samples and of both coordinates; sums of the products of the deviations from them.
        start: &[0.0; 5],
        add: add_position,
        merge: merge_position,
        finish: |kept, n, out| {
            out[0] = kept[3] / (n - 1.0);
            out[1] = kept[4] / (n - 1.0);
        },
    },
];

impl Statistic {
    /// Its row of the table.
    #[must_use]
    pub fn row(self) -> &'static Row {
        &TABLE[self.index()]
    }

    fn index(self) -> usize {
        match self {
            Self::ThirdMoment => 0,
            Self::Least => 1,
            Self::Greatest => 2,
            Self::FourParts => 3,
            Self::BoxCox(_) => 4,
            Self::Position => 5,
        }
    }

    /// By row, Box–Cox transforms by λ and floor.
    pub(super) fn cmp_in_table(&self, other: &Self) -> Ordering {
        let transform = |statistic: &Self| match statistic {
            Self::BoxCox(transform) => (transform.lambda(), transform.floor()),
            _ => (0.0, 0.0),
        };
        let ((lambda, floor), (other_lambda, other_floor)) = (transform(self), transform(other));
        let of_transforms = lambda.total_cmp(&other_lambda).then(floor.total_cmp(&other_floor));
        self.index().cmp(&other.index()).then(of_transforms)
    }
}

/// Pébay (2008), formulas 1.1 and 1.2 of the second and third order for one new sample.
fn add_third(_: Statistic, kept: &mut [f64], run: &Run<'_>) {
    let [mean, squares, cubes] = kept else { return };
    let mut n = run.before as f64;
    for x in run.values {
        let before = n;
        n += 1.0;
        let delta = x - *mean;
        let step = delta / n;
        let square = delta * step * before;
        *cubes += step * (square * (n - 2.0) - 3.0 * *squares);
        *squares += square;
        *mean += step;
    }
}

/// The same for two sets.
fn merge_third(kept: &mut [f64], other: &[f64], [a, b]: [f64; 2]) {
    let ([mean, squares, cubes], [mean_b, squares_b, cubes_b]) = (kept, other) else { return };
    let n = a + b;
    let delta = mean_b - *mean;
    let step = delta / n;
    *cubes += cubes_b + delta * step * step * a * b * (a - b) + 3.0 * step * (a * squares_b - b * *squares);
    *squares += squares_b + delta * step * a * b;
    *mean += step * b;
}

fn add_parts(_: Statistic, kept: &mut [f64], run: &Run<'_>) {
    for (x, part) in run.values.iter().zip((0..4).cycle().skip(run.first as usize % 4)) {
        kept[part] += x;
        kept[4 + part] += 1.0;
    }
}

fn add_box_cox(statistic: Statistic, kept: &mut [f64], run: &Run<'_>) {
    let (Statistic::BoxCox(transform), [mean, squares, floored]) = (statistic, kept) else { return };
    let transform: BoxCox = transform;
    let mut n = run.before as f64;
    for x in run.values {
        n += 1.0;
        let g = transform.of(*x);
        let delta = g - *mean;
        *mean += delta / n;
        *squares += delta * (g - *mean);
        *floored += f64::from(u8::from(*x < transform.floor()));
    }
}

fn merge_box_cox(kept: &mut [f64], other: &[f64], [a, b]: [f64; 2]) {
    let ([mean, squares, floored], [mean_b, squares_b, floored_b]) = (kept, other) else { return };
    let n = a + b;
    let delta = mean_b - *mean;
    *squares += squares_b + delta * delta * (a * b / n);
    *mean += delta * (b / n);
    *floored += floored_b;
}

/// Pébay (2008), formula of the covariance for one new sample.
fn add_position(_: Statistic, kept: &mut [f64], run: &Run<'_>) {
    let [mean, right, down, with_right, with_down] = kept else { return };
    let mut n = run.before as f64;
    for (x, position) in run.values.iter().zip(run.positions) {
        n += 1.0;
        let delta = x - *mean;
        *mean += delta / n;
        for (coordinate, center, products) in
            [(position[0], &mut *right, &mut *with_right), (position[1], &mut *down, &mut *with_down)]
        {
            let coordinate = f64::from(coordinate);
            *center += (coordinate - *center) / n;
            *products += delta * (coordinate - *center);
        }
    }
}

/// The same for two sets.
fn merge_position(kept: &mut [f64], other: &[f64], [a, b]: [f64; 2]) {
    let n = a + b;
    let delta: [f64; 3] = std::array::from_fn(|k| other[k] - kept[k]);
    for axis in 1..3 {
        kept[2 + axis] += other[2 + axis] + delta[0] * delta[axis] * (a * b / n);
    }
    for (mean, delta) in kept.iter_mut().zip(delta) {
        *mean += delta * (b / n);
    }
}
