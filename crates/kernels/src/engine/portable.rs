//! The operations over an array of eight values, in plain Rust.

use super::simd::ROUND;
use super::{Plane, Simd};

/// Eight lanes that the compiler maps to whatever the target has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

const LANES: usize = 8;
/// Lanes of a vector of doubles.
const DOUBLES: usize = 4;

macro_rules! lanewise {
    ($lanes:ident: $($name:ident($($arg:ident: $of:ty),+) -> $result:ty = $value:expr;)+) => {$(
        #[inline(always)]
        fn $name(self, $($arg: [$of; $lanes]),+) -> [$result; $lanes] {
            let mut out = [<$result>::default(); $lanes];
            for i in 0..$lanes {
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
    const DOUBLES: usize = DOUBLES;
    type D = [f64; DOUBLES];

    lanewise! { LANES:
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

    lanewise! { DOUBLES:
        add_doubles(a: f64, b: f64) -> f64 = a + b;
        sub_doubles(a: f64, b: f64) -> f64 = a - b;
        mul_doubles(a: f64, b: f64) -> f64 = a * b;
        fma_doubles(a: f64, b: f64, c: f64) -> f64 = a.mul_add(b, c);
    }

    #[inline(always)]
    fn splat_double(self, value: f64) -> Self::D {
        [value; DOUBLES]
    }

    #[inline(always)]
    fn any_double(self, a: Self::D) -> bool {
        a.iter().any(|&v| v != 0.0)
    }

    #[inline(always)]
    fn load_doubles(self, plane: &Plane<f64>, at: usize) -> Self::D {
        plane.read(at)
    }

    #[inline(always)]
    fn load_widened(self, plane: &Plane, at: usize) -> Self::D {
        plane.read::<DOUBLES>(at).map(f64::from)
    }

    #[inline(always)]
    fn store_doubles(self, plane: &mut Plane<f64>, at: usize, value: Self::D) {
        plane.write(at, value);
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
        plane.read(at)
    }

    #[inline(always)]
    fn load_beside(self, plane: &Plane, at: usize, i: usize) -> Self::F {
        self.load(plane, at + i)
    }

    #[inline(always)]
    fn store(self, plane: &mut Plane, at: usize, value: Self::F) {
        plane.write(at, value);
    }
}
