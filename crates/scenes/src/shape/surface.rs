use glam::{Vec2, Vec3};

use crate::Mesh;

/// One vertex of a parametric surface.
#[derive(Debug, Clone, Copy)]
pub struct Vertex {
    /// Where it is.
    pub position: Vec3,
    /// Outward direction; any length above 0.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
}

/// A grid of `columns` × `rows` cells; `vertex(i, j)` is called for 0 ≤ i ≤ `columns`, 0 ≤ j ≤ `rows`. Seen from the
/// front, i grows to the right and j upwards. Triangles that degenerate (at a pole) are left out.
#[must_use]
pub fn surface(columns: u32, rows: u32, vertex: impl Fn(u32, u32) -> Vertex) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..=rows {
        for i in 0..=columns {
            let v = vertex(i, j);
            mesh.positions.push(v.position);
            mesh.normals.push(v.normal.normalize());
            mesh.uvs.push(v.uv);
        }
    }
    let at = |i: u32, j: u32| j * (columns + 1) + i;
    for j in 0..rows {
        for i in 0..columns {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            push_unless_degenerate(&mut mesh, [a, b, c]);
            push_unless_degenerate(&mut mesh, [a, c, d]);
        }
    }
    mesh
}

/// Two corners closer than this share of the longest side count as one.
const SAME: f32 = 1e-5;

pub(super) fn push_unless_degenerate(mesh: &mut Mesh, triangle: [u32; 3]) {
    let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
    let sides = [a.distance(b), b.distance(c), c.distance(a)];
    let longest = sides[0].max(sides[1]).max(sides[2]);
    if sides.iter().all(|side| *side > SAME * longest) {
        mesh.triangles.push(triangle);
    }
}
