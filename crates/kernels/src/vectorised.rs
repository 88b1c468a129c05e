//! Plain Rust code compiled for several instruction sets.

use crate::InstructionSet;

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
    /// InstructionSet::best().run(Doubled(&mut values));
    /// assert_eq!(values, [2.0; 100]);
    /// ```
    pub fn run<V: Vectorised>(self, code: V) -> V::Out {
        match self {
            // SAFETY: `is_available` has asked the processor for what the function enables.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 if self.is_available() => unsafe { avx512(code) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 if self.is_available() => unsafe { avx2(code) },
            _ => code.run(),
        }
    }
}

/// # Safety
/// The processor has AVX-512F and AVX-512DQ.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
unsafe fn avx512<V: Vectorised>(code: V) -> V::Out {
    code.run()
}

/// # Safety
/// The processor has AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<V: Vectorised>(code: V) -> V::Out {
    code.run()
}
