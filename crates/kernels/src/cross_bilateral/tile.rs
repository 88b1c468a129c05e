//! The bank in one tile, row by row.
//!
//! For a row of pixels and each row of neighbours: e^−D at all horizontal offsets, which stays in the first cache, then for each filter
//! whose window has that row the sums over its own offsets, in registers. What a row of pixels has summed up stays in the first
//! cache too.

use super::params::{BilateralGuide, BilateralParams, MAX_GUIDES, Spatial};
use crate::engine::Vectorised;
use crate::engine::{Copies, Grid, LINE, Scratch, TILE, Tile, TileRows};
use crate::nlm::maps::exponential::exponential;

/// Pixels that are worked on together.
const LANES: usize = 16;
type Lanes = [f32; LANES];

/// D beyond the image.
const OUTSIDE: f32 = 1e9;

/// One filter.
struct Factors {
    reach: usize,
    /// exp(−d²/(2σ²)) for d = 0, 1, …
    table: Vec<f64>,
}

/// What all tiles share. Rows are read in whole lanes, beyond what counts.
pub(super) struct Layout {
    guides: usize,
    averaged: usize,
    /// Filters that look beyond the pixel itself.
    filters: Vec<Factors>,
    /// The largest of their windows.
    reach: usize,
    /// No window has more beside a pixel.
    side: usize,
    /// Guide values, their scaled variances, then what is averaged.
    area: Grid,
    /// Values of the table of row sums that belong to one filter.
    filter: usize,
}

impl Layout {
    pub fn new(params: &BilateralParams, guides: usize, averaged: usize, bank: &[Spatial]) -> Self {
        let side = params.width.max(params.height) - 1;
        let filters: Vec<Factors> = bank
            .iter()
            .filter(|spatial| spatial.reach().min(side) > 0)
            .map(|spatial| {
                let reach = spatial.reach().min(side);
                let over = 2.0 * f64::from(spatial.sigma).powi(2);
                Factors { reach, table: (0..=reach).map(|d| (-((d * d) as f64) / over).exp()).collect() }
            })
            .collect();
        let reach = filters.iter().map(|filter| filter.reach).max().unwrap_or(0);
        // A whole number of lines on the left, so that the tile's own pixels are aligned.
        let left = reach.next_multiple_of(LINE);
        let size = (left + TILE.0 + reach, TILE.1 + 2 * reach);
        Self {
            guides,
            averaged,
            filters,
            reach,
            side,
            area: Grid::interleaved(2 * guides + averaged, (left, reach), size),
            filter: (averaged + 1) * TILE.0,
        }
    }

    /// Window radius of a filter, no more than the image has.
    pub fn reach(&self, spatial: &Spatial) -> usize {
        spatial.reach().min(self.side)
    }

    /// Values of a worker's parts: area, columns beyond the image, e^−D, sums, factors.
    fn sizes(&self) -> [usize; 5] {
        let offsets = 2 * self.reach + 1;
        [
            self.area.interleaved_size(),
            self.area.plane,
            offsets * TILE.0,
            self.filters.len() * self.filter,
            offsets,
        ]
    }
}

/// A worker's memory.
pub(super) struct Work(Scratch);

impl Work {
    pub fn new(layout: &Layout) -> Self {
        Self(Scratch::new(layout.sizes().iter().sum()))
    }
}

pub(super) struct Filter<'a, 'b> {
    pub params: &'a BilateralParams,
    pub guides: &'a [BilateralGuide<'a>],
    pub planes: &'a [&'a [f32]],
    pub layout: &'a Layout,
    pub work: &'a mut Work,
    pub tile: Tile,
    pub out: Vec<TileRows<'b>>,
}

impl Vectorised for Filter<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run(self) {
        let Self { params, guides, planes, layout, work, tile, mut out } = self;
        let [area, beyond, shared, sums, factors] = work.0.parts(layout.sizes());
        copy(params, guides, planes, layout, tile, area, beyond);
        let (x, y) = (tile.x as isize, tile.y as isize);
        let reach = layout.reach as isize;
        let columns = Columns {
            first: (-reach).max(1 - x - tile.width as isize),
            last: reach.min(params.width as isize - 1 - x),
            width: tile.width.next_multiple_of(LANES),
        };
        for row in 0..tile.height {
            sums.fill(0.0);
            let here = y + row as isize;
            for dy in (-reach).max(-here)..=reach.min(params.height as isize - 1 - here) {
                let pair = Rows { layout, area, columns: &columns, row, dy };
                let floor = params.floor;
                pair.share(guides, floor, beyond, shared);
                for (filter, sums) in layout.filters.iter().zip(sums.chunks_exact_mut(layout.filter)) {
                    if dy.unsigned_abs() <= filter.reach {
                        pair.add(filter, shared, factors, sums);
                    }
                }
            }
            finish(layout, sums, &mut out, row);
        }
    }
}

/// Copies what the tile's windows see.
#[inline(always)]
fn copy(
    params: &BilateralParams,
    guides: &[BilateralGuide<'_>],
    planes: &[&[f32]],
    layout: &Layout,
    tile: Tile,
    area: &mut [f32],
    beyond: &mut [f32],
) {
    let grid = &layout.area;
    let copies = Copies { width: params.width, height: params.height, tile };
    for (k, guide) in guides.iter().enumerate() {
        copies.marked(grid, guide.value, &mut area[k * grid.plane..], 0.0);
        let to = &mut area[(layout.guides + k) * grid.plane..];
        copies.marked(grid, guide.variance, to, 0.0);
        // σ_k goes into the denominator, so that a difference loses no digit.
        let scale = doubled_square(guide);
        for j in 0..grid.rows {
            for variance in &mut to[j * grid.pitch..][..grid.columns] {
                *variance *= scale;
            }
        }
    }
    for (k, plane) in planes.iter().enumerate() {
        copies.marked(grid, plane, &mut area[(2 * layout.guides + k) * grid.plane..], 0.0);
    }
    // Rows of neighbours lie in the image, columns may not.
    let one = Grid { rows: 1, ..*grid };
    copies.mark_columns(&one, beyond, OUTSIDE);
}

/// 2σ_k².
#[inline(always)]
fn doubled_square(guide: &BilateralGuide<'_>) -> f32 {
    2.0 * guide.sigma * guide.sigma
}

/// Horizontal offsets at which some pixel of the tile has its neighbour in the image, and the width of its rows in whole lanes.
struct Columns {
    first: isize,
    last: isize,
    width: usize,
}

/// A row of the tile and the row of its neighbours `dy` further.
struct Rows<'a> {
    layout: &'a Layout,
    area: &'a [f32],
    columns: &'a Columns,
    row: usize,
    dy: isize,
}

impl Rows<'_> {
    /// The pixels and their neighbours at offset 0 in plane `k`, as indices into the area.
    #[inline(always)]
    fn places(&self, k: usize) -> (usize, usize) {
        let grid = &self.layout.area;
        let here = grid.origin() + self.row * grid.pitch + k * grid.plane;
        (here, here.wrapping_add_signed(self.dy * grid.pitch as isize))
    }

    /// e^−D at every offset, 0 where the neighbour is beyond the image.
    #[inline(always)]
    fn share(&self, guides: &[BilateralGuide<'_>], floor: f32, beyond: &[f32], shared: &mut [f32]) {
        let Columns { first, last, width } = *self.columns;
        let offsets = (last - first + 1) as usize;
        let mut rows = [Guided::default(); MAX_GUIDES];
        let rows = &mut rows[..guides.len()];
        for (k, (row, guide)) in rows.iter_mut().zip(guides).enumerate() {
            for (i, plane) in [k, self.layout.guides + k].into_iter().enumerate() {
                let (here, there) = self.places(plane);
                row.own[i] = &self.area[here..][..width];
                row.other[i] = &self.area[there.wrapping_add_signed(first)..][..width + offsets - 1];
            }
            row.floor = floor * doubled_square(guide);
        }
        let beyond = &beyond[self.layout.area.left.wrapping_add_signed(first)..][..width + offsets - 1];
        // Shares no memory with what is read, and so loops over it become vectors.
        let mut distances = [0.0; TILE.0];
        let distances = &mut distances[..width];
        for (o, to) in shared.chunks_exact_mut(TILE.0).take(offsets).enumerate() {
            distances.copy_from_slice(&beyond[o..][..width]);
            for pair in rows.chunks(2) {
                match pair {
                    [a, b] => add_two(a, b, o, distances),
                    [a] => add_one(a, o, distances),
                    _ => {}
                }
            }
            for (to, distance) in to.iter_mut().zip(&*distances) {
                *to = exponential(*distance);
            }
        }
    }

    /// Adds the row of neighbours to the sums of one filter: of its planes, then of its weights.
    #[inline(always)]
    fn add(&self, filter: &Factors, shared: &[f32], factors: &mut [f32], sums: &mut [f32]) {
        let reach = filter.reach as isize;
        let (first, last) = (self.columns.first.max(-reach), self.columns.last.min(reach));
        let skipped = (first - self.columns.first) as usize * TILE.0;
        let count = (last - first + 1) as usize;
        let factors = &mut factors[..count];
        for (dx, factor) in (first..=last).zip(&mut *factors) {
            *factor = (filter.table[self.dy.unsigned_abs()] * filter.table[dx.unsigned_abs()]) as f32;
        }
        let (planes, weights) = sums.split_at_mut(self.layout.averaged * TILE.0);
        let line = Line { rows: self, shared: &shared[skipped..], factors, first };
        let mut k = 0;
        while k + 3 <= self.layout.averaged {
            line.sums::<3>(k, planes);
            k += 3;
        }
        match self.layout.averaged - k {
            2 => line.sums::<2>(k, planes),
            1 => line.sums::<1>(k, planes),
            _ => {}
        }
        line.weights(weights);
    }
}

/// Rows of a guide: values, then scaled variances.
#[derive(Clone, Copy, Default)]
struct Guided<'a> {
    own: [&'a [f32]; 2],
    /// From the first neighbour of the first pixel to the last of the last.
    other: [&'a [f32]; 2],
    /// Scaled as variances are.
    floor: f32,
}

impl<'a> Guided<'a> {
    /// Pixels and their neighbours at the offset number `o`.
    #[inline(always)]
    fn at(&self, o: usize, n: usize) -> [&'a [f32]; 4] {
        let ([p, vp], [q, vq]) = (self.own, self.other);
        [&p[..n], &q[o..][..n], &vp[..n], &vq[o..][..n]]
    }
}

/// Numerator and denominator of a guide's part of D.
#[inline(always)]
fn fraction(difference: f32, variance: f32, floor: f32) -> (f32, f32) {
    (difference * difference, if variance > floor { variance } else { floor })
}

/// Adds a guide's part of D.
#[inline(always)]
fn add_one(guide: &Guided<'_>, o: usize, to: &mut [f32]) {
    let [p, q, vp, vq] = guide.at(o, to.len());
    for x in 0..to.len() {
        let (above, below) = fraction(p[x] - q[x], vp[x] + vq[x], guide.floor);
        to[x] += above / below;
    }
}

/// Adds the parts of two guides as one fraction: a division costs more than the products.
#[inline(always)]
fn add_two(first: &Guided<'_>, second: &Guided<'_>, o: usize, to: &mut [f32]) {
    let [p, q, vp, vq] = first.at(o, to.len());
    let [r, s, vr, vs] = second.at(o, to.len());
    for x in 0..to.len() {
        let (a, b) = fraction(p[x] - q[x], vp[x] + vq[x], first.floor);
        let (c, d) = fraction(r[x] - s[x], vr[x] + vs[x], second.floor);
        to[x] += a.mul_add(d, c * b) / (b * d);
    }
}

/// The offsets of one filter in one row of neighbours.
struct Line<'a> {
    rows: &'a Rows<'a>,
    /// e^−D from the first of them on.
    shared: &'a [f32],
    /// Spatial factors of all of them.
    factors: &'a [f32],
    first: isize,
}

impl Line<'_> {
    /// Adds Σ w·x of the planes from `k` on.
    #[inline(always)]
    fn sums<const N: usize>(&self, k: usize, planes: &mut [f32]) {
        for x in (0..self.rows.columns.width).step_by(LANES) {
            let mut from = [&[][..]; N];
            for (i, from) in from.iter_mut().enumerate() {
                let (_, there) = self.rows.places(2 * self.rows.layout.guides + k + i);
                let there = (there + x).wrapping_add_signed(self.first);
                *from = &self.rows.area[there..][..self.factors.len() + LANES - 1];
            }
            let mut sums = [[0.0f32; LANES]; N];
            for (o, factor) in self.factors.iter().enumerate() {
                let w = self.weight(o, x, *factor);
                for i in 0..N {
                    let value = lanes(from[i], o);
                    for l in 0..LANES {
                        sums[i][l] = w[l].mul_add(value[l], sums[i][l]);
                    }
                }
            }
            for (i, sum) in sums.iter().enumerate() {
                add_to(&mut planes[(k + i) * TILE.0 + x..][..LANES], sum);
            }
        }
    }

    /// Adds Σ w.
    #[inline(always)]
    fn weights(&self, to: &mut [f32]) {
        for x in (0..self.rows.columns.width).step_by(LANES) {
            let mut sum = [0.0f32; LANES];
            for (o, factor) in self.factors.iter().enumerate() {
                let w = self.weight(o, x, *factor);
                for l in 0..LANES {
                    sum[l] += w[l];
                }
            }
            add_to(&mut to[x..][..LANES], &sum);
        }
    }

    /// w of one offset, 0 below the range of normal numbers.
    #[inline(always)]
    fn weight(&self, o: usize, x: usize, factor: f32) -> Lanes {
        let mut w = lanes(self.shared, o * TILE.0 + x);
        for l in 0..LANES {
            let product = w[l] * factor;
            w[l] = if product >= f32::MIN_POSITIVE { product } else { 0.0 };
        }
        w
    }
}

#[inline(always)]
fn add_to(to: &mut [f32], sum: &Lanes) {
    for (to, sum) in to.iter_mut().zip(sum) {
        *to += sum;
    }
}

/// Divides the sums of a row and writes them.
#[inline(always)]
fn finish(layout: &Layout, sums: &[f32], out: &mut [TileRows<'_>], row: usize) {
    let filters = out.chunks_exact_mut(layout.averaged + 1).zip(sums.chunks_exact(layout.filter));
    for (out, sums) in filters {
        let (planes, weights) = sums.split_at(layout.averaged * TILE.0);
        for (k, out) in out.iter_mut().enumerate() {
            let to = &mut *out[row];
            if k == layout.averaged {
                to.copy_from_slice(&weights[..to.len()]);
                continue;
            }
            for ((to, sum), weight) in to.iter_mut().zip(&planes[k * TILE.0..]).zip(weights) {
                // The pixel's own weight is 1.
                *to = sum / weight;
            }
        }
    }
}

/// Values from `at` on. Copies, which share no memory with what is written, become vectors.
#[inline(always)]
fn lanes(values: &[f32], at: usize) -> Lanes {
    let mut out = [0.0; LANES];
    out.copy_from_slice(&values[at..][..LANES]);
    out
}
