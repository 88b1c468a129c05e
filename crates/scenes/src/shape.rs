//! Mesh builders.
//!
//! Every builder fills positions, unit normals and texture coordinates; triangles are counter-clockwise seen from
//! outside, and texture coordinates are lengths in scene units unless a builder says otherwise, so that one brick is
//! as large on a wide wall as on a narrow one.

mod flat;
mod plant;
mod round;
mod smooth;
mod surface;
mod sweep;
mod teapot;
#[cfg(test)]
mod tests;

pub use flat::{cuboid, polygon, quad};
pub use plant::LeafShape;
pub use round::{arc, cylinder, lathe, rounded_box};
pub use surface::{Vertex, surface};
pub use sweep::{fan, slab, tube};
pub use teapot::teapot;

use glam::{Affine3A, Vec3, Vec3A};

use crate::Mesh;

impl Mesh {
    /// Moved by `map`, which must not mirror. Normals follow the inverse transpose.
    #[must_use]
    pub fn transformed(mut self, map: Affine3A) -> Self {
        let normals = map.matrix3.inverse().transpose();
        for p in &mut self.positions {
            *p = map.transform_point3(*p);
        }
        for n in &mut self.normals {
            *n = Vec3::from(normals * Vec3A::from(*n)).normalize();
        }
        self
    }

    /// Moved by `offset`.
    #[must_use]
    pub fn translated(mut self, offset: Vec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p += offset);
        self
    }

    /// Turned about the vertical axis by `degrees`, counter-clockwise seen from above.
    #[must_use]
    pub fn turned(self, degrees: f32) -> Self {
        self.transformed(Affine3A::from_rotation_y(degrees.to_radians()))
    }

    /// Front and back exchanged.
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        self.normals.iter_mut().for_each(|n| *n = -*n);
        self
    }

    /// Appends the triangles of `other`, which must have normals and texture coordinates exactly if `self` has.
    pub fn append(&mut self, other: Self) {
        let base = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.uvs.extend(other.uvs);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base)));
    }

    /// All of `parts` as one mesh.
    #[must_use]
    pub fn joined(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut all = Self::default();
        parts.into_iter().for_each(|part| all.append(part));
        all
    }
}
