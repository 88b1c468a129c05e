//! Runs a function over all pixels on all threads.

use std::sync::Mutex;

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::planes::{Planes, zeros};
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

/// Calls `pixel(scratch, x, y, values)` once for each pixel; `values` has one entry per plane. Which thread does it makes
/// no difference to the result, because pixels share nothing.
///
/// # Errors
/// [`RenderError::Cancelled`], [`RenderError::Memory`].
pub fn develop<T>(
    extent: Extent,
    planes: usize,
    progress: &dyn Progress,
    scratch: impl Fn() -> T + Sync + Send,
    pixel: impl Fn(&mut T, usize, usize, &mut [f32]) + Sync + Send,
) -> Result<Planes, RenderError> {
    let count = extent.width * extent.height;
    let piece = (PIECE_SAMPLES / extent.samples.max(1) as usize).clamp(1, 1024);
    let done = Mutex::new(zeros(extent.width, extent.height, planes)?);
    (0..count.div_ceil(piece)).into_par_iter().try_for_each_init(&scratch, |scratch, index| {
        let range = index * piece..((index + 1) * piece).min(count);
        let mut values = vec![0.0f32; range.len() * planes];
        for (at, values) in range.clone().zip(values.chunks_exact_mut(planes)) {
            pixel(scratch, at % extent.width, at / extent.width, values);
        }
        {
            // A poisoned lock only means that another piece panicked; the planes are plain numbers.
            let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            for (plane, out) in done.iter_mut().enumerate() {
                for (k, value) in out[range.clone()].iter_mut().enumerate() {
                    *value = values[k * planes + plane];
                }
            }
        }
        match progress.advance(range.len()) {
            std::ops::ControlFlow::Continue(()) => Ok(()),
            std::ops::ControlFlow::Break(()) => Err(RenderError::Cancelled),
        }
    })?;
    Ok(done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner))
}
