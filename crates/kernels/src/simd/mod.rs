//! The few vector operations that the kernels are written in, for each instruction set.
//!
//! Every operation works lane by lane and rounds as IEEE 754 says, so a kernel written in them gives the same bits
//! whatever the number of lanes. All of it is `#[inline(always)]`: a kernel body only becomes 512-bit code by
//! being inlined whole into a function that enables those instructions.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod operations;
mod portable;

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub(crate) use avx512::Avx512;
pub(crate) use operations::{MAX_LANES, Simd};
pub(crate) use portable::Portable;
