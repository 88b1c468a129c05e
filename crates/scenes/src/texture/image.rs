use std::sync::Arc;

use glam::{Vec2, Vec3};
use thiserror::Error;

/// What lies beyond the edges of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The pixels of the edge.
    Clamp,
    /// The image mirrored, then again.
    Mirror,
}

impl Wrap {
    /// Index inside `0..n` of pixel `i`; `n` is at least 1.
    fn index(self, i: i64, n: i64) -> i64 {
        match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Clamp => i.clamp(0, n - 1),
            Self::Mirror => {
                let j = i.rem_euclid(2 * n);
                if j < n { j } else { 2 * n - 1 - j }
            }
        }
    }
}

/// An image has no pixels, or not as many as its size says.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("an image of {width}x{height} pixels, each side at least 1, cannot have {pixels} colours")]
pub struct ImageSizeError {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Colours that were given.
    pub pixels: usize,
}

/// An image with linear colours, looked up bilinearly; (0, 0) is its upper left corner and v grows downwards.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageTexture {
    width: usize,
    height: usize,
    pixels: Arc<[Vec3]>,
    wrap: [Wrap; 2],
    factor: Vec3,
}

impl ImageTexture {
    /// From linear colours in rows, the upper one first, each multiplied by `factor` when looked up. `wrap`: along u
    /// and along v.
    ///
    /// # Errors
    ///
    /// [`ImageSizeError`] if a side is 0 or the number of pixels is not width times height.
    pub fn new(
        width: usize,
        height: usize,
        pixels: Arc<[Vec3]>,
        wrap: [Wrap; 2],
        factor: Vec3,
    ) -> Result<Self, ImageSizeError> {
        if width == 0 || height == 0 || width.checked_mul(height) != Some(pixels.len()) {
            return Err(ImageSizeError { width, height, pixels: pixels.len() });
        }
        Ok(Self { width, height, pixels, wrap, factor })
    }

    /// The same image with every colour multiplied once more.
    #[must_use]
    pub fn times(mut self, factor: Vec3) -> Self {
        self.factor *= factor;
        self
    }

    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let (x, y) = (uv.x * self.width as f32 - 0.5, uv.y * self.height as f32 - 0.5);
        let (left, top) = (x.floor(), y.floor());
        // Halfway to the limits of `i64`, so that the neighbour's index exists, too.
        let cell = |v: f32| (v as i64).clamp(i64::MIN / 2, i64::MAX / 2);
        let (i, j) = (cell(left), cell(top));
        let column = [i, i + 1].map(|i| self.wrap[0].index(i, self.width as i64) as usize);
        let row = [j, j + 1].map(|j| self.wrap[1].index(j, self.height as i64) as usize);
        let at = |a: usize, b: usize| self.pixels[row[b] * self.width + column[a]];
        let (s, t) = ((x - left).clamp(0.0, 1.0), (y - top).clamp(0.0, 1.0));
        self.factor * at(0, 0).lerp(at(1, 0), s).lerp(at(0, 1).lerp(at(1, 1), s), t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(wrap: Wrap) -> ImageTexture {
        ImageTexture::new(2, 1, vec![Vec3::X, Vec3::Y].into(), [wrap; 2], Vec3::ONE).expect("two pixels")
    }

    #[test]
    fn centres_show_their_pixel_and_between_them_is_the_mean() {
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            assert_eq!(pair(wrap).eval(Vec2::new(0.25, 0.5)), Vec3::X);
            assert_eq!(pair(wrap).eval(Vec2::new(0.75, 0.5)), Vec3::Y);
            assert_eq!(pair(wrap).eval(Vec2::new(0.5, 0.5)), Vec3::new(0.5, 0.5, 0.0));
        }
    }

    #[test]
    fn wrapping_decides_what_lies_beyond_the_edge() {
        for (wrap, expected) in [(Wrap::Repeat, Vec3::X), (Wrap::Clamp, Vec3::Y), (Wrap::Mirror, Vec3::Y)] {
            assert_eq!(pair(wrap).eval(Vec2::new(1.25, 0.5)), expected);
        }
        assert_eq!(pair(Wrap::Mirror).eval(Vec2::new(-0.75, 0.5)), Vec3::Y);
        assert!(pair(Wrap::Repeat).eval(Vec2::splat(1e30)).is_finite());
    }

    #[test]
    fn factors_multiply() {
        let twice = pair(Wrap::Clamp).times(Vec3::splat(0.5)).times(Vec3::new(0.5, 1.0, 1.0));
        assert_eq!(twice.eval(Vec2::new(0.25, 0.5)), Vec3::new(0.25, 0.0, 0.0));
    }

    #[test]
    fn images_without_pixels_are_refused() {
        let empty = ImageTexture::new(0, 1, Vec::new().into(), [Wrap::Repeat; 2], Vec3::ONE);
        assert_eq!(empty, Err(ImageSizeError { width: 0, height: 1, pixels: 0 }));
    }
}
