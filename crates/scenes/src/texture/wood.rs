use glam::{Vec2, Vec3};

use super::noise::{split, value_noise};
use crate::hash::{lattice, unit};

/// Planks along u with grain, as sawn from a trunk.
#[derive(Debug, Clone, PartialEq)]
pub struct Wood {
    /// Width of a plank.
    pub plank: f32,
    /// Length of a plank.
    pub length: f32,
    /// Distance between year rings.
    pub ring: f32,
    /// Late wood, in the ring lines.
    pub dark: Vec3,
    /// Early wood, between them.
    pub light: Vec3,
    /// Which trunk.
    pub seed: u32,
}

impl Wood {
    #[inline]
    pub(super) fn eval(&self, uv: Vec2) -> Vec3 {
        let (row, y) = split(uv.y / self.plank);
        let shift = unit(lattice(row, 7, self.seed));
        let (column, x) = split(uv.x / self.length + shift);
        let plank = lattice(column, row, self.seed);
        // Rings are a function of the distance from a trunk axis that each plank has somewhere else.
        let off = Vec2::new(unit(plank) * 61.0, unit(plank.rotate_left(9)) * 37.0);
        let per_ring = self.ring.recip();
        let along = uv.x * per_ring * (1.0 / 18.0);
        let bend = value_noise(Vec2::new(along, uv.y * per_ring * (1.0 / 6.0)) + off, self.seed ^ 1);
        let (_, phase) = split(uv.y * per_ring + off.y + 4.0 * bend);
        // A ring darkens slowly and ends at once.
        let late = phase * phase * phase;
        let fibre = value_noise(Vec2::new(along * 6.0, uv.y * 9.0 * per_ring) + off, self.seed ^ 2);
        let tone = (0.55 * late + 0.35 * fibre + 0.1 * unit(plank.rotate_left(17))).min(1.0);
        let seam = (y.min(1.0 - y) * self.plank).min(x.min(1.0 - x) * self.length);
        let dim = if seam < 0.012 * self.plank { 0.35 } else { 0.82 + 0.18 * unit(plank.rotate_left(5)) };
        self.light.lerp(self.dark, tone) * dim
    }
}
