//! The operations in 256-bit AVX2 with FMA.

use std::arch::x86_64::*;

use super::operations::{ROUND, Simd};

/// Eight lanes in a `ymm` register, truth values as all-ones or all-zeros lanes.
#[derive(Debug)]
pub(crate) struct Avx2;

macro_rules! lanewise {
    ($($name:ident($($arg:ident: $of:ty),+) -> $result:ty = $value:expr;)+) => {$(
        #[inline(always)]
        unsafe fn $name($($arg: $of),+) -> $result {
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
        splat(value: f32) -> __m256 = _mm256_set1_ps(value);
        add(a: __m256, b: __m256) -> __m256 = _mm256_add_ps(a, b);
        sub(a: __m256, b: __m256) -> __m256 = _mm256_sub_ps(a, b);
        mul(a: __m256, b: __m256) -> __m256 = _mm256_mul_ps(a, b);
        div(a: __m256, b: __m256) -> __m256 = _mm256_div_ps(a, b);
        min(a: __m256, b: __m256) -> __m256 = _mm256_min_ps(a, b);
        max(a: __m256, b: __m256) -> __m256 = _mm256_max_ps(a, b);
        fma(a: __m256, b: __m256, c: __m256) -> __m256 = _mm256_fmadd_ps(a, b, c);
        abs(a: __m256) -> __m256 = _mm256_andnot_ps(_mm256_set1_ps(-0.0), a);
        le(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_LE_OQ>(a, b);
        and_le(mask: __m256, a: __m256, b: __m256) -> __m256
            = _mm256_and_ps(mask, _mm256_cmp_ps::<_CMP_LE_OQ>(a, b));
        keep(mask: __m256, value: __m256) -> __m256 = _mm256_and_ps(mask, value);
        split(x: __m256) -> (__m256, __m256) = {
            let round = _mm256_set1_ps(ROUND);
            let n = _mm256_add_ps(x, round);
            (_mm256_sub_ps(x, _mm256_sub_ps(n, round)), n)
        };
        keep_scaled(mask: __m256, value: __m256, n: __m256) -> __m256 = {
            let shift = _mm256_slli_epi32::<23>(_mm256_castps_si256(n));
            let scaled = _mm256_add_epi32(_mm256_castps_si256(value), shift);
            _mm256_and_ps(mask, _mm256_castsi256_ps(scaled))
        };
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> __m256 {
        // SAFETY: the caller vouches for eight readable values; this load needs no alignment.
        unsafe { _mm256_loadu_ps(from) }
    }

    #[inline(always)]
    unsafe fn load_beside(from: *const f32, i: usize) -> __m256 {
        // SAFETY: the caller vouches for sixteen readable values. Moving parts of two registers into one takes more
        // instructions here than the loads that cross a cache line cost.
        unsafe { _mm256_loadu_ps(from.add(i)) }
    }

    #[inline(always)]
    unsafe fn store(to: *mut f32, value: __m256) {
        // SAFETY: the caller vouches for eight writable values; this store needs no alignment.
        unsafe { _mm256_storeu_ps(to, value) }
    }
}
