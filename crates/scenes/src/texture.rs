//! Procedural textures.
//!
//! They sit in the innermost loop of path tracing, so each costs a handful of integer hashes and no transcendental
//! function. Lattice noise is hashed from integer coordinates: every machine sees the same texture.

mod image;
mod masonry;
mod noise;
mod organic;
mod stone;
mod wood;

pub use image::{ImageSizeError, ImageTexture, Wrap};
pub use masonry::{Bricks, Tiles};
pub use noise::{Clouds, Streaks, fractal, value_noise};
pub use organic::{Bread, Leaf};
pub use stone::Granite;
pub use wood::Wood;

use glam::{Vec2, Vec3};

use noise::split;

/// A procedural texture: linear RGB in [0, 1] from texture coordinates, as long as its colours are in [0, 1].
/// Lengths are in the unit of the texture coordinates, which is the scene's unit on most shapes.
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    /// Two colours in squares.
    Checker {
        /// Squares per unit of u and v.
        frequency: Vec2,
        /// Even squares.
        a: Vec3,
        /// Odd squares.
        b: Vec3,
    },
    /// Stripes across v.
    Stripes {
        /// Distance from one stripe to the next.
        period: f32,
        /// Share of the period that the stripe takes, in [0, 1].
        share: f32,
        /// Colour between stripes.
        base: Vec3,
        /// Colour of stripes.
        stripe: Vec3,
    },
    /// Brick wall.
    Bricks(Bricks),
    /// Tiles with grout.
    Tiles(Tiles),
    /// Planks of wood.
    Wood(Wood),
    /// Two colours mixed by fractal noise.
    Clouds(Clouds),
    /// Fine lines along u.
    Streaks(Streaks),
    /// Leaves with veins.
    Leaf(Leaf),
    /// Grains of stone.
    Granite(Granite),
    /// A slice of toast.
    Bread(Bread),
    /// An image from a file.
    Image(ImageTexture),
}

impl Texture {
    /// Colour at `uv`, which must be finite.
    #[inline]
    #[must_use]
    pub fn eval(&self, uv: Vec2) -> Vec3 {
        match self {
            Self::Checker { frequency, a, b } => {
                let (x, _) = split(uv.x * frequency.x);
                let (y, _) = split(uv.y * frequency.y);
                if (x ^ y) & 1 == 0 { *a } else { *b }
            }
            Self::Stripes { period, share, base, stripe } => {
                if split(uv.y / period).1 < *share {
                    *stripe
                } else {
                    *base
                }
            }
            Self::Bricks(t) => t.eval(uv),
            Self::Tiles(t) => t.eval(uv),
            Self::Wood(t) => t.eval(uv),
            Self::Clouds(t) => t.eval(uv),
            Self::Streaks(t) => t.eval(uv),
            Self::Leaf(t) => t.eval(uv),
            Self::Granite(t) => t.eval(uv),
            Self::Bread(t) => t.eval(uv),
            Self::Image(t) => t.eval(uv),
        }
    }
}

#[cfg(test)]
mod tests;
