use std::collections::HashMap;

use glam::Vec3;

use crate::Mesh;

impl Mesh {
    /// With normals anew from the triangles around each vertex, weighted by their areas. Vertices at exactly one place
    /// count as one, so a surface that closes on itself shows no seam.
    #[must_use]
    pub fn smoothed(mut self) -> Self {
        // Adding zero makes the two zeros one.
        let place = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut sums: HashMap<[u32; 3], Vec3> = HashMap::new();
        for t in &self.triangles {
            let corners = t.map(|i| self.positions[i as usize]);
            let face = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            corners.iter().for_each(|&p| *sums.entry(place(p)).or_default() += face);
        }
        let normal = |p: &Vec3| sums.get(&place(*p)).map_or(Vec3::Y, |sum| sum.normalize_or(Vec3::Y));
        self.normals = self.positions.iter().map(normal).collect();
        self
    }
}
