//! Weights and what they add to the sums (rousselle2013rdfc, Eq. 1, 2 and 4).

use super::tile::{EXCHANGED, Group, HotPass, NO_PATCH, OWN, Place, TileView, local};
use crate::engine::{Equal, Simd, across};
use crate::nlm::layout::{LARGEST, MOVED_LARGEST, MOVED_STEP, MOVED_WEIGHT, STEP, WEIGHT};

/// One pass's weights of the group (Eq. 4: the lower exponent of Eq. 2 and Eq. 3), and what they add to its sums (Eq. 1).
#[inline(always)]
pub(super) fn weigh<S: Simd, const G: usize, const PATCH: usize>(
    s: S,
    tile: &mut TileView<'_>,
    group: &Group,
    place: Place,
    index: usize,
    pass: HotPass,
) {
    let layout = tile.layout;
    let (plane, targets) = (layout.sums.plane, layout.targets);
    let sums = layout.sums(index) + place.sums;
    let scale = s.splat(pass.scale);
    // Eq. 4.
    let mut guided = [s.zero(); G];
    let mut w = [s.zero(); G];
    for o in 0..G {
        let limit = s.load(tile.local, local(pass.floor, o));
        if PATCH == NO_PATCH {
            w[o] = s.exp2_or_zero(limit);
        } else {
            let from = place.columns
                + (pass.columns * layout.block + o) * layout.columns.plane
                + (layout.patches[0] - PATCH);
            guided[o] = s.mul(across::<S, PATCH>(s, &Equal, tile.columns, from), scale);
            w[o] = s.exp2_or_zero(s.min(guided[o], limit));
        }
    }
    // Eq. 1.
    let extra = sums + targets * plane;
    let mut total = s.load(tile.sums, extra + WEIGHT * plane);
    for o in 0..G {
        total = s.add(total, w[o]);
    }
    s.store(tile.sums, extra + WEIGHT * plane, total);
    if tile.constants.largest_center {
        let mut largest = s.load(tile.sums, extra + LARGEST * plane);
        for o in 0..G {
            largest = s.max(w[o], largest);
        }
        s.store(tile.sums, extra + LARGEST * plane, largest);
    }
    for k in 0..targets {
        let from = layout.area_target(k) + place.area;
        let mut sum = s.load(tile.sums, sums + k * plane);
        for o in 0..G {
            sum = s.fma(w[o], s.load_beside(tile.area, from, o), sum);
        }
        s.store(tile.sums, sums + k * plane, sum);
    }
    if PATCH == NO_PATCH || !pass.derivative {
        return;
    }
    // The same with the guide at p moved (Sec. 6, below Eq. 5).
    for c in 0..3 {
        let value = c * layout.guide.plane;
        let p = s.load(tile.here, value + place.here);
        let mut step = s.load(tile.sums, extra + (STEP + c) * plane);
        let mut moved_step = s.load(tile.sums, extra + (MOVED_STEP + c) * plane);
        let mut moved_weight = s.load(tile.sums, extra + (MOVED_WEIGHT + c) * plane);
        let mut moved_largest = s.load(tile.sums, extra + (MOVED_LARGEST + c) * plane);
        for o in 0..G {
            let d = s.sub(s.load_beside(tile.there, value + place.there, o), p);
            let mut bend = s.load(tile.local, local(OWN + c, o));
            if group.near {
                let distance = group.dy.abs().max((group.dx + o as isize).abs());
                if distance <= PATCH as isize {
                    bend = s.add(bend, s.load(tile.local, local(EXCHANGED + c, o)));
                }
            }
            let limit = s.load(tile.local, local(pass.floor, o));
            let moved = s.exp2_or_zero(s.min(s.fma(bend, scale, guided[o]), limit));
            step = s.fma(w[o], d, step);
            moved_step = s.fma(moved, d, moved_step);
            moved_weight = s.add(moved_weight, moved);
            moved_largest = s.max(moved, moved_largest);
        }
        s.store(tile.sums, extra + (STEP + c) * plane, step);
        s.store(tile.sums, extra + (MOVED_STEP + c) * plane, moved_step);
        s.store(tile.sums, extra + (MOVED_WEIGHT + c) * plane, moved_weight);
        s.store(tile.sums, extra + (MOVED_LARGEST + c) * plane, moved_largest);
    }
}
