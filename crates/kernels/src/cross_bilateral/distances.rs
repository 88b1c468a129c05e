//! e^−D, which all filters share.

use super::layout::TILE;
use super::params::{BilateralGuide, MAX_GUIDES};
use super::rows::{Columns, Rows};
use crate::nlm::maps::exponential::exponential;

/// 2σ_k², by which variances are multiplied: D's denominators, while differences lose no digit.
#[inline(always)]
pub(super) fn scale(guide: &BilateralGuide<'_>) -> f32 {
    2.0 * guide.sigma * guide.sigma
}

/// Rows of a guide: values, then scaled variances.
#[derive(Clone, Copy, Default)]
struct Guided<'a> {
    own: [&'a [f32]; 2],
    /// From the first neighbour of the first pixel to the last of the last.
    others: [&'a [f32]; 2],
    /// Scaled as variances are.
    floor: f32,
}

impl<'a> Guided<'a> {
    /// Values and variances of pixels and of their neighbours at offset number `o`: p, q, S_p, S_q.
    #[inline(always)]
    fn at(&self, o: usize, n: usize) -> [&'a [f32]; 4] {
        let ([p, vp], [q, vq]) = (self.own, self.others);
        [&p[..n], &q[o..][..n], &vp[..n], &vq[o..][..n]]
    }
}

/// e^−D at every offset, 0 where the neighbour is beyond the image as `beyond` says.
#[inline(always)]
pub(super) fn share(
    pair: &Rows<'_>,
    guides: &[BilateralGuide<'_>],
    floor: f32,
    beyond: &[f32],
    to: &mut [f32],
) {
    let Columns { first, last, width } = *pair.columns;
    let mut rows = [Guided::default(); MAX_GUIDES];
    let rows = &mut rows[..guides.len()];
    for (k, (row, guide)) in rows.iter_mut().zip(guides).enumerate() {
        let planes = [k, guides.len() + k];
        *row = Guided {
            own: planes.map(|k| pair.own(k)),
            others: planes.map(|k| pair.others(k, first, last)),
            floor: floor * scale(guide),
        };
    }
    let beyond = &beyond[pair.layout.area.left.wrapping_add_signed(first)..];
    // Shares no memory with what is read, and so loops over it become vectors.
    let mut distances = [0.0; TILE.0];
    let distances = &mut distances[..width];
    for (o, to) in to.chunks_exact_mut(TILE.0).take((last - first + 1) as usize).enumerate() {
        distances.copy_from_slice(&beyond[o..][..width]);
        for some in rows.chunks(2) {
            match some {
                [a, b] => add_two(a, b, o, distances),
                [a] => add_one(a, o, distances),
                _ => {}
            }
        }
        for (to, distance) in to.iter_mut().zip(&*distances) {
            *to = exponential(*distance);
        }
    }
}

/// Numerator and denominator of a guide's part of D.
#[inline(always)]
fn fraction(difference: f32, variance: f32, floor: f32) -> (f32, f32) {
    (difference * difference, if variance > floor { variance } else { floor })
}

/// Adds a guide's part of D.
#[inline(always)]
fn add_one(guide: &Guided<'_>, o: usize, to: &mut [f32]) {
    let [p, q, vp, vq] = guide.at(o, to.len());
    for x in 0..to.len() {
        let (above, below) = fraction(p[x] - q[x], vp[x] + vq[x], guide.floor);
        to[x] += above / below;
    }
}

/// Adds the parts of two guides as one fraction: a division costs more than the products. The limits of the parameters keep these
/// among the normal numbers.
#[inline(always)]
fn add_two(first: &Guided<'_>, second: &Guided<'_>, o: usize, to: &mut [f32]) {
    let [p, q, vp, vq] = first.at(o, to.len());
    let [r, s, vr, vs] = second.at(o, to.len());
    for x in 0..to.len() {
        let (a, b) = fraction(p[x] - q[x], vp[x] + vq[x], first.floor);
        let (c, d) = fraction(r[x] - s[x], vr[x] + vs[x], second.floor);
        to[x] += a.mul_add(d, c * b) / (b * d);
    }
}
