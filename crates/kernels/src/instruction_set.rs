//! Instruction sets that the fast kernels are compiled for, and the choice among them at run time.

use std::fmt;

/// An instruction set. All levels of a kernel give the same bits; they differ in speed only.
///
/// ```
/// use noisefloor_kernels::InstructionSet;
/// assert!(InstructionSet::best().is_available());
/// assert!(InstructionSet::Portable.is_available());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum InstructionSet {
    /// Plain Rust over small arrays, compiled for whatever the binary was built for. Where that has no fused
    /// multiply-add (x86-64 by default) each one is a library call: right, but slow.
    Portable,
    /// 256-bit AVX2 with FMA, 8 lanes.
    Avx2,
    /// 512-bit AVX-512F with AVX-512DQ, 16 lanes.
    Avx512,
}

impl InstructionSet {
    /// Every level, slowest first, whether this processor has it or not.
    pub const ALL: [InstructionSet; 3] =
        [InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512];

    /// The fastest level that this processor and operating system support.
    pub fn best() -> InstructionSet {
        if InstructionSet::Avx512.is_available() {
            InstructionSet::Avx512
        } else if InstructionSet::Avx2.is_available() {
            InstructionSet::Avx2
        } else {
            InstructionSet::Portable
        }
    }

    /// Whether this level can run here.
    pub fn is_available(self) -> bool {
        match self {
            InstructionSet::Portable => true,
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => {
                is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq")
            }
            #[cfg(not(target_arch = "x86_64"))]
            InstructionSet::Avx2 | InstructionSet::Avx512 => false,
        }
    }

    /// Short lower-case name: `portable`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self {
            InstructionSet::Portable => "portable",
            InstructionSet::Avx2 => "avx2",
            InstructionSet::Avx512 => "avx512",
        }
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
