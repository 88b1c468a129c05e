//! The operations in 256-bit AVX2 with FMA.

use std::arch::x86_64::*;

use super::Simd;

/// Eight lanes in a `ymm` register.
#[derive(Debug)]
pub(crate) struct Avx2;

macro_rules! lanewise {
    ($($name:ident($($arg:ident),+) = $value:expr;)+) => {$(
        #[inline(always)]
        unsafe fn $name($($arg: __m256),+) -> __m256 {
            // SAFETY: the caller vouches for AVX2 and FMA, and nothing here touches memory.
            unsafe { $value }
        }
    )+};
}

impl Simd for Avx2 {
    const LANES: usize = 8;
    type F = __m256;
    type M = __m256;

    lanewise! {
        add(a, b) = _mm256_add_ps(a, b);
        sub(a, b) = _mm256_sub_ps(a, b);
        mul(a, b) = _mm256_mul_ps(a, b);
        fma(a, b, c) = _mm256_fmadd_ps(a, b, c);
        abs(a) = _mm256_andnot_ps(_mm256_set1_ps(-0.0), a);
        le(a, b) = _mm256_cmp_ps::<_CMP_LE_OQ>(a, b);
        and_le(mask, a, b) = _mm256_and_ps(mask, _mm256_cmp_ps::<_CMP_LE_OQ>(a, b));
        keep(mask, value) = _mm256_and_ps(mask, value);
        shift_exponent(value, exponent) = _mm256_castsi256_ps(_mm256_add_epi32(
            _mm256_castps_si256(value),
            _mm256_slli_epi32::<23>(_mm256_castps_si256(exponent)),
        ));
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> __m256 {
        // SAFETY: the caller vouches for eight readable values; this load needs no alignment.
        unsafe { _mm256_loadu_ps(from) }
    }

    #[inline(always)]
    unsafe fn store(to: *mut f32, value: __m256) {
        // SAFETY: the caller vouches for eight writable values; this store needs no alignment.
        unsafe { _mm256_storeu_ps(to, value) }
    }

    #[inline(always)]
    unsafe fn splat(value: f32) -> __m256 {
        // SAFETY: the caller vouches for AVX2.
        unsafe { _mm256_set1_ps(value) }
    }
}
