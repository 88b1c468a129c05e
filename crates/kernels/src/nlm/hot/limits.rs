//! Feature weights (rousselle2013rdfc, Sec. 5, Eq. 3) as exponents of 2.

use super::tile::{Group, Place, TileView, local};
use crate::engine::Simd;

/// Exponent that makes a weight zero.
pub(in crate::nlm) const PENALTY: f32 = -1e9;

/// Exponents of 2 of the feature weights for both τ, at most 0; far below outside the image and for offsets that do
/// not count.
#[inline(always)]
pub(super) fn limits<S: Simd, const G: usize>(s: S, tile: &mut TileView<'_>, group: &Group, place: Place) {
    let (layout, constants) = (tile.layout, tile.constants);
    let center = if constants.largest_center { group.center } else { usize::MAX };
    for o in 0..G {
        let penalty = s.load(tile.area, layout.area_penalty() + place.area + o);
        let skip = o >= group.count || o == center;
        let limit = if skip { s.splat(PENALTY) } else { penalty };
        s.store(tile.local, local(0, o), limit);
        if constants.floor_count > 1 {
            s.store(tile.local, local(1, o), limit);
        }
    }
    match (constants.pair, constants.floor_count > 1) {
        (false, false) => features::<S, G, 1, false>(s, tile, place),
        (false, true) => features::<S, G, 2, false>(s, tile, place),
        (true, false) => features::<S, G, 1, true>(s, tile, place),
        (true, true) => features::<S, G, 2, true>(s, tile, place),
    }
}

/// Lowers the limits to what each feature allows (Φ²), for `FLOORS` different τ.
#[inline(always)]
fn features<S: Simd, const G: usize, const FLOORS: usize, const PAIR: bool>(
    s: S,
    tile: &mut TileView<'_>,
    place: Place,
) {
    let (layout, constants) = (tile.layout, tile.constants);
    // Distances between the planes of one channel.
    let area_kind = layout.area_feature(1, 0);
    let pixel_kind = layout.pixel_feature(1, 0);
    let (mut area, mut pixel) = (place.area, place.pixel);
    for &count in &layout.features {
        let mut sums = [[s.zero(); G]; FLOORS];
        for _ in 0..count {
            let p = s.load(tile.pixel, pixel);
            let negative = s.load(tile.pixel, pixel + pixel_kind);
            let vp = s.sub(s.zero(), negative);
            let mut scales = [s.zero(); FLOORS];
            for i in 0..FLOORS {
                scales[i] = s.load(tile.pixel, pixel + (2 + i) * pixel_kind);
            }
            for o in 0..G {
                let d = s.sub(s.load_beside(tile.area, area, o), p);
                let vq = s.load_beside(tile.area, area + area_kind, o);
                // (f(p) − f(q))² − (v(p) + min(v(p), v(q)))
                let excess = s.fma(d, d, s.sub(negative, s.min(vp, vq)));
                for i in 0..FLOORS {
                    if PAIR {
                        let dq = s.load_beside(tile.area, area + 2 * area_kind, o);
                        let both = s.add(scales[i], s.max(dq, s.splat(constants.floors[i])));
                        let scaled = s.mul(excess, s.splat(constants.pair_scale / count as f32));
                        sums[i][o] = s.add(sums[i][o], s.div(scaled, both));
                    } else {
                        sums[i][o] = s.fma(excess, scales[i], sums[i][o]);
                    }
                }
            }
            area += layout.area.plane;
            pixel += layout.pixel.plane;
        }
        for i in 0..FLOORS {
            for o in 0..G {
                let limit = s.min(s.load(tile.local, local(i, o)), sums[i][o]);
                s.store(tile.local, local(i, o), limit);
            }
        }
    }
}
