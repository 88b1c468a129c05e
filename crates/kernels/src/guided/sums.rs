//! Means over clipped boxes of a part of the image's rows.

use std::ops::Range;

/// Up to this radius every sum is taken for itself; beyond, from runs of its length.
const DIRECT: usize = 4;

/// Boxes of one radius in one image.
pub(super) struct Boxes {
    pub width: usize,
    pub height: usize,
    pub radius: usize,
    /// 1 over the columns of the box around each column.
    pub over: Vec<f64>,
}

/// Working memory.
pub(super) struct Room {
    product: Vec<f64>,
    across: Vec<f64>,
    starts: Vec<f64>,
    ends: Vec<f64>,
}

impl Room {
    pub fn new(width: usize, rows: usize) -> Self {
        let rows = || vec![0.0; width * rows];
        Self { product: rows(), across: rows(), starts: Vec::new(), ends: Vec::new() }
    }
}

/// The rows that means are taken from and for.
pub(super) struct Rows<'a> {
    pub boxes: &'a Boxes,
    pub seen: &'a Range<usize>,
    pub centers: &'a Range<usize>,
}

// Functions and no closures: those may be compiled without the instruction set.
impl Rows<'_> {
    /// Means of a plane.
    #[inline(always)]
    pub fn mean(&self, a: &[f64], room: &mut Room) -> Vec<f64> {
        let mut out = vec![0.0; self.centers.len() * self.boxes.width];
        self.boxes.means(a, self.seen, &mut out, self.centers, room);
        out
    }

    /// Covariances of two planes with these means.
    #[inline(always)]
    pub fn covariance(
        &self,
        (a, mean_a): (&[f64], &[f64]),
        (b, mean_b): (&[f64], &[f64]),
        room: &mut Room,
    ) -> Vec<f64> {
        let mut product = std::mem::take(&mut room.product);
        for ((p, a), b) in product.iter_mut().zip(a).zip(b) {
            *p = a * b;
        }
        let mut out = self.mean(&product, room);
        room.product = product;
        for ((c, a), b) in out.iter_mut().zip(mean_a).zip(mean_b) {
            *c -= a * b;
        }
        out
    }
}

impl Boxes {
    #[inline(always)]
    pub fn new(width: usize, height: usize, radius: usize) -> Self {
        // The box has the pixel itself at least.
        let over = (0..width).map(|x| 1.0 / count(x, radius, width) as f64).collect();
        Self { width, height, radius, over }
    }

    /// Means over boxes around the pixels of rows `to`, of values of rows `from`, which hold all that the boxes see of the image.
    #[inline(always)]
    pub fn means(
        &self,
        values: &[f64],
        from: &Range<usize>,
        out: &mut [f64],
        to: &Range<usize>,
        room: &mut Room,
    ) {
        let Self { width, radius, .. } = *self;
        for (row, values) in room.across.chunks_mut(width).zip(values.chunks(width)) {
            across(values, radius, row, &mut room.starts, &mut room.ends);
        }
        if radius <= DIRECT {
            self.down(&room.across, from, out, to);
        } else {
            self.down_by_runs(&room.across, from, out, to, (&mut room.starts, &mut room.ends));
        }
        for (y, row) in to.clone().zip(out.chunks_mut(width)) {
            let tall = 1.0 / count(y, radius, self.height) as f64;
            for (value, wide) in row.iter_mut().zip(&self.over) {
                *value *= tall * wide;
            }
        }
    }

    /// Rows that a box around row `y` sees.
    #[inline(always)]
    fn rows(&self, y: usize) -> Range<usize> {
        y.saturating_sub(self.radius)..(y + self.radius + 1).min(self.height)
    }

    #[inline(always)]
    fn down(&self, values: &[f64], from: &Range<usize>, out: &mut [f64], to: &Range<usize>) {
        let width = self.width;
        for (y, out) in to.clone().zip(out.chunks_mut(width)) {
            out.fill(0.0);
            for j in self.rows(y) {
                let row = &values[(j - from.start) * width..][..width];
                for (sum, value) in out.iter_mut().zip(row) {
                    *sum += value;
                }
            }
        }
    }

    /// Sums from the start and to the end of each run of 2r+1 rows: a box is the end of one run and the start of the next.
    /// Runs begin at row 0 of the image.
    #[inline(always)]
    fn down_by_runs(
        &self,
        values: &[f64],
        from: &Range<usize>,
        out: &mut [f64],
        to: &Range<usize>,
        (starts, ends): (&mut Vec<f64>, &mut Vec<f64>),
    ) {
        let (width, side) = (self.width, 2 * self.radius + 1);
        let size = from.len() * width;
        starts.clear();
        starts.extend_from_slice(&values[..size]);
        ends.clear();
        ends.extend_from_slice(&values[..size]);
        for i in 1..from.len() {
            if !(from.start + i).is_multiple_of(side) {
                let (before, here) = starts.split_at_mut(i * width);
                for (sum, value) in here[..width].iter_mut().zip(&before[(i - 1) * width..]) {
                    *sum += value;
                }
            }
            let j = from.len() - 1 - i;
            if !(from.start + j + 1).is_multiple_of(side) {
                let (here, after) = ends.split_at_mut((j + 1) * width);
                for (sum, value) in here[j * width..].iter_mut().zip(&after[..width]) {
                    *sum += value;
                }
            }
        }
        for (y, out) in to.clone().zip(out.chunks_mut(width)) {
            let rows = self.rows(y);
            let (first, last) = (rows.start, rows.end - 1);
            let (to_end, from_start) =
                (&ends[(first - from.start) * width..], &starts[(last - from.start) * width..]);
            if first / side == last / side {
                // All in one run, which begins or ends with it, or at the image's border: a box is as long as a run there.
                let whole = if first.is_multiple_of(side) { from_start } else { to_end };
                out.copy_from_slice(&whole[..width]);
            } else {
                for ((out, a), b) in out.iter_mut().zip(to_end).zip(from_start) {
                    *out = a + b;
                }
            }
        }
    }
}

/// Pixels of a line of `size` within `radius` of place `at`.
#[inline(always)]
fn count(at: usize, radius: usize, size: usize) -> usize {
    (at + radius + 1).min(size) - at.saturating_sub(radius)
}

/// Sums over 2·`radius`+1 neighbours in a line, zero outside.
#[inline(always)]
fn across(row: &[f64], radius: usize, out: &mut [f64], starts: &mut Vec<f64>, ends: &mut Vec<f64>) {
    if radius <= DIRECT {
        // In front and behind as many zeros as a sum may reach.
        starts.clear();
        starts.resize(row.len() + 2 * radius, 0.0);
        starts[radius..radius + row.len()].copy_from_slice(row);
        out.copy_from_slice(&starts[..row.len()]);
        for d in 1..=2 * radius {
            for (sum, value) in out.iter_mut().zip(&starts[d..]) {
                *sum += value;
            }
        }
        return;
    }
    let side = 2 * radius + 1;
    let padded = (row.len() + 2 * radius).next_multiple_of(side);
    starts.clear();
    starts.resize(padded, 0.0);
    starts[radius..radius + row.len()].copy_from_slice(row);
    ends.clear();
    ends.extend_from_slice(starts);
    for i in 1..padded {
        if !i.is_multiple_of(side) {
            starts[i] += starts[i - 1];
        }
        let j = padded - 1 - i;
        if !(j + 1).is_multiple_of(side) {
            ends[j] += ends[j + 1];
        }
    }
    for (x, sum) in out.iter_mut().enumerate() {
        // A window that is exactly one run is in both.
        *sum = if x.is_multiple_of(side) { ends[x] } else { ends[x] + starts[x + side - 1] };
    }
}
