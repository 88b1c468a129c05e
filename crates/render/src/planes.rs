//! The planes of an image in the making, and the memory for them.

use crate::RenderError;

/// A frame and its encoded file, each of at most 4 bytes per value.
pub const BYTES_PER_VALUE: u64 = 8;

/// What is kept of every pixel.
#[derive(Debug, Clone, Default)]
pub struct Sheet {
    /// Values that a pixel comes with.
    pub values: usize,
    /// Which of them each plane has.
    pub sources: Vec<usize>,
    /// Planes of each image, in order; together one per source.
    pub images: Vec<usize>,
}

impl Sheet {
    /// Adds an image of these values.
    pub fn image(&mut self, sources: impl IntoIterator<Item = usize>) {
        let before = self.sources.len();
        self.sources.extend(sources);
        self.images.push(self.sources.len() - before);
    }
}

/// Images of a sheet, each plane by plane and row by row.
#[derive(Debug)]
pub struct Planes {
    pixels: usize,
    images: Vec<Vec<f32>>,
}

impl Planes {
    /// Images of zeros; an error where the system has no memory for them.
    pub fn zeros(width: usize, height: usize, sheet: &Sheet) -> Result<Self, RenderError> {
        let pixels = width * height;
        let mut images: Vec<Vec<f32>> = Vec::new();
        for channels in &sheet.images {
            if Vec::<f32>::new().try_reserve_exact(pixels * channels).is_err() {
                let planes = sheet.sources.len();
                let bytes = pixels as u64 * planes as u64 * BYTES_PER_VALUE;
                let allowed = images.iter().map(|image| image.len() as u64 * 4).sum();
                return Err(RenderError::Memory { width, height, planes, bytes, allowed });
            }
            images.push(vec![0.0; pixels * channels]);
        }
        Ok(Self { pixels, images })
    }

    /// Writes the values of some pixels, from `first` on.
    pub fn write(&mut self, sheet: &Sheet, first: usize, values: &[f32]) {
        // Few enough that all their values stay in the nearest cache while they are read once for every plane.
        for (block, values) in values.chunks(NEAR * sheet.values).enumerate() {
            let first = first + block * NEAR;
            let count = values.len() / sheet.values;
            let planes = self.images.iter_mut().flat_map(|image| image.chunks_exact_mut(self.pixels));
            for (plane, source) in planes.zip(&sheet.sources) {
                let pixels = values.chunks_exact(sheet.values);
                for (out, pixel) in plane[first..first + count].iter_mut().zip(pixels) {
                    *out = pixel[*source];
                }
            }
        }
    }

    /// The images in their order.
    pub fn into_images(self) -> impl Iterator<Item = Vec<f32>> {
        self.images.into_iter()
    }
}

/// Pixels that are spread over the planes together.
const NEAR: usize = 64;
