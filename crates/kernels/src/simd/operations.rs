//! What every instruction set gives.

/// Lanes of the widest instruction set. Buffers are padded to this.
pub(crate) const MAX_LANES: usize = 16;

/// Adding this to a value of less than 2^21 leaves the nearest integer in the low bits of the mantissa.
pub(super) const ROUND: f32 = 12_582_912.0;

/// Minimax polynomial of 2^f on [-1/2, 1/2], constant term 1, from the highest power down.
const EXP2: [f32; 6] = [0.001_327_647_2, 0.009_675_542, 0.055_507_133, 0.240_221_2, 0.693_146_97, 1.0];

/// Vector operations of one instruction set.
///
/// # Safety
/// Every method may only run where the processor has the instruction set. `load` and `store` also need `LANES`
/// readable or writable values at the pointer, `load_beside` twice as many; no alignment is needed.
pub(crate) trait Simd {
    /// Values per vector; divides [`MAX_LANES`].
    const LANES: usize;
    /// A vector of `f32`.
    type F: Copy;
    /// One truth value per lane.
    type M: Copy;

    unsafe fn load(from: *const f32) -> Self::F;
    /// Loads from `from + i`, 0 ≤ `i` ≤ 6. Several such loads with one `from` may share what they read.
    unsafe fn load_beside(from: *const f32, i: usize) -> Self::F;
    unsafe fn store(to: *mut f32, value: Self::F);
    unsafe fn splat(value: f32) -> Self::F;
    unsafe fn add(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn sub(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn mul(a: Self::F, b: Self::F) -> Self::F;
    /// a / b, rounded correctly.
    unsafe fn div(a: Self::F, b: Self::F) -> Self::F;
    /// a if a < b, else b; so b if either is NaN.
    unsafe fn min(a: Self::F, b: Self::F) -> Self::F;
    /// a if a > b, else b; so b if either is NaN.
    unsafe fn max(a: Self::F, b: Self::F) -> Self::F;
    /// a·b + c, rounded once.
    unsafe fn fma(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    unsafe fn abs(a: Self::F) -> Self::F;
    /// a ≤ b; false if either is NaN.
    unsafe fn le(a: Self::F, b: Self::F) -> Self::M;
    /// mask and a ≤ b.
    unsafe fn and_le(mask: Self::M, a: Self::F, b: Self::F) -> Self::M;
    /// The value where the mask holds, +0 elsewhere.
    unsafe fn keep(mask: Self::M, value: Self::F) -> Self::F;
    /// x − n and n, with n the integer nearest to x, ties to even. n is in a form that only `keep_scaled` reads.
    /// For |x| ≥ 2^21 or NaN some value.
    unsafe fn split(x: Self::F) -> (Self::F, Self::F);
    /// value·2^n, with n as `split` gave it, where the mask holds; +0 elsewhere. The product must be a normal number
    /// where the mask holds.
    unsafe fn keep_scaled(mask: Self::M, value: Self::F, n: Self::F) -> Self::F;

    /// 2^x to 2e-7 relative, and 2^0 = 1 exactly, as two factors for `keep_scaled`. −126 ≤ x ≤ 126 where it is kept.
    #[inline(always)]
    unsafe fn exp2(x: Self::F) -> (Self::F, Self::F) {
        // SAFETY: the caller vouches for the instruction set.
        unsafe {
            let (f, n) = Self::split(x);
            let mut y = Self::splat(EXP2[0]);
            y = Self::fma(y, f, Self::splat(EXP2[1]));
            y = Self::fma(y, f, Self::splat(EXP2[2]));
            y = Self::fma(y, f, Self::splat(EXP2[3]));
            y = Self::fma(y, f, Self::splat(EXP2[4]));
            y = Self::fma(y, f, Self::splat(EXP2[5]));
            (y, n)
        }
    }
}
