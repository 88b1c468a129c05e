//! All samples of chosen pixels.

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TappedSample {
    /// The colour, as it went into the mean: black for a sample that was not finite.
    pub color: [f32; 3],
    /// Where its camera ray went through the pixel, right and down, in 0..1.
    pub position: [f32; 2],
}

/// All samples of one pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Tapped {
    /// Column.
    pub x: usize,
    /// Row.
    pub y: usize,
    /// Index of the first sample; the others follow it without a gap.
    pub first: u32,
    /// The samples in the order of their indices, as many as the frame says the pixel has.
    pub samples: Vec<TappedSample>,
}
