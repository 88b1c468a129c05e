//! What every kernel stands on: vector operations of each instruction set, the choice among them at run time, and the way a
//! window filter walks: tiles, working copies with vanished borders, offsets in blocks, patch sums.
//!
//! A [`Simd`] token is proof that the processor has its instruction set, so arithmetic on its vectors is safe. Memory is
//! read and written through [`Plane`]s, whose sizes are vouched for once per tile. Every operation works lane by lane and
//! rounds as IEEE 754 says, and a pixel's sums are taken in one order whatever the tile: a kernel written in them gives the
//! same bits for every instruction set and any number of threads.
//!
//! All that runs inside a kernel is `#[inline(always)]`: a body only becomes code for an instruction set by being inlined whole
//! into the function that enables it.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod copies;
mod grid;
mod instruction_set;
mod launch;
mod mirror;
mod patch;
mod plane;
mod portable;
mod scratch;
mod simd;
mod tiles;
mod window;

pub(crate) use copies::Copies;
pub(crate) use grid::{Grid, LINE};
pub use instruction_set::{InstructionSet, NotForced, UnknownInstructionSet};
pub(crate) use launch::Kernel;
pub use launch::Vectorised;
pub use mirror::mirror;
pub(crate) use patch::{Columns, Equal, PatchDistance, Weighted, across};
pub(crate) use plane::Plane;
pub(crate) use scratch::Scratch;
pub(crate) use simd::{EXP2, LEAST_EXPONENT, MAX_LANES, ROUND, Simd};
pub(crate) use tiles::{TILE, map_tiles};
pub use tiles::{Tile, TileRows, first_bad, for_each_tile};
pub(crate) use window::{Block, Window};
