//! Weights and what they add to the sums (moon2013flash, Eq. 1 over the set of Eq. 2).

use super::tile::{JOINT, Offsets, SEPARATE, SINGLE, TileView};
use crate::engine::{Plane, Simd, Weighted, across};
use crate::flash_filter::layout::{BLOCK, Layout};

/// Adds the block's offsets to the running sums of every pixel of the tile: Eq. 1 over the set of Eq. 2.
#[inline(always)]
pub(super) fn accumulate<S: Simd, const PATCH: usize, const RULE: usize, const GUIDED: bool>(
    s: S,
    tile: &mut TileView<'_>,
    offsets: &Offsets,
) {
    let Layout { source, pixel, columns, .. } = *tile.layout;
    let block = &offsets.block;
    let shift = offsets.frame as isize + block.dy * source.pitch as isize + block.dx;
    let (taps, count) = (Weighted(tile.taps), block.count.min(BLOCK));
    let lowest = s.splat(-126.0);
    for y in block.rows.clone() {
        let mut x = 0;
        while x < tile.width {
            let here = y * pixel.pitch + x;
            let center = source.origin() + y * source.pitch + x;
            let there = center.wrapping_add_signed(shift);
            let from = y * columns.pitch + x;
            let mut p = [s.zero(); 4];
            let mut half_width = [s.zero(); 3];
            for c in 0..3 {
                p[c] = s.load(tile.source, c * source.plane + center);
                if RULE != SINGLE {
                    half_width[c] = s.load(tile.half_width, c * pixel.plane + here);
                }
            }
            if RULE == SINGLE {
                p[3] = s.load(tile.source, 3 * source.plane + center);
                half_width[0] = s.load(tile.half_width, here);
            }
            let factor = if GUIDED { s.load(tile.factor, center) } else { lowest };
            let mut sum = [s.zero(); 3];
            let mut weights = [s.zero(); 3];
            for c in 0..3 {
                sum[c] = s.load(tile.sums, c * pixel.plane + here);
                if c == 0 || RULE == SEPARATE {
                    weights[c] = s.load(tile.sums, (3 + c) * pixel.plane + here);
                }
            }
            for o in 0..count {
                // Eq. 1: g_s and g_r.
                let spatial = s.splat(offsets.spatial[o]);
                let (mut exponent, mut weight, mut scale) = (lowest, spatial, lowest);
                if GUIDED {
                    let patch = across::<S, PATCH>(s, &taps, tile.columns, from + o * columns.plane);
                    let factor = s.min(factor, s.load(tile.factor, there + o));
                    exponent = s.fma(patch, factor, spatial);
                    (weight, scale) = s.exp2_factors(exponent);
                }
                // False for weights below the normal range and for the NaN of an overflowed distance.
                let alike = s.normal_power(exponent);
                let mut d = [s.zero(); 3];
                for c in 0..3 {
                    d[c] = s.sub(s.load(tile.source, c * source.plane + there + o), p[c]);
                }
                if RULE == SEPARATE {
                    for c in 0..3 {
                        let member = s.and_le(alike, s.abs(d[c]), half_width[c]);
                        let w = weigh::<S, GUIDED>(s, member, weight, scale);
                        sum[c] = s.fma(w, d[c], sum[c]);
                        weights[c] = s.add(weights[c], w);
                        if let Some(carried) = tile.carried {
                            carry(s, tile, (carried, c), w, here, there + o);
                        }
                    }
                    continue;
                }
                // Eq. 2.
                let mut member = alike;
                if RULE == JOINT {
                    for c in 0..3 {
                        member = s.and_le(member, s.abs(d[c]), half_width[c]);
                    }
                } else {
                    let tested = s.sub(s.load(tile.source, 3 * source.plane + there + o), p[3]);
                    member = s.and_le(member, s.abs(tested), half_width[0]);
                }
                let w = weigh::<S, GUIDED>(s, member, weight, scale);
                for c in 0..3 {
                    sum[c] = s.fma(w, d[c], sum[c]);
                }
                weights[0] = s.add(weights[0], w);
                if let Some(carried) = tile.carried {
                    for c in 0..3 {
                        carry(s, tile, (carried, c), w, here, there + o);
                    }
                }
            }
            for c in 0..3 {
                s.store(tile.sums, c * pixel.plane + here, sum[c]);
                if c == 0 || RULE == SEPARATE {
                    s.store(tile.sums, (3 + c) * pixel.plane + here, weights[c]);
                }
            }
            x += S::LANES;
        }
    }
}

/// The weight where `member` holds, else 0: with a guide from the two factors of its power of 2.
#[inline(always)]
fn weigh<S: Simd, const GUIDED: bool>(s: S, member: S::M, weight: S::F, scale: S::F) -> S::F {
    if GUIDED { s.keep_scaled(member, weight, scale) } else { s.keep(member, weight) }
}

/// Adds one offset to the sum of a carried plane; `here` is a pixel of the tile, `there` its neighbour on the source's grid
/// and in its frame.
///
/// The sum stays in memory: passes that carry nothing, the costly ones, keep their registers, and one form of
/// [`accumulate`] serves both.
#[inline(always)]
fn carry<S: Simd>(
    s: S,
    tile: &mut TileView<'_>,
    (carried, channel): (&Plane, usize),
    weight: S::F,
    here: usize,
    there: usize,
) {
    let Layout { source, pixel, .. } = *tile.layout;
    let value = s.load(carried, channel * source.plane + there);
    let place = (6 + channel) * pixel.plane + here;
    let weight = if tile.squared { s.mul(weight, weight) } else { weight };
    let sum = s.load(tile.sums, place);
    s.store(tile.sums, place, s.fma(weight, value, sum));
}
