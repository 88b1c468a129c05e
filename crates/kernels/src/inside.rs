//! What the tests of this crate look at beyond its interface. They stand beside the library, not in it, so that its
//! inner loops, which take minutes to compile for every instruction set, are compiled once.

use crate::engine::{InstructionSet, Kernel, MAX_LANES, Plane, Simd};
use crate::flash_filter::{self, FlashFilterError, FlashInputs, FlashParams};
use crate::nlm::{self, Filtered, NlmInputs, NlmParams, Pass};
use crate::{KernelError, check};

pub use crate::engine::{Tile, TileRows, first_bad, for_each_tile};

/// [`nlm::filter_at`] in tiles of another size: (width, height) in pixels, the width a multiple of 16.
///
/// # Errors
/// As there.
pub fn nlm_in_tiles(
    params: &NlmParams,
    passes: &[Pass],
    inputs: &NlmInputs<'_>,
    level: InstructionSet,
    tile: (usize, usize),
) -> Result<Vec<Filtered>, KernelError> {
    params.check(passes, inputs)?;
    check::available(level)?;
    Ok(nlm::in_tiles(params, passes, inputs, level, Some(tile)))
}

/// [`flash_filter::filter_into`] in tiles of another size: (width, height) in pixels, the width a multiple of 16.
///
/// # Errors
/// As there.
pub fn flash_filter_in_tiles(
    params: &FlashParams,
    inputs: &FlashInputs<'_>,
    level: InstructionSet,
    tile: (usize, usize),
    out: [&mut [f32]; 3],
) -> Result<(), FlashFilterError> {
    params.check(inputs)?;
    flash_filter::check_output(params, level, &out)?;
    flash_filter::tiled::filter(params, inputs, None, level, tile, out);
    Ok(())
}

/// 2^x as the kernels compute it, for x ≤ 0; `None` where the processor lacks the level.
#[must_use]
pub fn exp2(level: InstructionSet, x: f32) -> Option<f32> {
    level.is_available().then(|| level.launch(Exp2(x)))
}

/// 2^x of one value in every lane, the first of them.
struct Exp2(f32);

impl Kernel for Exp2 {
    type Out = f32;

    #[inline(always)]
    fn run<S: Simd>(self, s: S) -> f32 {
        let mut out = [0.0; MAX_LANES];
        // SAFETY: one vector is stored, and there is room for the widest.
        let plane = unsafe { Plane::vouched_mut(&mut out) };
        s.store(plane, 0, s.exp2_or_zero(s.splat(self.0)));
        out[0]
    }
}

/// Multiply-adds that one thread makes per call of [`multiply_adds`], for one lane.
pub const MULTIPLY_ADDS: usize = 12 * 100_000;

/// [`MULTIPLY_ADDS`] fused multiply-adds that wait for no other in turn, in every lane: what a processor can do at most, to
/// measure kernels against. Gives the lanes; `None` where the processor lacks the level.
#[must_use]
pub fn multiply_adds(level: InstructionSet) -> Option<usize> {
    level.is_available().then(|| level.launch(MultiplyAdds))
}

struct MultiplyAdds;

impl Kernel for MultiplyAdds {
    type Out = usize;

    #[inline(always)]
    fn run<S: Simd>(self, s: S) -> usize {
        let (factor, term) = (s.splat(std::hint::black_box(0.5)), s.splat(std::hint::black_box(1.0)));
        // As many as keep two units of four cycles busy, and some.
        let mut sums = [s.splat(std::hint::black_box(0.0)); 12];
        for _ in 0..MULTIPLY_ADDS / sums.len() {
            for sum in &mut sums {
                *sum = s.fma(*sum, factor, term);
            }
        }
        std::hint::black_box(sums);
        S::LANES
    }
}
