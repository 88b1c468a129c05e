//! The few vector operations that the kernels are written in, for each instruction set.
//!
//! Every operation works lane by lane and rounds as IEEE 754 says, so a kernel written in them gives the same bits
//! whatever the number of lanes. All of it is `#[inline(always)]`: a kernel body only becomes 512-bit code by
//! being inlined whole into a function that enables those instructions.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub(crate) use avx512::Avx512;
pub(crate) use portable::Portable;

/// Lanes of the widest instruction set. Buffers are padded to this.
pub(crate) const MAX_LANES: usize = 16;

/// Vector operations of one instruction set.
///
/// # Safety
/// Every method may only run where the processor has the instruction set. `load` and `store` also need `LANES`
/// readable or writable values at the pointer; no alignment is needed.
pub(crate) trait Simd {
    /// Values per vector; divides [`MAX_LANES`].
    const LANES: usize;
    /// A vector of `f32`.
    type F: Copy;
    /// One truth value per lane.
    type M: Copy;

    unsafe fn load(from: *const f32) -> Self::F;
    unsafe fn store(to: *mut f32, value: Self::F);
    unsafe fn splat(value: f32) -> Self::F;
    unsafe fn add(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn sub(a: Self::F, b: Self::F) -> Self::F;
    unsafe fn mul(a: Self::F, b: Self::F) -> Self::F;
    /// a·b + c, rounded once.
    unsafe fn fma(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    unsafe fn abs(a: Self::F) -> Self::F;
    /// a ≤ b; false if either is NaN.
    unsafe fn le(a: Self::F, b: Self::F) -> Self::M;
    /// mask and a ≤ b.
    unsafe fn and_le(mask: Self::M, a: Self::F, b: Self::F) -> Self::M;
    /// The value where the mask holds, +0 elsewhere.
    unsafe fn keep(mask: Self::M, value: Self::F) -> Self::F;
    /// Adds the low 9 bits of `exponent`, as a signed number, to the binary exponent of `value`.
    unsafe fn shift_exponent(value: Self::F, exponent: Self::F) -> Self::F;

    /// 2^x for −126 ≤ x ≤ 127 to 2e-7 relative, and 2^0 = 1 exactly. Any other x, NaN included, gives some value.
    #[inline(always)]
    unsafe fn exp2(x: Self::F) -> Self::F {
        // Adding 1.5·2^23 leaves the nearest integer in the low bits of the mantissa.
        const ROUND: f32 = 12_582_912.0;
        // Minimax polynomial of 2^f on [-1/2, 1/2], constant term 1.
        const C: [f32; 6] = [1.0, 0.693_146_97, 0.240_221_2, 0.055_507_133, 0.009_675_542, 0.001_327_647_2];
        // SAFETY: the caller vouches for the instruction set.
        unsafe {
            let round = Self::splat(ROUND);
            let shifted = Self::add(x, round);
            let f = Self::sub(x, Self::sub(shifted, round));
            let mut y = Self::splat(C[5]);
            y = Self::fma(y, f, Self::splat(C[4]));
            y = Self::fma(y, f, Self::splat(C[3]));
            y = Self::fma(y, f, Self::splat(C[2]));
            y = Self::fma(y, f, Self::splat(C[1]));
            y = Self::fma(y, f, Self::splat(C[0]));
            Self::shift_exponent(y, shifted)
        }
    }
}
