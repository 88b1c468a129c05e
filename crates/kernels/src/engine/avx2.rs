//! The operations in 256-bit AVX2 with FMA.

use std::arch::x86_64::*;

use super::simd::ROUND;
use super::{InstructionSet, Plane, Simd};

/// Eight lanes in a `ymm` register, truth values as all-ones or all-zeros lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Avx2 {
    /// The token, where the processor has the instruction set.
    pub fn new() -> Option<Self> {
        InstructionSet::Avx2.is_available().then_some(Self(()))
    }
}

macro_rules! operations {
    ($($name:ident($($arg:ident: $of:ty),+) $(-> $result:ty)? = $value:expr;)+) => {$(
        #[inline(always)]
        fn $name(self, $($arg: $of),+) $(-> $result)? {
            // SAFETY: a token exists, so the processor has AVX2 and FMA; planes are vouched for by who made them, and these
            // loads and stores need no alignment.
            unsafe { $value }
        }
    )+};
}

impl Simd for Avx2 {
    const LANES: usize = 8;
    type F = __m256;
    type M = __m256;
    const DOUBLES: usize = 4;
    type D = __m256d;

    operations! {
        load(plane: &Plane, at: usize) -> __m256 = _mm256_loadu_ps(plane.from(at, 8));
        // Moving parts of two registers into one takes more instructions here than the loads that cross a cache line cost.
        load_beside(plane: &Plane, at: usize, i: usize) -> __m256 = _mm256_loadu_ps(plane.from(at + i, 8));
        store(plane: &mut Plane, at: usize, value: __m256) = _mm256_storeu_ps(plane.to(at, 8), value);
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
        load_doubles(plane: &Plane<f64>, at: usize) -> __m256d = _mm256_loadu_pd(plane.from(at, 4));
        load_widened(plane: &Plane, at: usize) -> __m256d = _mm256_cvtps_pd(_mm_loadu_ps(plane.from(at, 4)));
        store_doubles(plane: &mut Plane<f64>, at: usize, value: __m256d) = _mm256_storeu_pd(plane.to(at, 4), value);
        splat_double(value: f64) -> __m256d = _mm256_set1_pd(value);
        add_doubles(a: __m256d, b: __m256d) -> __m256d = _mm256_add_pd(a, b);
        sub_doubles(a: __m256d, b: __m256d) -> __m256d = _mm256_sub_pd(a, b);
        mul_doubles(a: __m256d, b: __m256d) -> __m256d = _mm256_mul_pd(a, b);
        fma_doubles(a: __m256d, b: __m256d, c: __m256d) -> __m256d = _mm256_fmadd_pd(a, b, c);
        any_double(a: __m256d) -> bool
            = _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_NEQ_UQ>(a, _mm256_setzero_pd())) != 0;
    }
}
