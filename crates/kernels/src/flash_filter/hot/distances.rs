//! Squared differences of the guide (moon2013flash, Sec. 3.2; those of cubes, Sec. 4).

use super::tile::GuidePair;
use crate::engine::{PatchDistance, Plane, Simd};

/// Σ_c (F_c(p) − F_c(p + offset))².
pub(super) struct GuideDistance<'a> {
    pub guide: &'a Plane,
    /// Values between planes.
    pub plane: usize,
}

impl<S: Simd> PatchDistance<S> for GuideDistance<'_> {
    #[inline(always)]
    fn at<const N: usize>(&self, s: S, here: usize, there: usize) -> [S::F; N] {
        let mut out = [s.zero(); N];
        for c in 0..3 {
            let p = s.load(self.guide, c * self.plane + here);
            for (o, square) in out.iter_mut().enumerate() {
                let d = s.sub(p, s.load(self.guide, c * self.plane + there + o));
                *square = if c == 0 { s.mul(d, d) } else { s.fma(d, d, *square) };
            }
        }
        out
    }
}

/// The same over the frames of two cubes: Σ_k weight(k)·Σ_c (F_c,k(p) − F_c,t+k(p + offset))². One sum over the frames before those
/// over columns and rows, as all are linear.
pub(super) struct CubeDistance<'a> {
    pub guide: &'a Plane,
    /// Values between planes.
    pub plane: usize,
    pub pairs: &'a [GuidePair],
}

impl<S: Simd> PatchDistance<S> for CubeDistance<'_> {
    #[inline(always)]
    fn at<const N: usize>(&self, s: S, here: usize, there: usize) -> [S::F; N] {
        let mut out = [s.zero(); N];
        for pair in self.pairs {
            let (here, there) = (pair.here.wrapping_add(here), pair.there.wrapping_add(there));
            let flat = GuideDistance { guide: self.guide, plane: self.plane };
            let squares: [S::F; N] = flat.at(s, here, there);
            for (sum, square) in out.iter_mut().zip(squares) {
                *sum = s.fma(s.splat(pair.weight), square, *sum);
            }
        }
        out
    }
}
