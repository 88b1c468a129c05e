//! Squared differences of the guide (moon2013flash, Sec. 3.2).

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
