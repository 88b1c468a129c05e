//! The planes of an image in the making, and the memory for them.

use std::sync::{Mutex, PoisonError};

use crate::RenderError;

/// A frame and its encoded file, each of at most 4 bytes per value.
pub const BYTES_PER_VALUE: u64 = 8;

/// Images, each plane by plane and row by row.
#[derive(Debug)]
pub struct Planes {
    pixels: usize,
    /// Locked one by one, so that threads that write strips follow each other from image to image.
    images: Vec<Mutex<Vec<f32>>>,
}

impl Planes {
    /// Images of zeros with so many planes each; an error where the system has no memory for them.
    pub fn zeros(width: usize, height: usize, images: &[usize]) -> Result<Self, RenderError> {
        let pixels = width * height;
        let mut out = Self { pixels, images: Vec::new() };
        let mut taken = 0;
        for channels in images {
            if Vec::<f32>::new().try_reserve_exact(pixels * channels).is_err() {
                let planes: usize = images.iter().sum();
                let bytes = pixels as u64 * planes as u64 * BYTES_PER_VALUE;
                return Err(RenderError::Memory { width, height, planes, bytes, allowed: taken });
            }
            taken += (pixels * channels) as u64 * 4;
            out.images.push(Mutex::new(vec![0.0; pixels * channels]));
        }
        Ok(out)
    }

    /// Copies `count` pixels of a strip to where `first` is the first one.
    pub fn write(&self, strip: &Strip, first: usize, count: usize) {
        let mut values = strip.values.chunks_exact(strip.stride);
        for image in &self.images {
            // A poisoned lock only means that another thread panicked; the planes are plain numbers.
            let mut image = image.lock().unwrap_or_else(PoisonError::into_inner);
            for (plane, values) in image.chunks_exact_mut(self.pixels).zip(&mut values) {
                plane[first..first + count].copy_from_slice(&values[..count]);
            }
        }
    }

    /// The images in their order.
    pub fn into_images(self) -> impl Iterator<Item = Vec<f32>> {
        self.images.into_iter().map(|image| image.into_inner().unwrap_or_else(PoisonError::into_inner))
    }
}

/// The planes of a few neighbouring pixels. Threads fill strips of their own: small enough for a near cache, where whole
/// planes lie too far apart.
#[derive(Debug)]
pub struct Strip {
    values: Vec<f32>,
    /// From plane to plane.
    stride: usize,
}

/// Between planes of a strip: with a distance of a power of two all would fall on the same few places of a cache.
const GAP: usize = 16;

impl Strip {
    /// Of so many pixels.
    pub fn new(pixels: usize, images: &[usize]) -> Self {
        let stride = pixels + GAP;
        Self { values: vec![0.0; stride * images.iter().sum::<usize>()], stride }
    }

    /// All values of a pixel, plane by plane.
    #[inline(always)]
    pub fn pixel(&mut self, at: usize) -> impl Iterator<Item = &mut f32> {
        self.values.chunks_exact_mut(self.stride).filter_map(move |plane| plane.get_mut(at))
    }
}
