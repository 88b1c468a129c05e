//! Distance of two pixels over their noise.

/// Largest distance of two pixels in one channel.
pub(crate) const MOST: f32 = 1e4;

/// Eq. 5 of liu2018robust with ε = 0 and k = 1, without its cut from below: (a−b)² beyond what noise explains, over the variance of
/// a difference. 0 for equal values without noise, [`MOST`] for others.
#[inline(always)]
pub(crate) fn squared((a, va): (f32, f32), (b, vb): (f32, f32), over: f32) -> f32 {
    let d = a - b;
    let least = if va < vb { va } else { vb };
    let of = (va + vb) * over;
    // Without noise the quotient is 0 or beyond any limit.
    let of = if of > f32::MIN_POSITIVE { of } else { f32::MIN_POSITIVE };
    let quotient = (d * d - (va + least)) / of;
    if quotient < MOST { quotient } else { MOST }
}
