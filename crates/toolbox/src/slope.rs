//! Slopes of images.

use noisefloor_frame::Image;
use rayon::prelude::*;

/// How a slope is taken from neighbouring pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlopeRule {
    /// Per axis the smaller of both one-sided half-pixel differences, 0 on the border: steep only where both sides are.
    MinHalf,
    /// Per axis half the difference of both neighbours, one-sided on the border.
    Central,
}

/// Squared gradient magnitude per channel, at most `most`.
#[must_use]
pub fn squared_slope(image: &Image, rule: SlopeRule, most: f32) -> Image {
    let (width, height) = (image.width(), image.height());
    let mut out = Image::new(width, height, image.channels());
    for c in 0..image.channels() {
        let from = image.plane(c);
        out.plane_mut(c).par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, value) in row.iter_mut().enumerate() {
                let p = y * width + x;
                let at = |inside: bool, q: usize| if inside { Some(from[q]) } else { None };
                let left = at(x > 0, p.wrapping_sub(1));
                let right = at(x + 1 < width, p + 1);
                let above = at(y > 0, p.wrapping_sub(width));
                let below = at(y + 1 < height, p + width);
                let square = slope(left, from[p], right, rule) + slope(above, from[p], below, rule);
                *value = square.min(most);
            }
        });
    }
    out
}

/// Squared slope along one axis.
fn slope(before: Option<f32>, here: f32, after: Option<f32>, rule: SlopeRule) -> f32 {
    let square = |d: f32| d * d;
    match (rule, before, after) {
        (_, None, None) => 0.0,
        (SlopeRule::MinHalf, Some(a), Some(b)) => square(0.5 * (a - here)).min(square(0.5 * (b - here))),
        (SlopeRule::MinHalf, ..) => 0.0,
        (SlopeRule::Central, Some(a), Some(b)) => square(0.5 * (b - a)),
        (SlopeRule::Central, Some(a), None) | (SlopeRule::Central, None, Some(a)) => square(a - here),
    }
}
