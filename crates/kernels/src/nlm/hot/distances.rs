//! Δ² of colours (rousselle2013rdfc, Sec. 4).

use super::tile::Constants;
use crate::engine::{PatchDistance, Plane, Simd};

/// Σ_c Δ²_c of the pixels of two guides.
pub(super) struct ColourDistance<'a> {
    /// Values, then variances.
    pub here: &'a Plane,
    pub there: &'a Plane,
    pub channels: usize,
    /// Values between planes.
    pub plane: usize,
    pub constants: Constants,
}

impl<S: Simd> PatchDistance<S> for ColourDistance<'_> {
    #[inline(always)]
    fn at<const N: usize>(&self, s: S, here: usize, there: usize) -> [S::F; N] {
        let mut out = [s.zero(); N];
        for c in 0..self.channels {
            let (value, variance) = (c * self.plane, (self.channels + c) * self.plane);
            let p = s.load(self.here, value + here);
            let vp = s.load(self.here, variance + here);
            let base = base(s, vp, &self.constants);
            for o in 0..N {
                let q = s.load(self.there, value + there + o);
                let vq = s.load(self.there, variance + there + o);
                out[o] = s.add(out[o], square(s, s.sub(p, q), vp, vq, base, &self.constants));
            }
        }
        out
    }
}

/// The first pixel's part of a pair's denominator, ε included: at least ε.
#[inline(always)]
pub(super) fn base<S: Simd>(s: S, vp: S::F, constants: &Constants) -> S::F {
    // Factors of 0 and 1 round nothing.
    s.fma(vp, s.splat(constants.first_again), s.add(vp, s.splat(constants.epsilon)))
}

/// Δ² of a difference; `base` is that of the pair's first pixel.
#[inline(always)]
fn square<S: Simd>(s: S, d: S::F, vp: S::F, vq: S::F, base: S::F, constants: &Constants) -> S::F {
    let noise = s.add(vp, s.min(vp, vq));
    let numerator = s.fma(s.splat(constants.cancellation), noise, s.mul(d, d));
    // At least ε.
    let denominator = s.fma(vq, s.splat(constants.second), base);
    s.min(s.div(numerator, denominator), s.splat(constants.largest))
}
