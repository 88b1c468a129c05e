//! Where models stand (Sec. 3.5).

use rayon::prelude::*;

use crate::features::Channel;
use crate::settings::MOST_BANDWIDTHS;
use crate::{Params, Tiling};

/// Distance of centres in [`Tiling::Dense`], pixels; ours.
const STEP: usize = 8;

/// A model's centre, and what is known of it so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Center {
    pub x: usize,
    pub y: usize,
    /// Window radius.
    pub radius: usize,
    /// Number of the bandwidth chosen last.
    pub k: usize,
    /// Of each bandwidth Σ_t g_t Σ_j w(i,j)·err_t(j) so far.
    pub errors: [f64; MOST_BANDWIDTHS],
    /// Steps that are in `errors`.
    pub steps: usize,
}

impl Center {
    pub fn new(x: usize, y: usize, radius: usize) -> Self {
        Self { x, y, radius, k: 0, errors: [0.0; MOST_BANDWIDTHS], steps: 0 }
    }
}

/// A square of the image, smaller at its right and lower border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tile {
    pub x: usize,
    pub y: usize,
    pub width: usize,
    pub height: usize,
    /// Whether the share of detail is above τ.
    pub detailed: bool,
}

/// Tiles of `side` pixels, row by row; `detail` tells of every pixel whether it is detail.
pub(crate) fn tiles((width, height): (usize, usize), side: usize, detail: &[bool], share: f64) -> Vec<Tile> {
    let mut out = Vec::new();
    for y in (0..height).step_by(side) {
        for x in (0..width).step_by(side) {
            let (w, h) = (side.min(width - x), side.min(height - y));
            let count: usize =
                (y..y + h).map(|j| detail[j * width + x..][..w].iter().filter(|d| **d).count()).sum();
            let detailed = count as f64 > share * (w * h) as f64;
            out.push(Tile { x, y, width: w, height: h, detailed });
        }
    }
    out
}

/// Eq. 14: the largest gradient of the prefiltered features, by Sobel's kernels over 8, above which a pixel is detail.
pub(crate) fn detail(channels: &[Channel], (width, height): (usize, usize), edge: f64) -> Vec<bool> {
    let mut out = vec![false; width * height];
    let square = edge * edge;
    out.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        // The border is repeated.
        let rows = [y.saturating_sub(1), y, (y + 1).min(height - 1)];
        for (x, detail) in row.iter_mut().enumerate() {
            let columns = [x.saturating_sub(1), x, (x + 1).min(width - 1)];
            *detail = channels.iter().any(|channel| {
                let at = |i: usize, j: usize| f64::from(channel.value[rows[j] * width + columns[i]]);
                let across = (at(2, 0) - at(0, 0)) + 2.0 * (at(2, 1) - at(0, 1)) + (at(2, 2) - at(0, 2));
                let down = (at(0, 2) - at(0, 0)) + 2.0 * (at(1, 2) - at(1, 0)) + (at(2, 2) - at(2, 0));
                (across * across + down * down) / 64.0 > square
            });
        }
    });
    out
}

/// Centres that a tile begins with.
pub(crate) fn first(tile: &Tile, params: &Params) -> Vec<Center> {
    let (small, large) = (params.small_radius_px, params.large_radius_px);
    let one = |size| [size / 2];
    match params.tiling {
        Tiling::Dense => {
            grid(tile, &every(tile.width, STEP), &every(tile.height, STEP), params.growth_radius_px)
        }
        Tiling::Literal if tile.detailed => grid(tile, &one(tile.width), &one(tile.height), small),
        Tiling::ThreeByThree | Tiling::AllDetail if tile.detailed || params.tiling == Tiling::AllDetail => {
            let side = 2 * small + 1;
            grid(tile, &every(tile.width, side), &every(tile.height, side), small)
        }
        _ => grid(tile, &one(tile.width), &one(tile.height), large),
    }
}

/// Middles of as many equal parts of a line as it takes for parts of `most` pixels at most.
fn every(size: usize, most: usize) -> Vec<usize> {
    let count = size.div_ceil(most);
    (0..count).map(|i| (2 * i + 1) * size / (2 * count)).collect()
}

fn grid(tile: &Tile, columns: &[usize], rows: &[usize], radius: usize) -> Vec<Center> {
    rows.iter()
        .flat_map(|y| columns.iter().map(move |x| Center::new(tile.x + x, tile.y + y, radius)))
        .collect()
}
