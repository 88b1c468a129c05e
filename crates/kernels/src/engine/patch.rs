//! Sums over patches: first down the columns, the last rows of distances in registers, then across.

#![expect(clippy::needless_range_loop, reason = "fixed counts, unrolled; iterators may end up as calls")]

use super::{Block, Grid, Plane, Simd};

/// Largest patch radius of any kernel.
const MAX_RADIUS: usize = 3;

/// What is summed over the taps of a patch.
pub(crate) trait PatchDistance<S: Simd> {
    /// Distances of the pixels at `here` and their neighbours at `there`, `there + 1`, …
    fn at<const N: usize>(&self, s: S, here: usize, there: usize) -> [S::F; N];
}

/// Weights of a patch's taps relative to the middle one, in rows as in columns.
pub(crate) trait Taps<S: Simd> {
    /// `sum` and the pair of taps at distance `i` of the middle.
    fn add(&self, s: S, i: usize, pair: S::F, sum: S::F) -> S::F;
}

/// All taps alike.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equal;

impl<S: Simd> Taps<S> for Equal {
    #[inline(always)]
    fn add(&self, s: S, _: usize, pair: S::F, sum: S::F) -> S::F {
        s.add(sum, pair)
    }
}

/// g(i)/g(0).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weighted(pub [f32; MAX_RADIUS + 1]);

impl<S: Simd> Taps<S> for Weighted {
    #[inline(always)]
    fn add(&self, s: S, i: usize, pair: S::F, sum: S::F) -> S::F {
        s.fma(s.splat(self.0[i]), pair, sum)
    }
}

/// Where vertical sums come from and go to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns {
    /// Planes of what is compared.
    pub guide: Grid,
    /// Planes of the sums, one for each offset of a block: the tile and the patch radius on both sides.
    pub sums: Grid,
    /// Values between the planes of one radius and those of the smaller one.
    pub radii: usize,
    /// Valid columns of the tile.
    pub width: usize,
}

impl Columns {
    /// Vertical sums of the block's first `offsets` offsets for radius `BIG`, and for `SMALL` if that is another.
    #[inline(always)]
    pub fn sum<S: Simd, const BIG: usize, const SMALL: usize>(
        self,
        s: S,
        (distance, taps): (&impl PatchDistance<S>, &impl Taps<S>),
        to: &mut Plane,
        block: &Block,
        offsets: usize,
    ) {
        let mut first = 0;
        while first + 2 <= offsets {
            self.some::<S, BIG, SMALL, 2>(s, (distance, taps), to, block, first);
            first += 2;
        }
        if first < offsets {
            self.some::<S, BIG, SMALL, 1>(s, (distance, taps), to, block, first);
        }
    }

    /// [`Columns::sum`] of offsets `first..first + N`.
    ///
    /// Walks down columns of vectors, the last 2·`BIG` rows of distances in registers.
    #[inline(always)]
    fn some<S: Simd, const BIG: usize, const SMALL: usize, const N: usize>(
        self,
        s: S,
        (distance, taps): (&impl PatchDistance<S>, &impl Taps<S>),
        planes: &mut Plane,
        block: &Block,
        first: usize,
    ) {
        let (guide, sums) = (self.guide, self.sums);
        // The patch area's first vector: `BIG` rows above and columns left of the tile.
        let corner = guide.origin() + block.rows.start * guide.pitch - BIG * guide.pitch - BIG;
        let shift = block.dy * guide.pitch as isize + block.dx + first as isize;
        let mut x = 0;
        while x < self.width + 2 * BIG {
            let mut window = [[s.zero(); N]; 2 * MAX_RADIUS + 1];
            let mut here = corner + x;
            for row in window.iter_mut().take(2 * BIG) {
                *row = distance.at::<N>(s, here, here.wrapping_add_signed(shift));
                here += guide.pitch;
            }
            let mut to = first * sums.plane + block.rows.start * sums.pitch + x;
            for _ in block.rows.clone() {
                window[2 * BIG] = distance.at::<N>(s, here, here.wrapping_add_signed(shift));
                for o in 0..N {
                    let mut sum = window[BIG][o];
                    for i in 1..=BIG {
                        if SMALL < BIG && i == SMALL + 1 {
                            s.store(planes, to + self.radii + o * sums.plane, sum);
                        }
                        sum = taps.add(s, i, s.add(window[BIG - i][o], window[BIG + i][o]), sum);
                    }
                    s.store(planes, to + o * sums.plane, sum);
                }
                for i in 0..2 * BIG {
                    window[i] = window[i + 1];
                }
                here += guide.pitch;
                to += sums.pitch;
            }
            x += S::LANES;
        }
    }
}

/// Horizontal sum of radius `PATCH` around `from + PATCH`, from the vertical sums: two vectors from `from` on are read.
#[inline(always)]
pub(crate) fn across<S: Simd, const PATCH: usize>(
    s: S,
    taps: &impl Taps<S>,
    sums: &Plane,
    from: usize,
) -> S::F {
    let mut sum = s.load_beside(sums, from, PATCH);
    for i in 1..=PATCH {
        let pair = s.add(s.load_beside(sums, from, PATCH - i), s.load_beside(sums, from, PATCH + i));
        sum = taps.add(s, i, pair, sum);
    }
    sum
}
