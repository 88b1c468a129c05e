use glam::{Vec2, Vec3};

use super::noise::{split, value_noise};
use crate::hash::{lattice, unit};

/// Polished granite: ragged grains of four minerals in two sizes, without any order.
#[derive(Debug, Clone, PartialEq)]
pub struct Granite {
    /// Size of a large grain; small ones are a third as large.
    pub grain: f32,
    /// Colours of the minerals, the commonest first: a half, a quarter, and an eighth each of the grains.
    pub colors: [Vec3; 4],
    /// Which stone.
    pub seed: u32,
}

impl Granite {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let p = uv * self.grain.recip();
        // Grains are the cells of a grid that noise has bent beyond recognition.
        let bend = Vec2::new(value_noise(p * 1.3, self.seed ^ 1), value_noise(p * 1.3, self.seed ^ 2));
        let fray = Vec2::new(value_noise(p * 4.7, self.seed ^ 3), value_noise(p * 4.7, self.seed ^ 4));
        let bent = p + bend * 2.2 + fray * 0.5;
        let large = cell(bent, self.seed);
        let own = if large < 0.4 { large * 2.5 } else { cell(bent * 3.0 + fray, self.seed ^ 5) };
        let (place, shade) = split(own * 8.0);
        let mineral = match place {
            ..4 => 0,
            4..6 => 1,
            6 => 2,
            _ => 3,
        };
        // No two grains of a mineral are alike.
        self.colors[mineral] * (0.75 + 0.25 * shade)
    }
}

/// A value in [0, 1) per cell of the integer grid.
#[inline]
fn cell(p: Vec2, seed: u32) -> f32 {
    unit(lattice(split(p.x).0, split(p.y).0, seed))
}
