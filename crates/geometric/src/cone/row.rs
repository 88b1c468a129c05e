//! A row of the windows of some neighbouring pixels: what it holds is copied once and added, weighted, to each pixel's sums
//! per column (Listing, lines 5-13, mended). Sizes are ours, for speed.
//!
//! The copy keeps what eight pixels read in the nearest cache, and shows the compiler that sums and values are not the same
//! memory. The loops have no branch and no sum across columns, so that the compiler makes vectors of them. What must not count has
//! weight 0: other surfaces, what lies outside the disc, and the padding around each image row.

use super::alike::{Own, Thresholds};
use crate::LARGEST_RADIUS_PX;

/// Columns are taken in whole groups of this many.
pub(super) const LANES: usize = 8;
/// Most columns of a window.
const MOST: usize = (2 * LARGEST_RADIUS_PX as usize + 1).next_multiple_of(LANES);

/// What of a neighbour is read: id, depth, normal, colour.
pub(super) const PLANES: usize = 8;

/// Neighbouring pixels that are filtered together.
pub(super) const TOGETHER: usize = 16;
/// Most values of a row that they read.
const LONGEST: usize = MOST + TOGETHER;

/// Sums per column of the window: of the weights, and of the weighted colour.
pub(super) struct Columns([[f32; MOST]; 4]);

impl Default for Columns {
    fn default() -> Self {
        Self([[0.0; MOST]; 4])
    }
}

impl Columns {
    /// Makes all sums of a window of this reach zero.
    #[inline(always)]
    pub fn clear(&mut self, reach: usize) {
        self.0.iter_mut().for_each(|column| column[..count(reach)].fill(0.0));
    }

    /// `count` of them from a column on.
    #[inline(always)]
    fn from(&mut self, first: usize, count: usize) -> [&mut [f32]; 4] {
        let [w, r, g, b] = &mut self.0;
        [
            &mut w[first..][..count],
            &mut r[first..][..count],
            &mut g[first..][..count],
            &mut b[first..][..count],
        ]
    }

    /// Sums over the columns of a window of this reach.
    #[inline(always)]
    pub fn totals(&self, reach: usize) -> [f64; 4] {
        let total = |column: &[f32; MOST]| {
            let mut lanes = [0.0; LANES];
            for group in column[..count(reach)].as_chunks::<LANES>().0 {
                lanes.iter_mut().zip(group).for_each(|(lane, value)| *lane += f64::from(*value));
            }
            lanes.iter().sum::<f64>()
        };
        [total(&self.0[0]), total(&self.0[1]), total(&self.0[2]), total(&self.0[3])]
    }
}

/// Columns of a window row that reaches so far to both sides, in whole groups.
#[inline(always)]
pub(super) fn count(reach: usize) -> usize {
    (2 * reach + 1).next_multiple_of(LANES)
}

/// Columns at the left of a window row that lie outside the disc, in whole groups.
#[inline(always)]
pub(super) fn outside(reach: usize, dy: usize, radius: f32) -> usize {
    let mut skipped = 0;
    while reach >= skipped + LANES {
        let nearest = reach - skipped - (LANES - 1);
        if ((nearest * nearest + dy * dy) as f32) < radius * radius {
            break;
        }
        skipped += LANES;
    }
    skipped
}

/// A row of the windows of [`TOGETHER`] pixels.
pub(super) struct Strip {
    planes: [[f32; LONGEST]; PLANES],
    tints: [[f32; LONGEST]; 3],
}

impl Default for Strip {
    fn default() -> Self {
        Self { planes: [[0.0; LONGEST]; PLANES], tints: [[0.0; LONGEST]; 3] }
    }
}

impl Strip {
    /// Copies what windows of this reach read, from an index of the planes on.
    #[inline(always)]
    pub fn load(&mut self, planes: &[Vec<f32>; PLANES], start: usize, reach: usize) {
        copy(&mut self.planes, planes, start, count(reach) + TOGETHER);
    }

    /// The same of the albedo.
    #[inline(always)]
    pub fn load_tints(&mut self, planes: &[Vec<f32>; 3], start: usize, reach: usize) {
        copy(&mut self.tints, planes, start, count(reach) + TOGETHER);
    }

    /// Adds the neighbours from `from` on, at these distances, to the columns from `first` on.
    #[inline(always)]
    pub fn add<const ALBEDO: bool>(
        &self,
        from: usize,
        own: &Own,
        most: &Thresholds,
        distances: &[f32],
        columns: &mut Columns,
        first: usize,
    ) {
        let (own, most, n) = (*own, *most, distances.len());
        let plane = |plane: usize| &self.planes[plane][from..][..n];
        let (id, depth, nx, ny, nz) = (plane(0), plane(1), plane(2), plane(3), plane(4));
        let (red, green, blue) = (plane(5), plane(6), plane(7));
        let tint = |channel: usize| &self.tints[channel][from..][..n];
        let (tint_r, tint_g, tint_b) = (tint(0), tint(1), tint(2));
        let [w, r, g, b] = columns.from(first, n);
        for i in 0..n {
            let mut weight = own.weight(&most, id[i], depth[i], [nx[i], ny[i], nz[i]], distances[i]);
            if ALBEDO {
                let like = own.is_tinted_like(&most, [tint_r[i], tint_g[i], tint_b[i]]);
                weight = if like { weight } else { 0.0 };
            }
            // Listing, line 12 and line 13.
            w[i] += weight;
            r[i] += weight * red[i];
            g[i] += weight * green[i];
            b[i] += weight * blue[i];
        }
    }
}

/// Copies `length` values, a multiple of [`LANES`], of each plane. Group by group: so short, whole planes would spend more
/// time on calls than on copying.
#[inline(always)]
fn copy<const N: usize>(to: &mut [[f32; LONGEST]; N], from: &[Vec<f32>; N], start: usize, length: usize) {
    for at in (0..length).step_by(LANES) {
        for (to, from) in to.iter_mut().zip(from) {
            to[at..][..LANES].copy_from_slice(&from[start + at..][..LANES]);
        }
    }
}
