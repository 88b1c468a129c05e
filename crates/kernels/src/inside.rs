//! What the tests of this crate look at beyond its interface. They stand beside the library, not in it, so that its
//! inner loops, which take minutes to compile for every instruction set, are compiled once.

use crate::InstructionSet;
use crate::flash_filter::{self, FlashFilterError, FlashInputs, FlashParams};
use crate::nlm::{self, Filtered, NlmError, NlmInputs, NlmParams, Pass};
#[cfg(target_arch = "x86_64")]
use crate::simd::{Avx2, Avx512};
use crate::simd::{MAX_LANES, Portable, Simd};

pub use crate::tiles::{Tile, TileRows, first_bad, for_each_tile};

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
) -> Result<Vec<Filtered>, NlmError> {
    params.check(passes, inputs)?;
    if !level.is_available() {
        return Err(NlmError::LevelUnavailable { level });
    }
    Ok(nlm::tiled::filter(params, passes, inputs, level, tile))
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
    if !level.is_available() {
        return None;
    }
    // SAFETY: the processor has been asked for what the level needs.
    Some(unsafe {
        match level {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => exp2_of::<Avx512>(x),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => exp2_of::<Avx2>(x),
            _ => exp2_of::<Portable>(x),
        }
    })
}

/// 2^x of one value in every lane, the first of them.
///
/// # Safety
/// The instruction set is available.
unsafe fn exp2_of<S: Simd>(x: f32) -> f32 {
    let mut out = [0.0; MAX_LANES];
    // SAFETY: the caller vouches for the instruction set; `out` holds the widest vector.
    unsafe {
        let (y, n) = S::exp2(S::splat(x));
        let all = S::le(y, y);
        S::store(out.as_mut_ptr(), S::keep_scaled(all, y, n));
    }
    out[0]
}
