//! The operations over an array of eight values, in plain Rust.

use super::Simd;

/// Eight lanes that the compiler maps to whatever the target has.
#[derive(Debug)]
pub(crate) struct Portable;

const LANES: usize = 8;

macro_rules! lanewise {
    ($($name:ident($($arg:ident),+) = $value:expr;)+) => {$(
        #[inline(always)]
        unsafe fn $name($($arg: [f32; LANES]),+) -> [f32; LANES] {
            let mut out = [0.0; LANES];
            for i in 0..LANES {
                $(let $arg = $arg[i];)+
                out[i] = $value;
            }
            out
        }
    )+};
}

impl Simd for Portable {
    const LANES: usize = LANES;
    type F = [f32; LANES];
    type M = [bool; LANES];

    lanewise! {
        add(a, b) = a + b;
        sub(a, b) = a - b;
        mul(a, b) = a * b;
        fma(a, b, c) = a.mul_add(b, c);
        abs(a) = a.abs();
        shift_exponent(value, exponent) = f32::from_bits(value.to_bits().wrapping_add(exponent.to_bits() << 23));
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self::F {
        // SAFETY: the caller vouches for LANES readable values; an array of f32 needs no more alignment than one.
        unsafe { from.cast::<Self::F>().read() }
    }

    #[inline(always)]
    unsafe fn store(to: *mut f32, value: Self::F) {
        // SAFETY: as in `load`, writable.
        unsafe { to.cast::<Self::F>().write(value) }
    }

    #[inline(always)]
    unsafe fn splat(value: f32) -> Self::F {
        [value; LANES]
    }

    #[inline(always)]
    unsafe fn le(a: Self::F, b: Self::F) -> Self::M {
        let mut out = [false; LANES];
        for i in 0..LANES {
            out[i] = a[i] <= b[i];
        }
        out
    }

    #[inline(always)]
    unsafe fn and_le(mask: Self::M, a: Self::F, b: Self::F) -> Self::M {
        let mut out = [false; LANES];
        for i in 0..LANES {
            out[i] = mask[i] & (a[i] <= b[i]);
        }
        out
    }

    #[inline(always)]
    unsafe fn keep(mask: Self::M, value: Self::F) -> Self::F {
        let mut out = [0.0; LANES];
        for i in 0..LANES {
            out[i] = if mask[i] { value[i] } else { 0.0 };
        }
        out
    }
}
