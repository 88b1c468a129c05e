//! Code compiled for several instruction sets, and the choice among them: the only place that makes it.

use super::portable::Portable;
use super::{InstructionSet, Simd};
#[cfg(target_arch = "x86_64")]
use super::{avx2::Avx2, avx512::Avx512};

/// Code written in vector operations.
pub(crate) trait Kernel {
    /// What it gives.
    type Out;

    /// The code. Mark it, and what it calls, `#[inline(always)]`: only what is inlined is compiled for the level.
    fn run<S: Simd>(self, s: S) -> Self::Out;
}

macro_rules! levels {
    ($($level:ident = $function:ident($token:ident): $features:literal;)+) => {
        impl InstructionSet {
            /// Runs `kernel` compiled for this level, or in plain Rust where the processor does not have it.
            pub(crate) fn launch<K: Kernel>(self, kernel: K) -> K::Out {
                match self {
                    $(
                        #[cfg(target_arch = "x86_64")]
                        InstructionSet::$level => {
                            if let Some(s) = $token::new() {
                                // SAFETY: a token exists, so the processor has what the function enables.
                                return unsafe { $function(kernel, s) };
                            }
                        }
                    )+
                    _ => {}
                }
                kernel.run(Portable)
            }
        }

        $(
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = $features)]
            fn $function<K: Kernel>(kernel: K, s: $token) -> K::Out {
                kernel.run(s)
            }
        )+
    };
}

levels! {
    Avx512 = avx512(Avx512): "avx512f,avx512dq";
    Avx2 = avx2(Avx2): "avx2,fma";
}

/// Code without a vector operation in its text, for the compiler to vectorise.
///
/// Its results have the same bits at every level: Rust rounds each operation for itself and never reorders or fuses
/// floating point, and code that wants sums to vectorise must write their lanes down.
pub trait Vectorised {
    /// What it gives.
    type Out;

    /// The code. Mark it, and what it calls, `#[inline(always)]`: only what is inlined is compiled for the level.
    fn run(self) -> Self::Out;
}

/// [`Vectorised`] code as a kernel.
struct Plain<V>(V);

impl<V: Vectorised> Kernel for Plain<V> {
    type Out = V::Out;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> V::Out {
        self.0.run()
    }
}

impl InstructionSet {
    /// Runs `code` compiled for this level, or plainly where the processor does not have it.
    ///
    /// ```
    /// use noisefloor_kernels::{InstructionSet, Vectorised};
    ///
    /// struct Doubled<'a>(&'a mut [f32]);
    ///
    /// impl Vectorised for Doubled<'_> {
    ///     type Out = ();
    ///
    ///     #[inline(always)]
    ///     fn run(self) {
    ///         self.0.iter_mut().for_each(|v| *v *= 2.0);
    ///     }
    /// }
    ///
    /// let mut values = [1.0; 100];
    /// InstructionSet::in_use().run(Doubled(&mut values));
    /// assert_eq!(values, [2.0; 100]);
    /// ```
    pub fn run<V: Vectorised>(self, code: V) -> V::Out {
        self.launch(Plain(code))
    }
}
