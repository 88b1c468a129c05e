//! The operations in 512-bit AVX-512F.

use std::arch::x86_64::*;

use super::Simd;

/// Sixteen lanes in a `zmm` register, truth values in a mask register.
#[derive(Debug)]
pub(crate) struct Avx512;

macro_rules! lanewise {
    ($($name:ident($($arg:ident: $of:ty),+) -> $result:ty = $value:expr;)+) => {$(
        #[inline(always)]
        unsafe fn $name($($arg: $of),+) -> $result {
            // SAFETY: the caller vouches for AVX-512F, and nothing here touches memory.
            unsafe { $value }
        }
    )+};
}

impl Simd for Avx512 {
    const LANES: usize = 16;
    type F = __m512;
    type M = __mmask16;

    lanewise! {
        splat(value: f32) -> __m512 = _mm512_set1_ps(value);
        add(a: __m512, b: __m512) -> __m512 = _mm512_add_ps(a, b);
        sub(a: __m512, b: __m512) -> __m512 = _mm512_sub_ps(a, b);
        mul(a: __m512, b: __m512) -> __m512 = _mm512_mul_ps(a, b);
        fma(a: __m512, b: __m512, c: __m512) -> __m512 = _mm512_fmadd_ps(a, b, c);
        abs(a: __m512) -> __m512 = _mm512_abs_ps(a);
        le(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b);
        and_le(mask: __mmask16, a: __m512, b: __m512) -> __mmask16
            = _mm512_mask_cmp_ps_mask::<_CMP_LE_OQ>(mask, a, b);
        keep(mask: __mmask16, value: __m512) -> __m512 = _mm512_maskz_mov_ps(mask, value);
        shift_exponent(value: __m512, exponent: __m512) -> __m512 = _mm512_castsi512_ps(_mm512_add_epi32(
            _mm512_castps_si512(value),
            _mm512_slli_epi32::<23>(_mm512_castps_si512(exponent)),
        ));
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> __m512 {
        // SAFETY: the caller vouches for sixteen readable values; this load needs no alignment.
        unsafe { _mm512_loadu_ps(from) }
    }

    #[inline(always)]
    unsafe fn store(to: *mut f32, value: __m512) {
        // SAFETY: the caller vouches for sixteen writable values; this store needs no alignment.
        unsafe { _mm512_storeu_ps(to, value) }
    }
}
