//! Distances of patches, each channel alone.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use super::guide::{GROUP, Layout};
use super::params::MAX_PATCH_RADIUS;
use crate::engine::{Equal, Plane, Simd, across};

/// Largest Δ² of one pair of pixels; the program's.
pub(super) const LARGEST: f32 = 1e4;

/// Horizontal offsets dx, dx + 1, … of one vertical offset, and the rows of the tile that have such neighbours.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub rows: std::ops::Range<usize>,
    pub dy: isize,
    pub dx: isize,
    /// At least 1, at most [`GROUP`].
    pub count: usize,
}

/// What distances are made of.
#[derive(Clone, Copy)]
pub(super) struct Distances<'a> {
    pub layout: &'a Layout,
    pub guide: &'a Plane,
    /// Columns of the tile.
    pub width: usize,
}

impl Distances<'_> {
    /// Sums Δ² over the columns of patches of radius `F`, for all channels and offsets of a group.
    #[inline(always)]
    pub fn down<S: Simd, const F: usize>(&self, s: S, group: &Group, to: &mut Plane) {
        for c in 0..self.layout.channels {
            let plane = c * GROUP * self.layout.sums.plane;
            if group.count == GROUP {
                self.channel::<S, F, GROUP>(s, group, c, to, plane);
            } else {
                for i in 0..group.count {
                    let alone = Group { dx: group.dx + i as isize, count: 1, ..group.clone() };
                    self.channel::<S, F, 1>(s, &alone, c, to, plane + i * self.layout.sums.plane);
                }
            }
        }
    }

    /// One channel: walks down columns of vectors, the last 2·`F` rows of distances in registers.
    #[inline(always)]
    fn channel<S: Simd, const F: usize, const N: usize>(
        &self,
        s: S,
        group: &Group,
        c: usize,
        to: &mut Plane,
        plane: usize,
    ) {
        let (guide, sums) = (&self.layout.guide, &self.layout.sums);
        let weighting = &self.layout.weighting;
        // k is above 0.
        let pair = Pair::<S> {
            planes: self.layout.planes(c),
            taken: s.splat(-1.0 / (weighting.k * weighting.k)),
            epsilon: s.splat(weighting.epsilon),
            largest: s.splat(LARGEST),
            unknown: self.layout.unknown,
        };
        let corner = guide.origin() + group.rows.start * guide.pitch - F * guide.pitch - F;
        let shift = group.dy * guide.pitch as isize + group.dx;
        let mut x = 0;
        while x < self.width + 2 * F {
            let mut window = [[s.zero(); N]; 2 * MAX_PATCH_RADIUS + 1];
            let mut here = corner + x;
            for row in window.iter_mut().take(2 * F) {
                *row = pair.at::<N>(s, self.guide, here, here.wrapping_add_signed(shift));
                here += guide.pitch;
            }
            let mut at = plane + group.rows.start * sums.pitch + x;
            for _ in group.rows.clone() {
                window[2 * F] = pair.at::<N>(s, self.guide, here, here.wrapping_add_signed(shift));
                for o in 0..N {
                    let mut sum = window[F][o];
                    for i in 1..=F {
                        sum = s.add(sum, s.add(window[F - i][o], window[F + i][o]));
                    }
                    s.store(to, at + o * sums.plane, sum);
                }
                for i in 0..2 * F {
                    window[i] = window[i + 1];
                }
                here += guide.pitch;
                at += sums.pitch;
            }
            x += S::LANES;
        }
    }

    /// Σ Δ² over the patches of a vector of pixels, of the group's offset `i` and a channel.
    #[inline(always)]
    pub fn patch<S: Simd, const F: usize>(
        &self,
        s: S,
        sums: &Plane,
        (c, i): (usize, usize),
        row: usize,
        x: usize,
    ) -> S::F {
        let grid = &self.layout.sums;
        across::<S, F>(s, &Equal, sums, (c * GROUP + i) * grid.plane + row * grid.pitch + x)
    }

    /// exp(−max(0, d²)) from Σ Δ² over patches: 2^(factor·share·sum), 0 where a penalty stands.
    #[inline(always)]
    pub fn weight<S: Simd>(
        &self,
        s: S,
        sum: S::F,
        border: &Plane,
        factor: S::F,
        dx: isize,
        x: usize,
    ) -> S::F {
        let share = s.load(border, self.layout.share(dx) + x);
        let penalty = s.load(border, self.layout.penalty(dx) + x);
        let exponent = s.min(s.mul(sum, s.mul(share, factor)), s.zero());
        s.exp2_or_zero(s.add(exponent, penalty))
    }
}

/// Two pixels in one channel.
struct Pair<S: Simd> {
    planes: [usize; 3],
    /// −1/k²: variances are stored times k².
    taken: S::F,
    epsilon: S::F,
    largest: S::F,
    /// As in [`Layout::unknown`].
    unknown: bool,
}

impl<S: Simd> Pair<S> {
    /// Δ² = ((g(p) − g(q))² − (a + min(a, b)))/(k²(a + b) + ε), at most [`LARGEST`], and that where it is NaN, but 0 where one of
    /// the two is beyond the image, whatever the other; of the pixels at `here` and their neighbours at `there`, `there + 1`, …
    #[inline(always)]
    fn at<const N: usize>(&self, s: S, guide: &Plane, here: usize, there: usize) -> [S::F; N] {
        let [value, variance, own] = self.planes;
        let g = s.load(guide, value + here);
        let a = s.load(guide, variance + here);
        let middle = s.load(guide, own + here);
        let mut out = [self.largest; N];
        for i in 0..N {
            let h = s.load_beside(guide, value + there, i);
            let b = s.load_beside(guide, variance + there, i);
            let difference = s.sub(g, h);
            let noise = s.mul(self.taken, s.add(middle, s.min(middle, b)));
            let denominator = s.add(s.add(a, b), self.epsilon);
            let distance = s.div(s.fma(difference, difference, noise), denominator);
            out[i] = s.min(distance, self.largest);
        }
        if self.unknown {
            // Infinite variances mark what is beyond the image. Of a NaN and another value `max` gives the second.
            let infinite = s.splat(f32::INFINITY);
            let outside = s.keep(s.le(infinite, a), a);
            for i in 0..N {
                let b = s.load_beside(guide, variance + there, i);
                let either = s.le(infinite, s.max(b, outside));
                out[i] = s.sub(out[i], s.keep(either, out[i]));
            }
        }
        out
    }
}
