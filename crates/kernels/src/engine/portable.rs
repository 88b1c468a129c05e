//! The operations over an array of eight values, in plain Rust.

use super::simd::ROUND;
use super::{Plane, Simd};

/// Eight lanes that the compiler maps to whatever the target has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

const LANES: usize = 8;

macro_rules! lanewise {
    ($($name:ident($($arg:ident: $of:ty),+) -> $result:ty = $value:expr;)+) => {$(
        #[inline(always)]
        fn $name(self, $($arg: [$of; LANES]),+) -> [$result; LANES] {
            let mut out = [<$result>::default(); LANES];
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
        add(a: f32, b: f32) -> f32 = a + b;
        sub(a: f32, b: f32) -> f32 = a - b;
        mul(a: f32, b: f32) -> f32 = a * b;
        div(a: f32, b: f32) -> f32 = a / b;
        min(a: f32, b: f32) -> f32 = if a < b { a } else { b };
        max(a: f32, b: f32) -> f32 = if a > b { a } else { b };
        fma(a: f32, b: f32, c: f32) -> f32 = a.mul_add(b, c);
        abs(a: f32) -> f32 = a.abs();
        le(a: f32, b: f32) -> bool = a <= b;
        and_le(mask: bool, a: f32, b: f32) -> bool = mask & (a <= b);
        keep(mask: bool, value: f32) -> f32 = if mask { value } else { 0.0 };
        keep_scaled(mask: bool, value: f32, n: f32) -> f32 =
            if mask { f32::from_bits(value.to_bits().wrapping_add(n.to_bits() << 23)) } else { 0.0 };
    }

    #[inline(always)]
    fn split(self, x: Self::F) -> (Self::F, Self::F) {
        let (mut f, mut n) = (x, x);
        for i in 0..LANES {
            n[i] = x[i] + ROUND;
            f[i] = x[i] - (n[i] - ROUND);
        }
        (f, n)
    }

    #[inline(always)]
    fn splat(self, value: f32) -> Self::F {
        [value; LANES]
    }

    #[inline(always)]
    fn load(self, plane: &Plane, at: usize) -> Self::F {
        // SAFETY: the plane is vouched for; an array of f32 needs no more alignment than one.
        unsafe { plane.from(at, LANES).cast::<Self::F>().read() }
    }

    #[inline(always)]
    fn load_beside(self, plane: &Plane, at: usize, i: usize) -> Self::F {
        self.load(plane, at + i)
    }

    #[inline(always)]
    fn store(self, plane: &mut Plane, at: usize, value: Self::F) {
        // SAFETY: as in `load`, writable.
        unsafe { plane.to(at, LANES).cast::<Self::F>().write(value) }
    }
}
