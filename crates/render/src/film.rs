//! Runs a function over all pixels on all threads.

use std::ops::ControlFlow;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::planes::{Planes, Strip};
use crate::{Progress, RenderError};

/// Size of an image and the work in one of its pixels.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Samples per pixel.
    pub samples: u32,
}

/// Samples in one piece of work: long enough that handing it out costs nothing, short enough to share evenly.
const PIECE_SAMPLES: usize = 8192;

/// Most pixels in one: all their values should fit a cache.
const PIECE_PIXELS: usize = 256;

/// Calls `pixel(scratch, index, strip, at)` once for each pixel, numbered row by row, for its values at a place in a
/// strip of images with so many planes. Which thread does it makes no difference to the result, because pixels share
/// nothing.
///
/// # Errors
/// [`RenderError::Cancelled`], [`RenderError::Memory`].
pub fn develop<T>(
    extent: Extent,
    images: &[usize],
    progress: &dyn Progress,
    scratch: impl Fn() -> T + Sync + Send,
    pixel: impl Fn(&mut T, usize, &mut Strip, usize) + Sync + Send,
) -> Result<Planes, RenderError> {
    let count = extent.width * extent.height;
    let piece = (PIECE_SAMPLES / extent.samples.max(1) as usize).clamp(1, PIECE_PIXELS);
    let planes = Planes::zeros(extent.width, extent.height, images)?;
    let scratch = || (scratch(), Strip::new(piece, images));
    (0..count.div_ceil(piece)).into_par_iter().try_for_each_init(scratch, |(scratch, strip), index| {
        let range = index * piece..((index + 1) * piece).min(count);
        for (at, index) in range.clone().enumerate() {
            pixel(scratch, index, strip, at);
        }
        planes.write(strip, range.start, range.len());
        match progress.advance(range.len()) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })?;
    Ok(planes)
}
