//! Patch distances at k = 1 (Eq. 4, Eq. 5): from one pixel to all of a window, or from all pixels of an area to all of their
//! windows, with the same bits. The second is the cheaper one where more than one pixel in thirty is a centre.

use std::ops::Range;

use super::field::Field;
use crate::InstructionSet;
use crate::engine::Vectorised;
use crate::joint_nlm::squared;

/// Pixels that are worked on together; rows of a window are short.
pub(super) const LANES: usize = 8;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Area {
    /// Column of its first pixel.
    pub x: usize,
    /// Row of its first pixel.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

/// Distances from all pixels of an area, kept.
#[derive(Clone, Debug, Default)]
pub struct Distances {
    area: Area,
    radius: usize,
    /// One plane of the area for each offset, row by row.
    planes: Vec<f32>,
    /// Sums of a pair of pixels' channels, and of columns of them.
    map: Vec<f32>,
    line: Vec<f32>,
    means: Vec<f32>,
}

impl Distances {
    /// Computes them from all pixels of `area`, which lies in the image, to their windows of `radius`.
    pub fn fill(&mut self, field: &Field, area: Area, radius: usize, level: InstructionSet) {
        let side = 2 * radius + 1;
        (self.area, self.radius) = (area, radius);
        self.planes.resize(side * side * area.width * area.height, 0.0);
        level.run(Fill { distances: self, field });
    }

    /// Forgets them.
    pub fn clear(&mut self) {
        self.area = Area::default();
    }

    /// Whether it has all from `center` to a window of `radius`.
    #[must_use]
    pub fn holds(&self, (x, y): (usize, usize), radius: usize) -> bool {
        let Area { x: left, y: top, width, height } = self.area;
        radius <= self.radius && x.wrapping_sub(left) < width && y.wrapping_sub(top) < height
    }

    /// Distances from `center` to the pixels of `columns` and `rows` of its window, into rows of `out` of length `pitch`.
    #[inline(always)]
    pub(super) fn copy(
        &self,
        center: (usize, usize),
        columns: &Range<usize>,
        rows: &Range<usize>,
        out: &mut [f32],
        pitch: usize,
    ) {
        let (side, size) = (2 * self.radius + 1, self.area.width * self.area.height);
        let place = (center.1 - self.area.y) * self.area.width + center.0 - self.area.x;
        for (row, out) in rows.clone().zip(out.chunks_mut(pitch)) {
            let first = (row + self.radius - center.1) * side + columns.start + self.radius - center.0;
            for (out, plane) in
                out[..columns.len()].iter_mut().zip(self.planes[first * size..].chunks_exact(size))
            {
                *out = plane[place];
            }
        }
    }
}

/// Sum over the channels of a row of pairs of pixels: the pixels at `p` with those at `q` of the bordered planes.
#[inline(always)]
fn pairs(field: &Field, p: usize, q: usize, out: &mut [f32]) {
    let n = out.len();
    for (c, (m, v)) in field.patches[..3].iter().zip(&field.patches[3..]).enumerate() {
        let (a, b, va, vb) = (lanes(m, p, n), lanes(m, q, n), lanes(v, p, n), lanes(v, q, n));
        let out = out.as_chunks_mut::<LANES>().0;
        for ((((out, a), b), va), vb) in out.iter_mut().zip(a).zip(b).zip(va).zip(vb) {
            let mut d = [0.0; LANES];
            for l in 0..LANES {
                d[l] = squared((a[l], va[l]), (b[l], vb[l]), 1.0);
            }
            let mut sum = *out;
            for l in 0..LANES {
                sum[l] = if c == 0 { d[l] } else { sum[l] + d[l] };
            }
            *out = sum;
        }
    }
}

/// `n` values from `at` on, in lanes.
#[inline(always)]
fn lanes(plane: &[f32], at: usize, n: usize) -> &[[f32; LANES]] {
    plane[at..at + n].as_chunks().0
}

/// Sum of `taps` vectors that begin `step` values after each other.
#[inline(always)]
fn taken(values: &[f32], step: usize, taps: usize) -> [f32; LANES] {
    let mut sum = [0.0; LANES];
    for tap in 0..taps {
        // Lanes that are copied share no memory with sums.
        let mut vector = [0.0; LANES];
        vector.copy_from_slice(&values[tap * step..][..LANES]);
        for l in 0..LANES {
            sum[l] += vector[l];
        }
    }
    sum
}

struct Fill<'a> {
    distances: &'a mut Distances,
    field: &'a Field,
}

impl Vectorised for Fill<'_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { distances, field } = self;
        let Distances { area, radius, planes, map, line, means } = distances;
        let (side, taps) = (2 * *radius + 1, 2 * field.rules.patch_radius + 1);
        let wide = (area.width + taps - 1).next_multiple_of(LANES);
        map.resize(wide * (area.height + taps - 1), 0.0);
        // Taps are read beyond the end of what counts.
        line.resize(wide + LANES, 0.0);
        means.resize(wide, 0.0);
        let scale = 1.0 / (3 * taps * taps) as f32;
        // Pixels of a line that have their neighbour `offset` - `radius` further within the image.
        let inside = |first: usize, count: usize, offset: usize, size: usize| {
            let low = radius.saturating_sub(first + offset).min(count);
            let high = (size + *radius).saturating_sub(first + offset).min(count);
            low..high.max(low)
        };
        for (o, plane) in planes.chunks_exact_mut(area.width * area.height).take(side * side).enumerate() {
            let (dx, dy) = (o % side, o / side);
            let columns = inside(area.x, area.width, dx, field.width);
            let rows = inside(area.y, area.height, dy, field.height);
            if columns.is_empty() || rows.is_empty() {
                continue;
            }
            // Whole lanes: rows of planes have room for them.
            let n = (columns.len() + taps - 1).next_multiple_of(LANES);
            for j in rows.start..rows.end + taps - 1 {
                // With the border a pixel's patch begins at its own place.
                let p = (area.y + j) * field.pitch + area.x + columns.start;
                let q = (area.y + j + dy - *radius) * field.pitch + area.x + columns.start + dx - *radius;
                pairs(field, p, q, &mut map[j * wide..][..n]);
            }
            for y in rows.clone() {
                for (g, sum) in line[..n].as_chunks_mut().0.iter_mut().enumerate() {
                    *sum = taken(&map[y * wide + g * LANES..], wide, taps);
                }
                let count = columns.len().next_multiple_of(LANES);
                for (g, mean) in means[..count].as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
                    let sum = taken(&line[g * LANES..], 1, taps);
                    for l in 0..LANES {
                        let distance = sum[l] * scale;
                        mean[l] = if distance > 0.0 { distance } else { 0.0 };
                    }
                }
                plane[y * area.width..][columns.clone()].copy_from_slice(&means[..columns.len()]);
            }
        }
    }
}

/// P from pixel `center` to the pixels of `columns` and `rows`, into rows of `out` of length `pitch`, a multiple of
/// the lanes that holds the columns.
#[inline(always)]
pub(super) fn from_center(
    field: &Field,
    center: (usize, usize),
    columns: &Range<usize>,
    rows: &Range<usize>,
    out: &mut [f32],
    pitch: usize,
) {
    let side = 2 * field.rules.patch_radius + 1;
    let [m0, m1, m2, v0, v1, v2] = &field.patches;
    let scale = 1.0 / (3 * side * side) as f32;
    // With the border a pixel's patch begins at its own place.
    let here = |i: usize, j: usize| (center.1 + j) * field.pitch + center.0 + i;
    for (row, out) in rows.clone().zip(out.chunks_mut(pitch)) {
        for (block, out) in out.chunks_exact_mut(LANES).enumerate() {
            let first = columns.start + block * LANES;
            if first >= columns.end {
                break;
            }
            let mut sum = [0.0f32; LANES];
            for i in 0..side {
                let mut line = [0.0f32; LANES];
                for j in 0..side {
                    let p = here(i, j);
                    let q = (row + j) * field.pitch + first + i;
                    let end = q + LANES;
                    let (a, b, c) = (&m0[q..end], &m1[q..end], &m2[q..end]);
                    let (va, vb, vc) = (&v0[q..end], &v1[q..end], &v2[q..end]);
                    let own = [(m0[p], v0[p]), (m1[p], v1[p]), (m2[p], v2[p])];
                    for l in 0..LANES {
                        let r = squared(own[0], (a[l], va[l]), 1.0);
                        let g = squared(own[1], (b[l], vb[l]), 1.0);
                        let b = squared(own[2], (c[l], vc[l]), 1.0);
                        line[l] += r + g + b;
                    }
                }
                for l in 0..LANES {
                    sum[l] += line[l];
                }
            }
            for (out, sum) in out.iter_mut().zip(sum) {
                let mean = sum * scale;
                *out = if mean > 0.0 { mean } else { 0.0 };
            }
        }
    }
}
