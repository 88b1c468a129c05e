use glam::{Vec2, Vec3};

/// A procedural texture: linear RGB in [0, 1] from texture coordinates. Lattice noise is hashed from integer
/// coordinates, so every machine sees the same texture.
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
}

impl Texture {
    /// Colour at `uv`.
    #[must_use]
    pub fn eval(&self, uv: Vec2) -> Vec3 {
        match self {
            Self::Checker { frequency, a, b } => {
                let cell = (uv * *frequency).floor();
                if (cell.x + cell.y).rem_euclid(2.0) < 1.0 { *a } else { *b }
            }
        }
    }
}
