//! The filter in one tile.

use super::distance::squared;
use super::params::{JointChannel, JointParams};
use crate::engine::{Tile, TileRows, Vectorised, Window, mirror};
use crate::nlm::maps::exponential::exponential;

/// Pixels that are worked on together.
const LANES: usize = 8;
type Lanes = [f32; LANES];

/// Sizes of working copies. Rows are read in whole lanes, beyond what counts.
pub(super) struct Layout {
    /// Pixels around a tile that are copied.
    around: usize,
    /// Columns and rows of the copies.
    columns: usize,
    rows: usize,
    /// The same of maps of distances: a tile and the patch around it.
    map_columns: usize,
    map_rows: usize,
    tile: (usize, usize),
    channels: usize,
}

impl Layout {
    pub fn new(params: &JointParams, channels: usize, tile: (usize, usize)) -> Self {
        let (f, around) = (params.patch_radius, params.window_radius + params.patch_radius);
        Self {
            around,
            columns: tile.0 + 2 * around,
            rows: tile.1 + 2 * around,
            map_columns: (tile.0 + 2 * f).next_multiple_of(LANES) + LANES,
            map_rows: tile.1 + 2 * f,
            tile,
            channels,
        }
    }
}

/// A worker's memory.
pub(super) struct Work {
    /// Values and variances of each channel, mirrored beyond the image.
    values: Vec<Vec<f32>>,
    variances: Vec<Vec<f32>>,
    /// Of each channel Σ w and Σ w·(f(j) − f(i)).
    weights: Vec<Vec<f32>>,
    sums: Vec<Vec<f32>>,
    /// d of one channel.
    map: Vec<f32>,
    /// Exponents from distance and features.
    joint: Vec<f32>,
    line: Vec<f32>,
    /// 1 for pixels whose neighbour lies in the image, 0 for others.
    inside: Vec<f32>,
}

impl Work {
    pub fn new(layout: &Layout) -> Self {
        let planes = |size: usize| vec![vec![0.0; size]; layout.channels];
        let (copy, tile) = (layout.columns * layout.rows + 2 * LANES, layout.tile.0 * layout.tile.1);
        Self {
            values: planes(copy),
            variances: planes(copy),
            weights: planes(tile),
            sums: planes(tile),
            map: vec![0.0; layout.map_columns * layout.map_rows],
            joint: vec![0.0; tile],
            line: vec![0.0; layout.map_columns],
            inside: vec![0.0; layout.tile.0],
        }
    }
}

pub(super) struct Filter<'a, 'b> {
    pub params: &'a JointParams,
    pub channels: &'a [JointChannel<'a>],
    pub layout: &'a Layout,
    pub work: &'a mut Work,
    pub tile: Tile,
    pub out: Vec<TileRows<'b>>,
}

impl Vectorised for Filter<'_, '_> {
    type Out = ();

    #[inline(always)]
    fn run(mut self) {
        self.copy();
        let window =
            Window { width: self.params.width, height: self.params.height, reach: self.params.window_radius };
        for block in window.blocks(self.tile, 1) {
            let (x, dx) = (self.tile.x as isize, block.dx);
            let right = (self.params.width as isize - dx - x).min(self.tile.width as isize);
            let columns = (-dx - x).max(0) as usize..right.max(0) as usize;
            if !columns.is_empty() {
                self.offset((block.dx, block.dy), block.rows, columns);
            }
        }
        let Self { layout, work, out, .. } = self;
        for (c, out) in out.into_iter().enumerate() {
            for (y, row) in out.into_iter().enumerate() {
                for (x, value) in row.iter_mut().enumerate() {
                    let p = y * layout.tile.0 + x;
                    let own = work.values[c][(y + layout.around) * layout.columns + x + layout.around];
                    // The pixel's own weight is 1.
                    *value = own + work.sums[c][p] / work.weights[c][p];
                }
            }
        }
    }
}

impl Filter<'_, '_> {
    /// Copies what the tile's windows and patches see.
    #[inline(always)]
    fn copy(&mut self) {
        let Self { params, channels, layout, work, tile, .. } = self;
        let at = |i: usize, first: usize, n: usize| mirror((first + i) as isize - layout.around as isize, n);
        for (c, channel) in channels.iter().enumerate() {
            for j in 0..tile.height + 2 * layout.around {
                let row = at(j, tile.y, params.height) * params.width;
                for i in 0..tile.width + 2 * layout.around {
                    let p = row + at(i, tile.x, params.width);
                    work.values[c][j * layout.columns + i] = channel.value[p];
                    work.variances[c][j * layout.columns + i] = channel.variance[p];
                }
            }
            work.weights[c].fill(0.0);
            work.sums[c].fill(0.0);
        }
    }

    /// Adds the neighbours at one offset, of the pixels of these rows and columns, whose neighbours lie in the image.
    #[inline(always)]
    fn offset(
        &mut self,
        (dx, dy): (isize, isize),
        rows: std::ops::Range<usize>,
        columns: std::ops::Range<usize>,
    ) {
        let Self { params, channels, layout, work, tile, .. } = self;
        let f = params.patch_radius;
        let start = |x: usize, y: usize| (y + layout.around) * layout.columns + x + layout.around;
        let there = |at: usize| at.wrapping_add_signed(dy * layout.columns as isize + dx);
        // Tiles are whole lanes wide; what lies beyond the image is not read.
        let n = tile.width.next_multiple_of(LANES);
        for (x, inside) in work.inside.iter_mut().enumerate() {
            *inside = f32::from(columns.contains(&x));
        }

        // Distance and features: the same for all channels.
        let spatial = (dx * dx + dy * dy) as f32 / (2.0 * params.spatial_sigma * params.spatial_sigma);
        for y in rows.clone() {
            for x in (0..n).step_by(LANES) {
                let mut joint = [spatial; LANES];
                for (values, channel) in work.values.iter().zip(channels.iter()) {
                    let factor = 0.5 / (channel.sigma * channel.sigma);
                    let (a, b) = (lanes(values, start(x, y)), lanes(values, there(start(x, y))));
                    for l in 0..LANES {
                        let d = a[l] - b[l];
                        joint[l] += d * d * factor;
                    }
                }
                work.joint[y * layout.tile.0 + x..][..LANES].copy_from_slice(&joint);
            }
        }
        let Self { params, layout, work, tile, .. } = self;
        let sweep = Sweep { params, layout, columns: tile.width, away: dy * layout.columns as isize + dx };
        for c in 0..layout.channels {
            match f {
                3 => sweep.channel::<7>(work, c, rows.clone()),
                2 => sweep.channel::<5>(work, c, rows.clone()),
                1 => sweep.channel::<3>(work, c, rows.clone()),
                _ => sweep.channel::<1>(work, c, rows.clone()),
            }
        }
    }
}

/// One offset.
struct Sweep<'a> {
    params: &'a JointParams,
    layout: &'a Layout,
    columns: usize,
    /// From a pixel of a working copy to its neighbour.
    away: isize,
}

impl Sweep<'_> {
    /// Adds the neighbours in one channel, with patches of `TAPS` rows.
    #[inline(always)]
    fn channel<const TAPS: usize>(&self, work: &mut Work, c: usize, rows: std::ops::Range<usize>) {
        let Self { params, layout, columns, away } = *self;
        let over = params.k * params.k;
        let scale = 1.0 / ((TAPS * TAPS) as f32 * 2.0 * params.range_sigma * params.range_sigma);
        // Tiles are whole lanes wide; what lies beyond the image is not read.
        let n = columns.next_multiple_of(LANES);
        let wide = (n + TAPS - 1).next_multiple_of(LANES);
        let start = |y: usize| (y + layout.around) * layout.columns + layout.around;
        let (values, variances) = (&work.values[c], &work.variances[c]);
        // Eq. 5 at the tile and the patches around its pixels.
        for j in rows.start..rows.end + TAPS - 1 {
            let p = start(j) - (TAPS / 2) * layout.columns - TAPS / 2;
            let q = p.wrapping_add_signed(away);
            let (a, va) = (row(values, p, wide), row(variances, p, wide));
            let (b, vb) = (row(values, q, wide), row(variances, q, wide));
            let map = work.map[j * layout.map_columns..][..wide].as_chunks_mut().0;
            for ((((map, a), va), b), vb) in map.iter_mut().zip(a).zip(va).zip(b).zip(vb) {
                let mut d = [0.0; LANES];
                for l in 0..LANES {
                    d[l] = squared((a[l], va[l]), (b[l], vb[l]), over);
                }
                *map = d;
            }
        }
        for y in rows {
            // Eq. 4: down, then across.
            let line = &mut work.line[..wide];
            line.copy_from_slice(&work.map[y * layout.map_columns..][..wide]);
            for pair in 0..TAPS / 2 {
                let [a, b] = [1, 2].map(|tap| &work.map[(y + 2 * pair + tap) * layout.map_columns..][..wide]);
                for ((sum, a), b) in line.iter_mut().zip(a).zip(b) {
                    *sum = *sum + a + b;
                }
            }
            let p = row(values, start(y), n);
            let q = row(values, start(y).wrapping_add_signed(away), n);
            let at = y * layout.tile.0;
            let (joint, inside) = (row(&work.joint, at, n), row(&work.inside, 0, n));
            let weights = work.weights[c][at..][..n].as_chunks_mut::<LANES>().0;
            let sums = work.sums[c][at..][..n].as_chunks_mut::<LANES>().0;
            let line = &work.line[..wide + LANES];
            let both = weights.iter_mut().zip(sums);
            for (g, ((((w, s), (p, q)), joint), inside)) in
                both.zip(p.iter().zip(q)).zip(joint).zip(inside).enumerate()
            {
                let taps = &line[g * LANES..][..LANES + TAPS - 1];
                let mut sum = [0.0; LANES];
                for tap in 0..TAPS {
                    for l in 0..LANES {
                        sum[l] += taps[tap + l];
                    }
                }
                // Eq. 3, and its share of both sums. Copies, which share no memory, become vectors.
                let (mut weights, mut sums, mut added) = (*w, *s, [0.0; LANES]);
                for l in 0..LANES {
                    let distance = sum[l] * scale;
                    let distance = if distance > 0.0 { distance } else { 0.0 };
                    added[l] = exponential(distance + joint[l]) * inside[l];
                }
                for l in 0..LANES {
                    weights[l] += added[l];
                    sums[l] += added[l] * (q[l] - p[l]);
                }
                (*w, *s) = (weights, sums);
            }
        }
    }
}

/// `n` values from `at` on, in lanes.
#[inline(always)]
fn row(values: &[f32], at: usize, n: usize) -> &[Lanes] {
    values[at..][..n].as_chunks().0
}

/// Values from `at` on. Copies, which share no memory with what is written, become vectors.
#[inline(always)]
fn lanes(values: &[f32], at: usize) -> Lanes {
    let mut out = [0.0; LANES];
    out.copy_from_slice(&values[at..][..LANES]);
    out
}
