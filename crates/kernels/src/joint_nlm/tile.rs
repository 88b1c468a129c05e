//! The filter in one tile.

use super::distance::squared;
use super::{JointChannel, JointParams};
use crate::engine::{Tile, TileRows, Vectorised, Window, mirror};
use crate::nlm::maps::exponential::exponential;

/// Sizes of working copies.
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
            map_columns: tile.0 + 2 * f,
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
}

impl Work {
    pub fn new(layout: &Layout) -> Self {
        let planes = |size: usize| vec![vec![0.0; size]; layout.channels];
        let (copy, tile) = (layout.columns * layout.rows, layout.tile.0 * layout.tile.1);
        Self {
            values: planes(copy),
            variances: planes(copy),
            weights: planes(tile),
            sums: planes(tile),
            map: vec![0.0; layout.map_columns * layout.map_rows],
            joint: vec![0.0; tile],
            line: vec![0.0; layout.map_columns],
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
        let Self { layout, work, tile, out, .. } = self;
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
        let _ = tile;
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
        let (f, n) = (params.patch_radius, tile.width);
        let start = |x: usize, y: usize| (y + layout.around) * layout.columns + x + layout.around;
        let there = |at: usize| at.wrapping_add_signed(dy * layout.columns as isize + dx);

        // Distance and features: the same for all channels.
        let spatial = (dx * dx + dy * dy) as f32 / (2.0 * params.spatial_sigma * params.spatial_sigma);
        for y in rows.clone() {
            let joint = &mut work.joint[y * layout.tile.0..][..n];
            joint.fill(spatial);
            for (values, channel) in work.values.iter().zip(channels.iter()) {
                let factor = 0.5 / (channel.sigma * channel.sigma);
                let here = &values[start(0, y)..][..n];
                let there = &values[there(start(0, y))..][..n];
                for ((joint, a), b) in joint.iter_mut().zip(here).zip(there) {
                    let d = a - b;
                    *joint += d * d * factor;
                }
            }
        }
        let over = params.k * params.k;
        let taps = (2 * f + 1) as f32;
        let scale = 1.0 / (taps * taps * 2.0 * params.range_sigma * params.range_sigma);
        let wide = n + 2 * f;
        for c in 0..channels.len() {
            let (values, variances) = (&work.values[c], &work.variances[c]);
            // Eq. 5 at the tile and the patches around its pixels.
            for j in rows.start..rows.end + 2 * f {
                let here = start(0, j) - f * layout.columns - f;
                let (at, other) = (here..here + wide, there(here)..there(here) + wide);
                let map = &mut work.map[j * layout.map_columns..][..wide];
                let a = values[at.clone()].iter().zip(&variances[at]);
                let b = values[other.clone()].iter().zip(&variances[other]);
                for ((map, (a, va)), (b, vb)) in map.iter_mut().zip(a).zip(b) {
                    *map = squared((*a, *va), (*b, *vb), over);
                }
            }
            for y in rows.clone() {
                // Eq. 4: down, then across.
                let line = &mut work.line[..wide];
                line.copy_from_slice(&work.map[y * layout.map_columns..][..wide]);
                for j in 1..=2 * f {
                    let row = &work.map[(y + j) * layout.map_columns..][..wide];
                    for (sum, d) in line.iter_mut().zip(row) {
                        *sum += d;
                    }
                }
                let (from, to) = (columns.start, columns.end);
                let span = from..to;
                let width = layout.tile.0;
                let here = &values[start(0, y)..][span.clone()];
                let there = &values[there(start(0, y))..][span.clone()];
                let joint = &work.joint[y * width..][span.clone()];
                let weights = &mut work.weights[c][y * width..][span.clone()];
                let sums = &mut work.sums[c][y * width..][span];
                let line = &work.line[from..];
                let rest = weights.iter_mut().zip(sums).zip(here).zip(there).zip(joint);
                match f {
                    3 => add(rest, across::<7>(line, to - from), scale),
                    2 => add(rest, across::<5>(line, to - from), scale),
                    1 => add(rest, across::<3>(line, to - from), scale),
                    _ => add(rest, across::<1>(line, to - from), scale),
                }
            }
        }
    }
}

/// Sums of `N` values in a row.
#[inline(always)]
fn across<const N: usize>(line: &[f32], count: usize) -> impl Iterator<Item = f32> + '_ {
    line[..count + N - 1].windows(N).map(|taps| {
        let mut sum = taps[0];
        for tap in &taps[1..] {
            sum += tap;
        }
        sum
    })
}

type Rest<'a> = ((((&'a mut f32, &'a mut f32), &'a f32), &'a f32), &'a f32);

/// Eq. 3, and its share of both sums.
#[inline(always)]
fn add<'a>(rest: impl Iterator<Item = Rest<'a>>, sums: impl Iterator<Item = f32>, scale: f32) {
    for (((((weight, sum), here), there), joint), patch) in rest.zip(sums) {
        let distance = patch * scale;
        let distance = if distance > 0.0 { distance } else { 0.0 };
        let w = exponential(distance + joint);
        *weight += w;
        *sum += w * (there - here);
    }
}
