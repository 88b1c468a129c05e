//! The operations in 512-bit AVX-512F and AVX-512DQ.

use std::arch::x86_64::*;

use super::{InstructionSet, Plane, Simd};

/// Sixteen lanes in a `zmm` register, truth values in a mask register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(());

impl Avx512 {
    /// The token, where the processor has the instruction set.
    pub fn new() -> Option<Self> {
        InstructionSet::Avx512.is_available().then_some(Self(()))
    }
}

macro_rules! operations {
    ($($name:ident($($arg:ident: $of:ty),+) $(-> $result:ty)? = $value:expr;)+) => {$(
        #[inline(always)]
        fn $name(self, $($arg: $of),+) $(-> $result)? {
            // SAFETY: a token exists, so the processor has AVX-512F and AVX-512DQ; planes are vouched for by who made them,
            // and these loads and stores need no alignment.
            unsafe { $value }
        }
    )+};
}

impl Simd for Avx512 {
    const LANES: usize = 16;
    type F = __m512;
    type M = __mmask16;
    const DOUBLES: usize = 8;
    type D = __m512d;

    operations! {
        load(plane: &Plane, at: usize) -> __m512 = _mm512_loadu_ps(plane.from(at, 16));
        // Taken out of the two aligned vectors that hold it: every load of this size that is not aligned crosses a cache
        // line and counts twice.
        load_beside(plane: &Plane, at: usize, i: usize) -> __m512 = {
            let from = plane.from(at, 32);
            let low = _mm512_castps_si512(_mm512_loadu_ps(from));
            let high = _mm512_castps_si512(_mm512_loadu_ps(from.wrapping_add(16)));
            // `i` is a constant after inlining: one arm remains.
            _mm512_castsi512_ps(match i {
                0 => low,
                1 => _mm512_alignr_epi32::<1>(high, low),
                2 => _mm512_alignr_epi32::<2>(high, low),
                3 => _mm512_alignr_epi32::<3>(high, low),
                4 => _mm512_alignr_epi32::<4>(high, low),
                5 => _mm512_alignr_epi32::<5>(high, low),
                _ => _mm512_alignr_epi32::<6>(high, low),
            })
        };
        store(plane: &mut Plane, at: usize, value: __m512) = _mm512_storeu_ps(plane.to(at, 16), value);
        splat(value: f32) -> __m512 = _mm512_set1_ps(value);
        add(a: __m512, b: __m512) -> __m512 = _mm512_add_ps(a, b);
        sub(a: __m512, b: __m512) -> __m512 = _mm512_sub_ps(a, b);
        mul(a: __m512, b: __m512) -> __m512 = _mm512_mul_ps(a, b);
        div(a: __m512, b: __m512) -> __m512 = _mm512_div_ps(a, b);
        min(a: __m512, b: __m512) -> __m512 = _mm512_min_ps(a, b);
        max(a: __m512, b: __m512) -> __m512 = _mm512_max_ps(a, b);
        fma(a: __m512, b: __m512, c: __m512) -> __m512 = _mm512_fmadd_ps(a, b, c);
        abs(a: __m512) -> __m512 = _mm512_abs_ps(a);
        le(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b);
        and_le(mask: __mmask16, a: __m512, b: __m512) -> __mmask16
            = _mm512_mask_cmp_ps_mask::<_CMP_LE_OQ>(mask, a, b);
        keep(mask: __mmask16, value: __m512) -> __m512 = _mm512_maskz_mov_ps(mask, value);
        split(x: __m512) -> (__m512, __m512) = {
            // What is left after rounding to the nearest integer: exact, and so is the integer.
            let f = _mm512_reduce_ps::<0>(x);
            (f, _mm512_sub_ps(x, f))
        };
        keep_scaled(mask: __mmask16, value: __m512, n: __m512) -> __m512
            = _mm512_maskz_scalef_ps(mask, value, n);
        load_doubles(plane: &Plane<f64>, at: usize) -> __m512d = _mm512_loadu_pd(plane.from(at, 8));
        load_widened(plane: &Plane, at: usize) -> __m512d = _mm512_cvtps_pd(_mm256_loadu_ps(plane.from(at, 8)));
        store_doubles(plane: &mut Plane<f64>, at: usize, value: __m512d) = _mm512_storeu_pd(plane.to(at, 8), value);
        splat_double(value: f64) -> __m512d = _mm512_set1_pd(value);
        add_doubles(a: __m512d, b: __m512d) -> __m512d = _mm512_add_pd(a, b);
        sub_doubles(a: __m512d, b: __m512d) -> __m512d = _mm512_sub_pd(a, b);
        mul_doubles(a: __m512d, b: __m512d) -> __m512d = _mm512_mul_pd(a, b);
        fma_doubles(a: __m512d, b: __m512d, c: __m512d) -> __m512d = _mm512_fmadd_pd(a, b, c);
        any_double(a: __m512d) -> bool = _mm512_cmp_pd_mask::<_CMP_NEQ_UQ>(a, _mm512_setzero_pd()) != 0;
    }
}
