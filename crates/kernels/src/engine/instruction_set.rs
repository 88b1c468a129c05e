//! Instruction sets that the fast kernels are compiled for, and the choice among them at run time.

use std::fmt;
use std::str::FromStr;
use std::sync::atomic::{AtomicU8, Ordering};

use thiserror::Error;

/// What [`InstructionSet::in_use`] gives: 0 for the best, else 1 + the place among [`InstructionSet::ALL`].
static FORCED: AtomicU8 = AtomicU8::new(0);

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

    /// The level that methods filter with: the best, unless another is [forced](InstructionSet::force).
    pub fn in_use() -> InstructionSet {
        let place = usize::from(FORCED.load(Ordering::Relaxed));
        place.checked_sub(1).map_or_else(Self::best, |i| Self::ALL[i.min(Self::ALL.len() - 1)])
    }

    /// Makes all methods of this process filter with this level: for tests of equal bits, and to time one level on a
    /// machine that has a better one.
    ///
    /// # Errors
    /// [`NotForced`] where this processor does not have it; nothing changes then.
    pub fn force(self) -> Result<(), NotForced> {
        if !self.is_available() {
            return Err(NotForced { level: self });
        }
        let place = Self::ALL.iter().position(|&level| level == self).map_or(0, |i| i + 1);
        FORCED.store(place as u8, Ordering::Relaxed);
        Ok(())
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

/// A processor without the instruction set.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("this processor does not have the instruction set {level}")]
pub struct NotForced {
    /// What was asked for.
    pub level: InstructionSet,
}

/// A word that is no instruction set's.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("`{word}` is no instruction set; allowed are portable, avx2 and avx512")]
pub struct UnknownInstructionSet {
    /// What was asked for.
    pub word: String,
}

impl FromStr for InstructionSet {
    type Err = UnknownInstructionSet;

    fn from_str(word: &str) -> Result<Self, UnknownInstructionSet> {
        let level = Self::ALL.into_iter().find(|level| level.name() == word);
        level.ok_or_else(|| UnknownInstructionSet { word: word.to_owned() })
    }
}
