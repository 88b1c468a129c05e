//! The inner loops, generic over the instruction set.
//!
//! For one block of horizontal offsets: [`patch_columns`] makes the vertical part of the patch distances, and
//! [`accumulate`] the horizontal part, the weights and the running sums. Every function is inlined whole into
//! the wrapper of its instruction set; there are no calls inside.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use std::ops::Range;

use super::layout::{BLOCK, Layout};
use super::params::MAX_PATCH_RADIUS;
use crate::simd::Simd;

/// All channels share one set; each channel has a test.
pub(super) const JOINT: usize = 0;
/// Each channel has a set and a weight sum of its own.
pub(super) const SEPARATE: usize = 1;
/// All channels share one set with a single test, on a value plane of its own.
pub(super) const SINGLE: usize = 2;

/// Views of one tile's working copies, see [`Layout`].
pub(super) struct TileView<'a> {
    pub layout: &'a Layout,
    /// Valid pixels of the tile, from its first.
    pub width: usize,
    /// Three planes of source values, and for [`SINGLE`] a fourth with the tested values.
    pub source: &'a [f32],
    /// Three guide planes; empty without a guide.
    pub guide: &'a [f32],
    /// Half-widths of the tests: one plane for [`SINGLE`], else three.
    pub half_width: &'a [f32],
    /// Each pixel's factor from patch sums to an exponent of 2, on the source's grid, finite and at most 0; the lower
    /// of a pair's two counts. Empty without a guide.
    pub factor: &'a [f32],
    /// Three planes that are summed along, on the source's grid; empty if there are none.
    pub carried: &'a [f32],
    /// Whether carried planes are summed with squared weights.
    pub squared: bool,
    /// Accumulators: three sums of weighted differences, then three weight sums for [`SEPARATE`], else one, and from
    /// the seventh on three sums of carried planes.
    pub sums: &'a mut [f32],
    /// Vertical patch sums.
    pub columns: &'a mut [f32],
    /// Patch weights relative to the middle one: g(i)/g(0).
    pub taps: [f32; MAX_PATCH_RADIUS + 1],
}

/// One row of neighbours: up to [`BLOCK`] horizontal offsets dx, dx+1, … at vertical offset dy.
pub(super) struct Block {
    /// Tile rows whose neighbours lie inside the image.
    pub rows: Range<usize>,
    pub dy: isize,
    pub dx: isize,
    /// Number of offsets.
    pub count: usize,
    /// For each offset, with a guide: the spatial weight's exponent of 2. Without: the weight itself.
    pub spatial: [f32; BLOCK],
}

/// Reads a vector at `index` of `plane`.
///
/// # Safety
/// The instruction set is available and `index + LANES` values exist.
#[inline(always)]
unsafe fn at<S: Simd>(plane: &[f32], index: usize) -> S::F {
    debug_assert!(index + S::LANES <= plane.len(), "reads {index} of {}", plane.len());
    // SAFETY: as the caller vouches.
    unsafe { S::load(plane.as_ptr().add(index)) }
}

/// Writes a vector at `index` of `plane`.
///
/// # Safety
/// As [`at`].
#[inline(always)]
unsafe fn put<S: Simd>(plane: &mut [f32], index: usize, value: S::F) {
    debug_assert!(index + S::LANES <= plane.len(), "writes {index} of {}", plane.len());
    // SAFETY: as the caller vouches.
    unsafe { S::store(plane.as_mut_ptr().add(index), value) }
}

/// One pass over the tile: everything for one block of offsets.
///
/// # Safety
/// The instruction set is available. `tile` has the sizes that its layout says, `tile.width` is at most the
/// layout's tile width, and the offsets are within the layout's reach.
#[inline(always)]
pub(super) unsafe fn pass<S: Simd>(tile: &mut TileView<'_>, block: &Block, rule: usize) {
    // SAFETY: passed on unchanged.
    unsafe {
        if tile.guide.is_empty() {
            return ruled::<S, 0, false>(tile, block, rule);
        }
        match tile.layout.patch {
            0 => guided::<S, 0>(tile, block, rule),
            1 => guided::<S, 1>(tile, block, rule),
            2 => guided::<S, 2>(tile, block, rule),
            _ => guided::<S, 3>(tile, block, rule),
        }
    }
}

/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn guided<S: Simd, const PATCH: usize>(tile: &mut TileView<'_>, block: &Block, rule: usize) {
    // SAFETY: passed on unchanged.
    unsafe {
        let mut first = 0;
        while first + 2 <= block.count {
            patch_columns::<S, PATCH, 2>(tile, block, first);
            first += 2;
        }
        if first < block.count {
            patch_columns::<S, PATCH, 1>(tile, block, first);
        }
        ruled::<S, PATCH, true>(tile, block, rule);
    }
}

/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn ruled<S: Simd, const PATCH: usize, const GUIDED: bool>(
    tile: &mut TileView<'_>,
    block: &Block,
    rule: usize,
) {
    // SAFETY: passed on unchanged.
    unsafe {
        match rule {
            JOINT => accumulate::<S, PATCH, JOINT, GUIDED>(tile, block),
            SEPARATE => accumulate::<S, PATCH, SEPARATE, GUIDED>(tile, block),
            _ => accumulate::<S, PATCH, SINGLE, GUIDED>(tile, block),
        }
    }
}

/// Squared guide differences Σ_c (F_c(p) − F_c(p + offset))² (moon2013flash, Sec. 3.2) for `N` neighbouring offsets.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn squares<S: Simd, const N: usize>(
    guide: &[f32],
    plane: usize,
    here: usize,
    there: usize,
) -> [S::F; N] {
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        let mut out = [S::splat(0.0); N];
        for c in 0..3 {
            let p = at::<S>(guide, c * plane + here);
            for (o, square) in out.iter_mut().enumerate() {
                let d = S::sub(p, at::<S>(guide, c * plane + there + o));
                *square = if c == 0 { S::mul(d, d) } else { S::fma(d, d, *square) };
            }
        }
        out
    }
}

/// Vertical patch sums of offsets `first..first + N` of the block, on the tile and `PATCH` columns on both sides.
///
/// Walks down columns of vectors, the last 2·`PATCH` rows of squared differences in registers.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn patch_columns<S: Simd, const PATCH: usize, const N: usize>(
    tile: &mut TileView<'_>,
    block: &Block,
    first: usize,
) {
    // Copies, so that stores to the planes cannot make the compiler read any of this again.
    let Layout { guide, columns, .. } = *tile.layout;
    let (planes, width, taps) = (tile.guide, tile.width, tile.taps);
    // Index of the patch area's first vector: `PATCH` rows above and columns left of the tile.
    let corner = guide.origin() + block.rows.start * guide.pitch - PATCH * guide.pitch - PATCH;
    let shift = block.dy * guide.pitch as isize + block.dx + first as isize;
    let mut x = 0;
    // SAFETY: the caller vouches for the instruction set; the guide copies reach `reach + patch` pixels beyond
    // the tile on every side, and the sums hold the tile and `patch` columns on both sides.
    unsafe {
        while x < width + 2 * PATCH {
            let mut window = [[S::splat(0.0); N]; 2 * MAX_PATCH_RADIUS + 1];
            let mut here = corner + x;
            for row in window.iter_mut().take(2 * PATCH) {
                *row = squares::<S, N>(planes, guide.plane, here, here.wrapping_add_signed(shift));
                here += guide.pitch;
            }
            let mut to = first * columns.plane + block.rows.start * columns.pitch + x;
            for _ in block.rows.clone() {
                window[2 * PATCH] =
                    squares::<S, N>(planes, guide.plane, here, here.wrapping_add_signed(shift));
                for o in 0..N {
                    let mut sum = window[PATCH][o];
                    for i in 1..=PATCH {
                        let pair = S::add(window[PATCH - i][o], window[PATCH + i][o]);
                        sum = S::fma(S::splat(taps[i]), pair, sum);
                    }
                    put::<S>(tile.columns, to + o * columns.plane, sum);
                }
                for i in 0..2 * PATCH {
                    window[i] = window[i + 1];
                }
                here += guide.pitch;
                to += columns.pitch;
            }
            x += S::LANES;
        }
    }
}

/// Horizontal patch sum at `from + PATCH`, from the vertical sums.
///
/// # Safety
/// As [`pass`], with 2·`LANES` values at `from`.
#[inline(always)]
unsafe fn patch_sum<S: Simd, const PATCH: usize>(columns: &[f32], from: usize, taps: &[f32]) -> S::F {
    debug_assert!(from + 2 * S::LANES <= columns.len());
    // SAFETY: as the caller vouches.
    unsafe {
        let from = columns.as_ptr().add(from);
        let mut sum = S::load_beside(from, PATCH);
        for i in 1..=PATCH {
            let pair = S::add(S::load_beside(from, PATCH - i), S::load_beside(from, PATCH + i));
            sum = S::fma(S::splat(taps[i]), pair, sum);
        }
        sum
    }
}

/// The weight where `member` holds, else 0: with a guide from the two factors that `exp2` gives.
///
/// # Safety
/// The instruction set is available.
#[inline(always)]
unsafe fn weigh<S: Simd, const GUIDED: bool>(member: S::M, weight: S::F, scale: S::F) -> S::F {
    // SAFETY: as the caller vouches.
    unsafe { if GUIDED { S::keep_scaled(member, weight, scale) } else { S::keep(member, weight) } }
}

/// Adds one offset to the sum of a carried plane.
///
/// The sum stays in memory: passes that carry nothing, the costly ones, keep their registers, and one form of
/// [`accumulate`] serves both.
///
/// # Safety
/// As [`pass`], with planes to carry; `here` is a pixel of the tile, `there` its neighbour on the source's grid.
#[inline(always)]
unsafe fn carry<S: Simd>(tile: &mut TileView<'_>, channel: usize, weight: S::F, here: usize, there: usize) {
    let Layout { source, pixel, .. } = *tile.layout;
    // SAFETY: as the caller vouches.
    unsafe {
        let value = at::<S>(tile.carried, channel * source.plane + there);
        let place = (6 + channel) * pixel.plane + here;
        let weight = if tile.squared { S::mul(weight, weight) } else { weight };
        put::<S>(tile.sums, place, S::fma(weight, value, at::<S>(tile.sums, place)));
    }
}

/// Adds the block's offsets to the running sums of every pixel of the tile: Eq. 1 over the set of Eq. 2.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn accumulate<S: Simd, const PATCH: usize, const RULE: usize, const GUIDED: bool>(
    tile: &mut TileView<'_>,
    block: &Block,
) {
    let Layout { source, pixel, columns, .. } = *tile.layout;
    let shift = block.dy * source.pitch as isize + block.dx;
    let (taps, count) = (tile.taps, block.count.min(BLOCK));
    let carries = !tile.carried.is_empty();
    // SAFETY: the caller vouches for the instruction set; the source copies reach `reach` pixels beyond the tile.
    unsafe {
        let lowest = S::splat(-126.0);
        for y in block.rows.clone() {
            let mut x = 0;
            while x < tile.width {
                let here = y * pixel.pitch + x;
                let center = source.origin() + y * source.pitch + x;
                let there = center.wrapping_add_signed(shift);
                let from = y * columns.pitch + x;
                let mut p = [S::splat(0.0); 4];
                let mut half_width = [S::splat(0.0); 3];
                for c in 0..3 {
                    p[c] = at::<S>(tile.source, c * source.plane + center);
                    if RULE != SINGLE {
                        half_width[c] = at::<S>(tile.half_width, c * pixel.plane + here);
                    }
                }
                if RULE == SINGLE {
                    p[3] = at::<S>(tile.source, 3 * source.plane + center);
                    half_width[0] = at::<S>(tile.half_width, here);
                }
                let factor = if GUIDED { at::<S>(tile.factor, center) } else { lowest };
                let mut sum = [S::splat(0.0); 3];
                let mut weights = [S::splat(0.0); 3];
                for c in 0..3 {
                    sum[c] = at::<S>(tile.sums, c * pixel.plane + here);
                    if c == 0 || RULE == SEPARATE {
                        weights[c] = at::<S>(tile.sums, (3 + c) * pixel.plane + here);
                    }
                }
                for o in 0..count {
                    let spatial = S::splat(block.spatial[o]);
                    let (mut exponent, mut weight, mut scale) = (lowest, spatial, lowest);
                    if GUIDED {
                        let patch = patch_sum::<S, PATCH>(tile.columns, from + o * columns.plane, &taps);
                        let factor = S::min(factor, at::<S>(tile.factor, there + o));
                        exponent = S::fma(patch, factor, spatial);
                        (weight, scale) = S::exp2(exponent);
                    }
                    // False for weights below the normal range and for the NaN of an overflowed distance.
                    let alike = S::le(lowest, exponent);
                    let mut d = [S::splat(0.0); 3];
                    for c in 0..3 {
                        d[c] = S::sub(at::<S>(tile.source, c * source.plane + there + o), p[c]);
                    }
                    if RULE == SEPARATE {
                        for c in 0..3 {
                            let member = S::and_le(alike, S::abs(d[c]), half_width[c]);
                            let w = weigh::<S, GUIDED>(member, weight, scale);
                            sum[c] = S::fma(w, d[c], sum[c]);
                            weights[c] = S::add(weights[c], w);
                            if carries {
                                carry::<S>(tile, c, w, here, there + o);
                            }
                        }
                        continue;
                    }
                    let mut member = alike;
                    if RULE == JOINT {
                        for c in 0..3 {
                            member = S::and_le(member, S::abs(d[c]), half_width[c]);
                        }
                    } else {
                        let tested = S::sub(at::<S>(tile.source, 3 * source.plane + there + o), p[3]);
                        member = S::and_le(member, S::abs(tested), half_width[0]);
                    }
                    let w = weigh::<S, GUIDED>(member, weight, scale);
                    for c in 0..3 {
                        sum[c] = S::fma(w, d[c], sum[c]);
                    }
                    weights[0] = S::add(weights[0], w);
                    if carries {
                        for c in 0..3 {
                            carry::<S>(tile, c, w, here, there + o);
                        }
                    }
                }
                for c in 0..3 {
                    put::<S>(tile.sums, c * pixel.plane + here, sum[c]);
                    if c == 0 || RULE == SEPARATE {
                        put::<S>(tile.sums, (3 + c) * pixel.plane + here, weights[c]);
                    }
                }
                x += S::LANES;
            }
        }
    }
}
