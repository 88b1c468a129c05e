//! The inner loops, generic over the instruction set.
//!
//! For one block of horizontal offsets: [`patch_columns`] makes the vertical part of the patch distances, and
//! [`accumulate`] the rest: feature distances, weights, running sums. Every function is inlined whole into the
//! wrapper of its instruction set; there are no calls inside.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use std::ops::Range;

use super::layout::{
    KINDS, LARGEST, Layout, MAX_BLOCK, MOVED_LARGEST, MOVED_STEP, MOVED_WEIGHT, STEP, WEIGHT,
};
use super::params::MAX_PATCH_RADIUS;
use crate::simd::{MAX_LANES, Simd};

/// Exponent that makes a weight zero.
pub(super) const PENALTY: f32 = -1e9;

/// `PATCH` of a pass without a patch.
const NO_PATCH: usize = MAX_PATCH_RADIUS + 1;

/// One pass as the inner loops see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct HotPass {
    /// Patch radius, or [`NO_PATCH`].
    patch: usize,
    /// Which of the layout's patch radii.
    columns: usize,
    /// Which of the two τ.
    floor: usize,
    /// Factor from patch sums to an exponent of 2.
    scale: f32,
    /// Whether the derivative is wanted.
    derivative: bool,
}

impl HotPass {
    pub fn new(patch: Option<usize>, columns: usize, floor: usize, scale: f32, derivative: bool) -> Self {
        Self { patch: patch.unwrap_or(NO_PATCH), columns, floor, scale, derivative }
    }

    /// Whether the pass gives a derivative.
    pub fn gives_derivative(&self) -> bool {
        self.derivative
    }

    /// Whether that is a finite difference: without a patch the weights do not depend on the guide.
    pub fn finite_difference(&self) -> bool {
        self.derivative && self.patch != NO_PATCH
    }
}

/// Views of one tile's working copies, see [`Layout`].
pub(super) struct TileView<'a> {
    pub layout: &'a Layout,
    pub passes: &'a [HotPass],
    /// Valid pixels of the tile, from its first.
    pub width: usize,
    /// Guide of the frame to filter, and its variances scaled by k².
    pub here: &'a [f32],
    /// Guide of the frame that is searched.
    pub there: &'a [f32],
    /// Features, targets and penalty of the frame that is searched.
    pub area: &'a [f32],
    /// Features of the tile's own pixels, and perturbation steps.
    pub pixel: &'a [f32],
    pub sums: &'a mut [f32],
    pub columns: &'a mut [f32],
    /// What the steps for one vector of pixels hand on, see [`LOCAL`].
    pub local: &'a mut [f32],
    pub constants: Constants,
}

/// Vectors that the steps for one vector of pixels hand on, one for each offset of a block: exponents for both τ, then
/// what moving each guide channel at p changes through p's own patch, then through q's. In memory and not in variables,
/// because the compiler copies such large variables at every branch.
pub(super) const LOCAL: usize = (KINDS + 3 + 3) * MAX_BLOCK * MAX_LANES;
const OWN: usize = KINDS;
const EXCHANGED: usize = KINDS + 3;

/// Index of a vector of [`LOCAL`].
#[inline(always)]
fn local(kind: usize, offset: usize) -> usize {
    (kind * MAX_BLOCK + offset) * MAX_LANES
}

/// Numbers that are the same for all tiles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constants {
    /// −κ/k².
    pub cancellation: f32,
    /// ε.
    pub epsilon: f32,
    /// How often the variance of the pair's first pixel and that of its second stand in the denominator of Δ², beside
    /// once that of the first: (0, 1), or (1, 0) for twice the first. Numbers, not a choice: a branch here would stand
    /// in the innermost loop.
    pub first_again: f32,
    /// See `first_again`.
    pub second: f32,
    /// Largest Δ².
    pub largest: f32,
    /// Whether Φ² is divided by the sum of both pixels' D.
    pub pair: bool,
    /// The two τ.
    pub floors: [f32; KINDS],
    /// Number of different τ.
    pub floor_count: usize,
    /// Whether the pixel itself gets the largest of its neighbours' weights.
    pub largest_center: bool,
    /// Whether any pass wants the derivative.
    pub derivative: bool,
    /// Whether it moves all channels at once, and p only as the centre of its own patch.
    pub joint: bool,
    /// Factor of Φ²·D·channels to an exponent of 2, for pairs, one per feature: −log₂e/(k_f²·channels) is folded into
    /// the pixel planes otherwise.
    pub pair_scale: f32,
}

/// One row of neighbours: up to `MAX_BLOCK` horizontal offsets dx, dx+1, … at vertical offset dy.
pub(super) struct Block {
    /// Tile rows whose neighbours lie inside the image.
    pub rows: Range<usize>,
    pub dy: isize,
    pub dx: isize,
    /// Number of offsets that count; those after them have weight 0.
    pub count: usize,
    /// Whether the neighbours are of the frame to filter.
    pub same_frame: bool,
    /// Whether the derivative must look at p as a tap of a neighbour's patch.
    pub near: bool,
}

impl Block {
    /// Place of offset (0, 0) in the frame to filter, if the block has it.
    #[inline(always)]
    fn center(&self) -> usize {
        if self.same_frame && self.dy == 0 && (0..self.count as isize).contains(&-self.dx) {
            -self.dx as usize
        } else {
            usize::MAX
        }
    }
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

/// Reads the vector `i` values after `index` of `plane`, 0 ≤ `i` < [`MAX_BLOCK`]; several of one `index` share what
/// they read.
///
/// # Safety
/// As [`at`], with 2·`LANES` values at `index`.
#[inline(always)]
unsafe fn beside<S: Simd>(plane: &[f32], index: usize, i: usize) -> S::F {
    debug_assert!(index + 2 * S::LANES <= plane.len(), "reads {index} of {}", plane.len());
    // SAFETY: as the caller vouches.
    unsafe { S::load_beside(plane.as_ptr().add(index), i) }
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

/// One pass over the tile: everything for one block of `G` offsets.
///
/// # Safety
/// The instruction set is available. `tile` has the sizes that its layout says, `tile.width` is at most the
/// layout's tile width, and the offsets are within the layout's reach.
#[inline(always)]
pub(super) unsafe fn pass<S: Simd>(tile: &mut TileView<'_>, block: &Block, group: usize) {
    // SAFETY: passed on unchanged.
    unsafe {
        match group {
            3 => sized::<S, 3>(tile, block),
            6 => sized::<S, 6>(tile, block),
            _ => sized::<S, 7>(tile, block),
        }
    }
}

/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn sized<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block) {
    // SAFETY: passed on unchanged.
    unsafe {
        match *tile.layout.patches.as_slice() {
            [] => {}
            [0] => all_columns::<S, G, 0, 0>(tile, block),
            [1] => all_columns::<S, G, 1, 1>(tile, block),
            [2] => all_columns::<S, G, 2, 2>(tile, block),
            [3] => all_columns::<S, G, 3, 3>(tile, block),
            // No other pair: see `fits`.
            _ => all_columns::<S, G, 3, 1>(tile, block),
        }
        accumulate::<S, G>(tile, block);
    }
}

/// Σ_c Δ²_c for `N` neighbouring offsets (rousselle2013rdfc, Sec. 4).
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn distances<S: Simd, const N: usize>(tile: &TileView<'_>, here: usize, there: usize) -> [S::F; N] {
    let (channels, plane, constants) = (tile.layout.channels, tile.layout.guide.plane, tile.constants);
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        let mut out = [S::splat(0.0); N];
        for c in 0..channels {
            let (value, variance) = (c * plane, (channels + c) * plane);
            let p = at::<S>(tile.here, value + here);
            let vp = at::<S>(tile.here, variance + here);
            let base = base::<S>(vp, &constants);
            for o in 0..N {
                let q = at::<S>(tile.there, value + there + o);
                let vq = at::<S>(tile.there, variance + there + o);
                let d = S::sub(p, q);
                out[o] = S::add(out[o], square::<S>(d, vp, vq, base, &constants));
            }
        }
        out
    }
}

/// The first pixel's part of a pair's denominator, ε included: at least ε.
///
/// # Safety
/// The instruction set is available.
#[inline(always)]
unsafe fn base<S: Simd>(vp: S::F, constants: &Constants) -> S::F {
    // SAFETY: as the caller vouches. Factors of 0 and 1 round nothing.
    unsafe { S::fma(vp, S::splat(constants.first_again), S::add(vp, S::splat(constants.epsilon))) }
}

/// Δ² (rousselle2013rdfc, Sec. 4) of a difference; `base` is that of the pair's first pixel.
///
/// # Safety
/// The instruction set is available.
#[inline(always)]
unsafe fn square<S: Simd>(d: S::F, vp: S::F, vq: S::F, base: S::F, constants: &Constants) -> S::F {
    // SAFETY: as the caller vouches. The denominator is at least ε.
    unsafe {
        let noise = S::add(vp, S::min(vp, vq));
        let numerator = S::fma(S::splat(constants.cancellation), noise, S::mul(d, d));
        let denominator = S::fma(vq, S::splat(constants.second), base);
        S::min(S::div(numerator, denominator), S::splat(constants.largest))
    }
}

/// Vertical patch sums of all offsets of the block.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn all_columns<S: Simd, const G: usize, const BIG: usize, const SMALL: usize>(
    tile: &mut TileView<'_>,
    block: &Block,
) {
    // SAFETY: passed on unchanged.
    unsafe {
        let mut first = 0;
        while first + 2 <= G {
            patch_columns::<S, BIG, SMALL, 2>(tile, block, first);
            first += 2;
        }
        if first < G {
            patch_columns::<S, BIG, SMALL, 1>(tile, block, first);
        }
    }
}

/// Vertical patch sums of offsets `first..first + N` of the block for radius `BIG`, and for `SMALL` if that is
/// another, on the tile and `BIG` columns on both sides.
///
/// Walks down columns of vectors, the last 2·`BIG` rows of distances in registers.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn patch_columns<S: Simd, const BIG: usize, const SMALL: usize, const N: usize>(
    tile: &mut TileView<'_>,
    block: &Block,
    first: usize,
) {
    // Copies, so that stores to the planes cannot make the compiler read any of this again.
    let (guide, columns) = (tile.layout.guide, tile.layout.columns);
    let corner = guide.origin() + block.rows.start * guide.pitch - BIG * guide.pitch - BIG;
    let shift = block.dy * guide.pitch as isize + block.dx + first as isize;
    let mut x = 0;
    // SAFETY: the caller vouches for the instruction set; the guide copies reach `reach + patch` pixels beyond
    // the tile on every side and a block more on the right, and the sums hold the tile and `patch` columns on both
    // sides.
    unsafe {
        while x < tile.width + 2 * BIG {
            let mut window = [[S::splat(0.0); N]; 2 * MAX_PATCH_RADIUS + 1];
            let mut here = corner + x;
            for row in window.iter_mut().take(2 * BIG) {
                *row = distances::<S, N>(tile, here, here.wrapping_add_signed(shift));
                here += guide.pitch;
            }
            let mut to = first * columns.plane + block.rows.start * columns.pitch + x;
            for _ in block.rows.clone() {
                window[2 * BIG] = distances::<S, N>(tile, here, here.wrapping_add_signed(shift));
                for o in 0..N {
                    let mut sum = window[BIG][o];
                    for i in 1..=BIG {
                        if SMALL < BIG && i == SMALL + 1 {
                            put::<S>(tile.columns, to + (MAX_BLOCK + o) * columns.plane, sum);
                        }
                        sum = S::add(sum, S::add(window[BIG - i][o], window[BIG + i][o]));
                    }
                    put::<S>(tile.columns, to + o * columns.plane, sum);
                }
                for i in 0..2 * BIG {
                    window[i] = window[i + 1];
                }
                here += guide.pitch;
                to += columns.pitch;
            }
            x += S::LANES;
        }
    }
}

/// Horizontal patch sum of radius `PATCH`, which makes d² of Eq. 2, around `from + PATCH`, from the vertical sums.
///
/// # Safety
/// As [`pass`], with 2·`LANES` values at `from`.
#[inline(always)]
unsafe fn patch_sum<S: Simd, const PATCH: usize>(columns: &[f32], from: usize) -> S::F {
    debug_assert!(from + 2 * S::LANES <= columns.len());
    // SAFETY: as the caller vouches.
    unsafe {
        let from = columns.as_ptr().add(from);
        let mut sum = S::load_beside(from, PATCH);
        for i in 1..=PATCH {
            sum = S::add(sum, S::add(S::load_beside(from, PATCH - i), S::load_beside(from, PATCH + i)));
        }
        sum
    }
}

/// Places of one vector of pixels in the planes.
#[derive(Clone, Copy)]
struct Place {
    /// In pixel and accumulator planes.
    pixel: usize,
    /// Of the first neighbour, in area planes.
    area: usize,
    /// In guide planes.
    here: usize,
    /// Of the first neighbour, in guide planes.
    there: usize,
    /// Of the patch around the pixel, in column planes: its leftmost tap for the largest radius.
    columns: usize,
}

/// Adds the block's offsets to the running sums of every pixel of the tile.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn accumulate<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block) {
    let (area, guide, pixel, columns) =
        (tile.layout.area, tile.layout.guide, tile.layout.pixel, tile.layout.columns);
    // SAFETY: the caller vouches for the instruction set; the copies reach `reach` pixels beyond the tile.
    unsafe {
        for y in block.rows.clone() {
            let mut x = 0;
            while x < tile.width {
                let here = guide.origin() + y * guide.pitch + x;
                let shift = |pitch: usize| block.dy * pitch as isize + block.dx;
                let place = Place {
                    pixel: y * pixel.pitch + x,
                    area: (area.origin() + y * area.pitch + x).wrapping_add_signed(shift(area.pitch)),
                    here,
                    there: here.wrapping_add_signed(shift(guide.pitch)),
                    columns: y * columns.pitch + x,
                };
                vector::<S, G>(tile, block, place);
                x += S::LANES;
            }
        }
    }
}

/// [`accumulate`] for one vector of pixels.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn vector<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block, place: Place) {
    // SAFETY: passed on unchanged.
    unsafe {
        limits::<S, G>(tile, block, place);
        if tile.constants.derivative {
            bends::<S, G>(tile, block, place);
            if block.near {
                exchanged::<S, G>(tile, block, place);
            }
        }
        for k in 0..tile.passes.len() {
            let pass = tile.passes[k];
            match pass.patch {
                0 => weigh::<S, G, 0>(tile, block, place, k, pass),
                1 => weigh::<S, G, 1>(tile, block, place, k, pass),
                2 => weigh::<S, G, 2>(tile, block, place, k, pass),
                3 => weigh::<S, G, 3>(tile, block, place, k, pass),
                _ => weigh::<S, G, NO_PATCH>(tile, block, place, k, pass),
            }
        }
    }
}

/// Exponents of 2 of the feature weights (Eq. 3) for both τ, at most 0; far below outside the image and for offsets that do
/// not count.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn limits<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block, place: Place) {
    let (layout, constants) = (tile.layout, tile.constants);
    let center = if constants.largest_center { block.center() } else { usize::MAX };
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        for o in 0..G {
            let penalty = at::<S>(tile.area, layout.area_penalty() + place.area + o);
            let skip = o >= block.count || o == center;
            let limit = if skip { S::splat(PENALTY) } else { penalty };
            put::<S>(tile.local, local(0, o), limit);
            if constants.floor_count > 1 {
                put::<S>(tile.local, local(1, o), limit);
            }
        }
        match (constants.pair, constants.floor_count > 1) {
            (false, false) => features::<S, G, 1, false>(tile, place),
            (false, true) => features::<S, G, 2, false>(tile, place),
            (true, false) => features::<S, G, 1, true>(tile, place),
            (true, true) => features::<S, G, 2, true>(tile, place),
        }
    }
}

/// Lowers the limits to what each feature allows (Φ² of rousselle2013rdfc, Sec. 5), for `FLOORS` different τ.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn features<S: Simd, const G: usize, const FLOORS: usize, const PAIR: bool>(
    tile: &mut TileView<'_>,
    place: Place,
) {
    let (layout, constants) = (tile.layout, tile.constants);
    // Distances between the planes of one channel.
    let area_kind = layout.area_feature(1, 0);
    let pixel_kind = layout.pixel_feature(1, 0);
    let (mut area, mut pixel) = (place.area, place.pixel);
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        for &count in &layout.features {
            let mut sums = [[S::splat(0.0); G]; FLOORS];
            for _ in 0..count {
                let p = at::<S>(tile.pixel, pixel);
                let negative = at::<S>(tile.pixel, pixel + pixel_kind);
                let vp = S::sub(S::splat(0.0), negative);
                let mut scales = [S::splat(0.0); FLOORS];
                for i in 0..FLOORS {
                    scales[i] = at::<S>(tile.pixel, pixel + (2 + i) * pixel_kind);
                }
                for o in 0..G {
                    let d = S::sub(beside::<S>(tile.area, area, o), p);
                    let vq = beside::<S>(tile.area, area + area_kind, o);
                    // (f(p) − f(q))² − (v(p) + min(v(p), v(q)))
                    let excess = S::fma(d, d, S::sub(negative, S::min(vp, vq)));
                    for i in 0..FLOORS {
                        if PAIR {
                            let dq = beside::<S>(tile.area, area + 2 * area_kind, o);
                            let both = S::add(scales[i], S::max(dq, S::splat(constants.floors[i])));
                            let scaled = S::mul(excess, S::splat(constants.pair_scale / count as f32));
                            sums[i][o] = S::add(sums[i][o], S::div(scaled, both));
                        } else {
                            sums[i][o] = S::fma(excess, scales[i], sums[i][o]);
                        }
                    }
                }
                area += layout.area.plane;
                pixel += layout.pixel.plane;
            }
            for i in 0..FLOORS {
                for o in 0..G {
                    let limit = S::min(at::<S>(tile.local, local(i, o)), sums[i][o]);
                    put::<S>(tile.local, local(i, o), limit);
                }
            }
        }
    }
}

/// Change of Δ² at the centre of the patches for each channel moved by its step (all at once: the sum, three times).
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn bends<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block, place: Place) {
    let (layout, constants) = (tile.layout, tile.constants);
    let center = block.center();
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        for c in 0..3 {
            let (value, variance) = (c * layout.guide.plane, (3 + c) * layout.guide.plane);
            let p = at::<S>(tile.here, value + place.here);
            let vp = at::<S>(tile.here, variance + place.here);
            let base = base::<S>(vp, &constants);
            let step = at::<S>(tile.pixel, layout.pixel_step(c) + place.pixel);
            for o in 0..G {
                let q = beside::<S>(tile.there, value + place.there, o);
                let vq = beside::<S>(tile.there, variance + place.there, o);
                put::<S>(
                    tile.local,
                    local(OWN + c, o),
                    bend::<S>(S::sub(p, q), step, vp, vq, base, &constants),
                );
            }
            if center < G {
                put::<S>(tile.local, local(OWN + c, center), S::splat(0.0));
            }
        }
        if constants.joint {
            for o in 0..G {
                let mut sum = at::<S>(tile.local, local(OWN, o));
                sum = S::add(sum, at::<S>(tile.local, local(OWN + 1, o)));
                sum = S::add(sum, at::<S>(tile.local, local(OWN + 2, o)));
                for c in 0..3 {
                    put::<S>(tile.local, local(OWN + c, o), sum);
                }
            }
        }
    }
}

/// The same through p as a tap of q's patch: the pair (p − offset, p). 0 for offsets beyond the patch radius.
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn exchanged<S: Simd, const G: usize>(tile: &mut TileView<'_>, block: &Block, place: Place) {
    let (layout, constants) = (tile.layout, tile.constants);
    let reach = layout.patches[0] as isize;
    let center = block.center();
    // SAFETY: the caller vouches for the instruction set; the guide copies reach the patch radius beyond the tile.
    unsafe {
        for c in 0..3 {
            let (value, variance) = (c * layout.guide.plane, (3 + c) * layout.guide.plane);
            let p = at::<S>(tile.here, value + place.here);
            let vp = at::<S>(tile.here, variance + place.here);
            let step = at::<S>(tile.pixel, layout.pixel_step(c) + place.pixel);
            for o in 0..G {
                let dx = block.dx + o as isize;
                let mut change = S::splat(0.0);
                if dx.abs() <= reach && o != center {
                    let shift = block.dy * layout.guide.pitch as isize + dx;
                    let other = place.here.wrapping_add_signed(-shift);
                    let a = at::<S>(tile.here, value + other);
                    let va = at::<S>(tile.here, variance + other);
                    // The square of u(a) − (u(p) + δ) is that of (u(p) − u(a)) + δ; the centre of this pair is a.
                    let base = base::<S>(va, &constants);
                    change = bend::<S>(S::sub(p, a), step, va, vp, base, &constants);
                }
                put::<S>(tile.local, local(EXCHANGED + c, o), change);
            }
        }
    }
}

/// Δ² of d + step less that of d; `base` is that of the pair's first pixel.
///
/// # Safety
/// The instruction set is available.
#[inline(always)]
unsafe fn bend<S: Simd>(d: S::F, step: S::F, vp: S::F, vq: S::F, base: S::F, constants: &Constants) -> S::F {
    // SAFETY: as the caller vouches. The denominator is at least ε.
    unsafe {
        let noise = S::mul(S::splat(constants.cancellation), S::add(vp, S::min(vp, vq)));
        let denominator = S::fma(vq, S::splat(constants.second), base);
        let inverse = S::div(S::splat(1.0), denominator);
        let largest = S::splat(constants.largest);
        let moved = S::add(d, step);
        let before = S::min(S::mul(S::fma(d, d, noise), inverse), largest);
        let after = S::min(S::mul(S::fma(moved, moved, noise), inverse), largest);
        S::sub(after, before)
    }
}

/// 2^exponent, 0 below the range of normal numbers.
///
/// # Safety
/// The instruction set is available.
#[inline(always)]
unsafe fn weight<S: Simd>(exponent: S::F) -> S::F {
    // SAFETY: as the caller vouches.
    unsafe {
        let (value, scale) = S::exp2(exponent);
        S::keep_scaled(S::le(S::splat(-126.0), exponent), value, scale)
    }
}

/// One pass's weights of the block (Eq. 4: the lower exponent of Eq. 2 and Eq. 3), and what they add to its sums (Eq. 1).
///
/// # Safety
/// As [`pass`].
#[inline(always)]
unsafe fn weigh<S: Simd, const G: usize, const PATCH: usize>(
    tile: &mut TileView<'_>,
    block: &Block,
    place: Place,
    index: usize,
    pass: HotPass,
) {
    let layout = tile.layout;
    let (plane, targets) = (layout.pixel.plane, layout.targets);
    let sums = layout.sums(index) + place.pixel;
    // SAFETY: the caller vouches for the instruction set and the indices.
    unsafe {
        let scale = S::splat(pass.scale);
        let mut guided = [S::splat(0.0); G];
        let mut w = [S::splat(0.0); G];
        for o in 0..G {
            if PATCH != NO_PATCH {
                let from = place.columns
                    + (pass.columns * MAX_BLOCK + o) * layout.columns.plane
                    + (layout.patches[0] - PATCH);
                guided[o] = S::mul(patch_sum::<S, PATCH>(tile.columns, from), scale);
                w[o] = weight::<S>(S::min(guided[o], at::<S>(tile.local, local(pass.floor, o))));
            } else {
                w[o] = weight::<S>(at::<S>(tile.local, local(pass.floor, o)));
            }
        }
        let extra = sums + targets * plane;
        let mut total = at::<S>(tile.sums, extra + WEIGHT * plane);
        for o in 0..G {
            total = S::add(total, w[o]);
        }
        put::<S>(tile.sums, extra + WEIGHT * plane, total);
        if tile.constants.largest_center {
            let mut largest = at::<S>(tile.sums, extra + LARGEST * plane);
            for o in 0..G {
                largest = S::max(w[o], largest);
            }
            put::<S>(tile.sums, extra + LARGEST * plane, largest);
        }
        for k in 0..targets {
            let from = layout.area_target(k) + place.area;
            let mut sum = at::<S>(tile.sums, sums + k * plane);
            for o in 0..G {
                sum = S::fma(w[o], beside::<S>(tile.area, from, o), sum);
            }
            put::<S>(tile.sums, sums + k * plane, sum);
        }
        if PATCH == NO_PATCH || !pass.derivative {
            return;
        }
        for c in 0..3 {
            let value = c * layout.guide.plane;
            let p = at::<S>(tile.here, value + place.here);
            let mut step = at::<S>(tile.sums, extra + (STEP + c) * plane);
            let mut moved_step = at::<S>(tile.sums, extra + (MOVED_STEP + c) * plane);
            let mut moved_weight = at::<S>(tile.sums, extra + (MOVED_WEIGHT + c) * plane);
            let mut moved_largest = at::<S>(tile.sums, extra + (MOVED_LARGEST + c) * plane);
            for o in 0..G {
                let d = S::sub(beside::<S>(tile.there, value + place.there, o), p);
                let mut bend = at::<S>(tile.local, local(OWN + c, o));
                if block.near {
                    let distance = block.dy.abs().max((block.dx + o as isize).abs());
                    if distance <= PATCH as isize {
                        bend = S::add(bend, at::<S>(tile.local, local(EXCHANGED + c, o)));
                    }
                }
                let limit = at::<S>(tile.local, local(pass.floor, o));
                let moved = weight::<S>(S::min(S::fma(bend, scale, guided[o]), limit));
                step = S::fma(w[o], d, step);
                moved_step = S::fma(moved, d, moved_step);
                moved_weight = S::add(moved_weight, moved);
                moved_largest = S::max(moved, moved_largest);
            }
            put::<S>(tile.sums, extra + (STEP + c) * plane, step);
            put::<S>(tile.sums, extra + (MOVED_STEP + c) * plane, moved_step);
            put::<S>(tile.sums, extra + (MOVED_WEIGHT + c) * plane, moved_weight);
            put::<S>(tile.sums, extra + (MOVED_LARGEST + c) * plane, moved_largest);
        }
    }
}
