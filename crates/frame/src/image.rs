use crate::FrameError;

/// Planar `f32` image: plane by plane (`channel`, `y`, `x`), rows contiguous.
///
/// Never empty: every dimension is at least 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    channels: usize,
    data: Vec<f32>,
}

impl Image {
    /// An image of zeros.
    ///
    /// # Panics
    /// If a dimension is zero: sizes come from existing images or from validated input
    /// (use [`Image::from_vec`] for untrusted shapes).
    #[must_use]
    pub fn new(width: usize, height: usize, channels: usize) -> Self {
        Self::filled(width, height, channels, 0.0)
    }

    /// An image of one value. Panics like [`Image::new`].
    #[must_use]
    pub fn filled(width: usize, height: usize, channels: usize, value: f32) -> Self {
        assert!(width > 0 && height > 0 && channels > 0, "image dimensions must be at least 1");
        Self { width, height, channels, data: vec![value; width * height * channels] }
    }

    /// Takes planar values.
    ///
    /// # Errors
    /// [`FrameError::Shape`] for empty or overflowing shapes, [`FrameError::Length`] if `data` does not fill it.
    pub fn from_vec(
        width: usize,
        height: usize,
        channels: usize,
        data: Vec<f32>,
    ) -> Result<Self, FrameError> {
        let needed = width.checked_mul(height).and_then(|n| n.checked_mul(channels));
        match needed {
            Some(0) | None => Err(FrameError::Shape { width, height, channels }),
            Some(n) if n != data.len() => {
                Err(FrameError::Length { width, height, channels, got: data.len() })
            }
            Some(_) => Ok(Self { width, height, channels, data }),
        }
    }

    /// Builds from a function of `(channel, x, y)`. Panics like [`Image::new`].
    #[must_use]
    pub fn from_fn(
        width: usize,
        height: usize,
        channels: usize,
        mut value: impl FnMut(usize, usize, usize) -> f32,
    ) -> Self {
        let mut image = Self::new(width, height, channels);
        for c in 0..channels {
            for y in 0..height {
                for x in 0..width {
                    image.data[(c * height + y) * width + x] = value(c, x, y);
                }
            }
        }
        image
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Planes.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Pixels in one plane.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// All planes, one after the other.
    #[must_use]
    pub fn data(&self) -> &[f32] {
        &self.data
    }

    /// All planes, mutable.
    pub fn data_mut(&mut self) -> &mut [f32] {
        &mut self.data
    }

    /// One plane, row by row. Panics if `channel` is out of range.
    #[must_use]
    pub fn plane(&self, channel: usize) -> &[f32] {
        let n = self.pixels();
        &self.data[channel * n..(channel + 1) * n]
    }

    /// One plane, mutable. Panics if `channel` is out of range.
    pub fn plane_mut(&mut self, channel: usize) -> &mut [f32] {
        let n = self.pixels();
        &mut self.data[channel * n..(channel + 1) * n]
    }

    /// The planes in order.
    pub fn planes(&self) -> impl ExactSizeIterator<Item = &[f32]> {
        self.data.chunks_exact(self.pixels())
    }

    /// The planes in order, mutable.
    pub fn planes_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [f32]> {
        let n = self.pixels();
        self.data.chunks_exact_mut(n)
    }

    /// One value. Panics out of range.
    #[must_use]
    pub fn get(&self, channel: usize, x: usize, y: usize) -> f32 {
        assert!(x < self.width, "x is inside the row");
        self.data[(channel * self.height + y) * self.width + x]
    }

    /// Sets one value. Panics out of range.
    pub fn set(&mut self, channel: usize, x: usize, y: usize, value: f32) {
        assert!(x < self.width, "x is inside the row");
        self.data[(channel * self.height + y) * self.width + x] = value;
    }

    /// Whether width, height and channels agree.
    #[must_use]
    pub fn same_shape(&self, other: &Self) -> bool {
        (self.width, self.height, self.channels) == (other.width, other.height, other.channels)
    }

    /// Checks the shape of a named buffer.
    ///
    /// # Errors
    /// [`FrameError::Mismatch`] naming `what`.
    pub fn expect_shape(
        &self,
        what: &str,
        width: usize,
        height: usize,
        channels: usize,
    ) -> Result<(), FrameError> {
        if (self.width, self.height, self.channels) == (width, height, channels) {
            return Ok(());
        }
        Err(FrameError::Mismatch {
            what: what.to_owned(),
            width,
            height,
            channels,
            got_width: self.width,
            got_height: self.height,
            got_channels: self.channels,
        })
    }

    /// A new image of the same shape, value by value.
    #[must_use]
    pub fn map(&self, f: impl FnMut(f32) -> f32) -> Self {
        Self { data: self.data.iter().copied().map(f).collect(), ..*self }
    }

    /// A new image from two of the same shape. Panics if the shapes differ.
    #[must_use]
    pub fn zip_map(&self, other: &Self, mut f: impl FnMut(f32, f32) -> f32) -> Self {
        assert!(self.same_shape(other), "zip_map needs equal shapes");
        let data = self.data.iter().zip(&other.data).map(|(&a, &b)| f(a, b)).collect();
        Self { data, ..*self }
    }

    /// The rectangle that starts at `(x, y)`. Panics if it does not fit or is empty.
    #[must_use]
    pub fn crop(&self, x: usize, y: usize, width: usize, height: usize) -> Self {
        assert!(x + width <= self.width && y + height <= self.height, "crop is inside the image");
        Self::from_fn(width, height, self.channels, |c, i, j| self.get(c, x + i, y + j))
    }

    /// Number of values that are NaN or infinite.
    #[must_use]
    pub fn count_non_finite(&self) -> usize {
        self.data.iter().filter(|v| !v.is_finite()).count()
    }

    /// Median [`luminance`] of the pixels where it is above 0, the lower of the two in the middle: some pixel's own, so that
    /// it scales with the image exactly, and no pixel moves it by much, however bright. `None` where no pixel is lit. Of
    /// an image without three channels their mean stands for the luminance.
    #[must_use]
    pub fn median_luminance(&self) -> Option<f32> {
        let of = |p: usize| match self.channels {
            3 => luminance([0, 1, 2].map(|c| self.plane(c)[p])),
            channels => self.planes().map(|plane| plane[p]).sum::<f32>() / channels as f32,
        };
        let mut lit: Vec<f32> = (0..self.pixels()).map(of).filter(|v| *v > 0.0 && v.is_finite()).collect();
        let middle = lit.len().checked_sub(1)? / 2;
        Some(*lit.select_nth_unstable_by(middle, f32::total_cmp).1)
    }
}

/// Rec. 709 luminance of linear RGB.
#[must_use]
pub fn luminance(rgb: [f32; 3]) -> f32 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planar_layout_is_channel_then_row_then_column() {
        let image = Image::from_fn(3, 2, 2, |c, x, y| (100 * c + 10 * y + x) as f32);
        assert_eq!(image.data(), [0., 1., 2., 10., 11., 12., 100., 101., 102., 110., 111., 112.]);
        assert_eq!(image.plane(1), [100., 101., 102., 110., 111., 112.]);
        assert_eq!(image.get(1, 2, 1), 112.0);
    }

    #[test]
    fn wrong_lengths_and_empty_shapes_are_typed_errors() {
        assert!(matches!(Image::from_vec(2, 2, 1, vec![0.0; 3]), Err(FrameError::Length { got: 3, .. })));
        assert!(matches!(Image::from_vec(0, 2, 1, vec![]), Err(FrameError::Shape { .. })));
        assert!(matches!(Image::from_vec(usize::MAX, 2, 1, vec![]), Err(FrameError::Shape { .. })));
    }

    #[test]
    fn median_luminance_is_that_of_a_lit_pixel_and_ignores_how_bright_the_brightest_is() {
        let grey = |values: [f32; 6]| Image::from_fn(6, 1, 3, |_, x, _| values[x]);
        let median = |values| grey(values).median_luminance();
        // Of 1, 2, 3 and the brightest: the lower of the two in the middle.
        for brightest in [4.0, 1e30] {
            let found = median([0.0, 3.0, -5.0, 1.0, brightest, 2.0]).unwrap();
            assert_eq!(found, luminance([2.0; 3]));
        }
        assert_eq!(median([f32::NAN, 0.0, 7.0, f32::INFINITY, -1.0, 0.0]), Some(luminance([7.0; 3])));
        assert_eq!(median([0.0, -1.0, 0.0, f32::NAN, 0.0, 0.0]), None);
        assert_eq!(Image::filled(2, 2, 1, 5.0).median_luminance(), Some(5.0));
    }

    #[test]
    fn crop_takes_the_named_rectangle() {
        let image = Image::from_fn(4, 4, 1, |_, x, y| (10 * y + x) as f32);
        assert_eq!(image.crop(1, 2, 2, 2).data(), [21., 22., 31., 32.]);
    }
}
