//! What every instruction set gives.

use super::Plane;

/// Lanes of the widest instruction set. Buffers are padded to this.
pub(crate) const MAX_LANES: usize = 16;

/// Adding this to a value of less than 2^21 leaves the nearest integer in the low bits of the mantissa.
pub(crate) const ROUND: f32 = 12_582_912.0;

/// Minimax polynomial of 2^f on [-1/2, 1/2], constant term 1, from the highest power down.
pub(crate) const EXP2: [f32; 6] =
    [0.001_327_647_2, 0.009_675_542, 0.055_507_133, 0.240_221_2, 0.693_146_97, 1.0];

/// Least exponent whose power of 2 is a normal number.
pub(crate) const LEAST_EXPONENT: f32 = -126.0;

/// Vector operations of one instruction set. A value of this type exists only where the processor has it.
pub(crate) trait Simd: Copy {
    /// Values per vector; divides [`MAX_LANES`].
    const LANES: usize;
    /// A vector of `f32`.
    type F: Copy;
    /// One truth value per lane.
    type M: Copy;
    /// Values per vector of doubles; divides [`MAX_LANES`].
    const DOUBLES: usize;
    /// A vector of `f64`.
    type D: Copy;

    /// The vector that starts at `at` of a plane; no alignment is needed.
    fn load(self, plane: &Plane, at: usize) -> Self::F;
    /// The vector that starts `i` values after `at`, 0 ≤ `i` ≤ 6. Several with one `at` may share what they read: two
    /// vectors from `at` on.
    fn load_beside(self, plane: &Plane, at: usize, i: usize) -> Self::F;
    /// Writes the vector that starts at `at`; no alignment is needed.
    fn store(self, plane: &mut Plane, at: usize, value: Self::F);
    fn splat(self, value: f32) -> Self::F;
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    /// a / b, rounded correctly.
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    /// a if a < b, else b; so b if either is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// a if a > b, else b; so b if either is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// a·b + c, rounded once.
    fn fma(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    fn abs(self, a: Self::F) -> Self::F;
    /// a ≤ b; false if either is NaN.
    fn le(self, a: Self::F, b: Self::F) -> Self::M;
    /// mask and a ≤ b.
    fn and_le(self, mask: Self::M, a: Self::F, b: Self::F) -> Self::M;
    /// The value where the mask holds, +0 elsewhere.
    fn keep(self, mask: Self::M, value: Self::F) -> Self::F;
    /// x − n and n, with n the integer nearest to x, ties to even. n is in a form that only `keep_scaled` reads.
    /// For |x| ≥ 2^21 or NaN some value.
    fn split(self, x: Self::F) -> (Self::F, Self::F);
    /// value·2^n, with n as `split` gave it, where the mask holds; +0 elsewhere. The product must be a normal number
    /// where the mask holds.
    fn keep_scaled(self, mask: Self::M, value: Self::F, n: Self::F) -> Self::F;

    /// The vector of doubles that starts at `at`; no alignment is needed.
    fn load_doubles(self, plane: &Plane<f64>, at: usize) -> Self::D;
    /// As many single values as there are doubles in a vector, from `at` on, as doubles.
    fn load_widened(self, plane: &Plane, at: usize) -> Self::D;
    /// Writes the vector of doubles that starts at `at`; no alignment is needed.
    fn store_doubles(self, plane: &mut Plane<f64>, at: usize, value: Self::D);
    fn splat_double(self, value: f64) -> Self::D;
    fn add_doubles(self, a: Self::D, b: Self::D) -> Self::D;
    fn sub_doubles(self, a: Self::D, b: Self::D) -> Self::D;
    fn mul_doubles(self, a: Self::D, b: Self::D) -> Self::D;
    /// a·b + c, rounded once.
    fn fma_doubles(self, a: Self::D, b: Self::D, c: Self::D) -> Self::D;
    /// Whether some lane is other than 0.
    fn any_double(self, a: Self::D) -> bool;

    /// +0 in every lane.
    #[inline(always)]
    fn zero(self) -> Self::F {
        self.splat(0.0)
    }

    /// Where 2^x is a normal number; false for NaN.
    #[inline(always)]
    fn normal_power(self, x: Self::F) -> Self::M {
        self.le(self.splat(LEAST_EXPONENT), x)
    }

    /// 2^x to 2e-7 relative, and 2^0 = 1 exactly, as two factors for `keep_scaled`. −126 ≤ x ≤ 126 where it is kept.
    #[inline(always)]
    fn exp2_factors(self, x: Self::F) -> (Self::F, Self::F) {
        let (f, n) = self.split(x);
        let mut y = self.splat(EXP2[0]);
        y = self.fma(y, f, self.splat(EXP2[1]));
        y = self.fma(y, f, self.splat(EXP2[2]));
        y = self.fma(y, f, self.splat(EXP2[3]));
        y = self.fma(y, f, self.splat(EXP2[4]));
        y = self.fma(y, f, self.splat(EXP2[5]));
        (y, n)
    }

    /// 2^x for x ≤ 126, 0 below the range of normal numbers and for NaN.
    #[inline(always)]
    fn exp2_or_zero(self, x: Self::F) -> Self::F {
        let (value, n) = self.exp2_factors(x);
        self.keep_scaled(self.normal_power(x), value, n)
    }
}
