//! Values that a method has no answer for.

use noisefloor_frame::Image;
use rayon::prelude::*;

/// Values that one thread looks at a time.
const CHUNK: usize = 1 << 14;

/// Pixels with a value that is not good.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bad {
    /// How many.
    pub pixels: usize,
    /// Column of the first.
    pub x: usize,
    /// Row of the first.
    pub y: usize,
}

/// Looks for values that are not good; none if all are. Write `good` so that a NaN fails it.
#[must_use]
pub fn find_bad(image: &Image, good: impl Fn(f32) -> bool + Sync) -> Option<Bad> {
    // The usual case, without bookkeeping.
    if image.data().par_chunks(CHUNK).all(|part| part.iter().fold(true, |all, &v| all & good(v))) {
        return None;
    }
    let mut bad = (0..image.pixels()).filter(|&p| image.planes().any(|plane| !good(plane[p])));
    let first = bad.next()?;
    Some(Bad { pixels: 1 + bad.count(), x: first % image.width(), y: first / image.width() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_counted_once_and_the_first_is_told() {
        let mut image = Image::filled(5, 4, 3, 0.5);
        let good = |v: f32| v.abs() <= 1.0;
        assert_eq!(find_bad(&image, good), None);
        image.set(2, 4, 3, 2.0);
        image.set(0, 1, 2, f32::NAN);
        image.set(1, 1, 2, f32::INFINITY);
        assert_eq!(find_bad(&image, good), Some(Bad { pixels: 2, x: 1, y: 2 }));
    }
}
