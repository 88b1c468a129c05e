//! What moving the guide at p changes in the patch distances (rousselle2013rdfc, Sec. 6, below Eq. 5).

use super::distances::base;
use super::tile::{Constants, EXCHANGED, Group, OWN, Place, TileView, local};
use crate::engine::Simd;

/// Change of Δ² at the centre of the patches for each channel moved by its step (all at once: the sum, three times).
#[inline(always)]
pub(super) fn own_patch<S: Simd, const G: usize>(s: S, tile: &mut TileView<'_>, group: &Group, place: Place) {
    let (layout, constants) = (tile.layout, tile.constants);
    for c in 0..3 {
        let (value, variance) = (c * layout.guide.plane, (3 + c) * layout.guide.plane);
        let p = s.load(tile.here, value + place.here);
        let vp = s.load(tile.here, variance + place.here);
        let base = base(s, vp, &constants);
        let step = s.load(tile.pixel, layout.pixel_step(c) + place.pixel);
        for o in 0..G {
            let q = s.load_beside(tile.there, value + place.there, o);
            let vq = s.load_beside(tile.there, variance + place.there, o);
            s.store(tile.local, local(OWN + c, o), bend(s, s.sub(p, q), step, (vp, vq), base, &constants));
        }
        if group.center < G {
            s.store(tile.local, local(OWN + c, group.center), s.zero());
        }
    }
    if constants.joint {
        for o in 0..G {
            let mut sum = s.load(tile.local, local(OWN, o));
            sum = s.add(sum, s.load(tile.local, local(OWN + 1, o)));
            sum = s.add(sum, s.load(tile.local, local(OWN + 2, o)));
            for c in 0..3 {
                s.store(tile.local, local(OWN + c, o), sum);
            }
        }
    }
}

/// The same through p as a tap of q's patch: the pair (p − offset, p). 0 for offsets beyond the patch radius.
#[inline(always)]
pub(super) fn other_patch<S: Simd, const G: usize>(
    s: S,
    tile: &mut TileView<'_>,
    group: &Group,
    place: Place,
) {
    let (layout, constants) = (tile.layout, tile.constants);
    let reach = layout.patches[0] as isize;
    for c in 0..3 {
        let (value, variance) = (c * layout.guide.plane, (3 + c) * layout.guide.plane);
        let p = s.load(tile.here, value + place.here);
        let vp = s.load(tile.here, variance + place.here);
        let step = s.load(tile.pixel, layout.pixel_step(c) + place.pixel);
        for o in 0..G {
            let dx = group.dx + o as isize;
            let mut change = s.zero();
            if dx.abs() <= reach && o != group.center {
                let shift = group.dy * layout.guide.pitch as isize + dx;
                let other = place.here.wrapping_add_signed(-shift);
                let a = s.load(tile.here, value + other);
                let va = s.load(tile.here, variance + other);
                // The square of u(a) − (u(p) + δ) is that of (u(p) − u(a)) + δ; the centre of this pair is a.
                let base = base(s, va, &constants);
                change = bend(s, s.sub(p, a), step, (va, vp), base, &constants);
            }
            s.store(tile.local, local(EXCHANGED + c, o), change);
        }
    }
}

/// Δ² of d + step less that of d; `base` is that of the pair's first pixel.
#[inline(always)]
fn bend<S: Simd>(
    s: S,
    d: S::F,
    step: S::F,
    (vp, vq): (S::F, S::F),
    base: S::F,
    constants: &Constants,
) -> S::F {
    let noise = s.mul(s.splat(constants.cancellation), s.add(vp, s.min(vp, vq)));
    // At least ε.
    let denominator = s.fma(vq, s.splat(constants.second), base);
    let inverse = s.div(s.splat(1.0), denominator);
    let largest = s.splat(constants.largest);
    let moved = s.add(d, step);
    let before = s.min(s.mul(s.fma(d, d, noise), inverse), largest);
    let after = s.min(s.mul(s.fma(moved, moved, noise), inverse), largest);
    s.sub(after, before)
}
