//! Vertex colours as textures: a scene's meshes carry none, but two by two texels per triangle hold three corners, and
//! between texels a texture is linear, as colours between vertices are.

use glam::{Vec2, Vec3};
use noisefloor_scenes::Mesh;
use noisefloor_scenes::texture::{ImageTexture, Wrap};

/// Triangles beside each other in the texture: few enough that coordinates resolve 1e-4 of a texel.
const ACROSS: usize = 512;

/// Distance of colours from 0 and 1: what rounding may add must not leave [0, 1].
const MARGIN: f32 = 1e-6;

/// Colours of the vertices of a mesh.
pub enum VertexColors {
    /// All the same.
    Constant(Vec3),
    /// One per vertex.
    Each(Vec<Vec3>),
}

impl VertexColors {
    /// Colours as they are in a file, each finite; clamped to [0, 1].
    pub fn new(colors: Vec<Vec3>) -> Self {
        let colors: Vec<Vec3> = colors.into_iter().map(|c| c.clamp(Vec3::ZERO, Vec3::ONE)).collect();
        match colors.split_first() {
            None => Self::Constant(Vec3::ONE),
            Some((first, rest)) if rest.iter().all(|c| c == first) => Self::Constant(*first),
            _ => Self::Each(colors),
        }
    }
}

/// Number of texels that the colours of so many triangles take.
pub fn texels(triangles: usize) -> usize {
    4 * ACROSS.min(triangles) * triangles.div_ceil(ACROSS)
}

/// The mesh with corners of its own for every triangle and the texture that its new coordinates look up; `factor` is
/// multiplied to every colour. The mesh has at least one triangle.
pub fn bake(mesh: &Mesh, colors: &[Vec3], factor: Vec3) -> (Mesh, ImageTexture) {
    let count = mesh.triangles.len();
    let (across, down) = (ACROSS.min(count), count.div_ceil(ACROSS));
    let (width, height) = (2 * across, 2 * down);
    let mut texels = vec![Vec3::ZERO; width * height];
    let mut out = Mesh { material: mesh.material, ..Mesh::default() };
    for (k, triangle) in mesh.triangles.iter().enumerate() {
        let corners = triangle.map(|i| i as usize);
        let (x, y) = (2 * (k % across), 2 * (k / across));
        let [a, b, c] = corners.map(|i| colors[i].clamp(Vec3::splat(MARGIN), Vec3::splat(1.0 - MARGIN)));
        let at = y * width + x;
        // The fourth is never reached alone, and makes the colour linear over the whole triangle.
        (texels[at], texels[at + 1], texels[at + width], texels[at + width + 1]) = (a, b, c, b + c - a);
        for (i, (right, below)) in corners.into_iter().zip([(0, 0), (1, 0), (0, 1)]) {
            out.positions.push(mesh.positions[i]);
            out.normals.extend(mesh.normals.get(i));
            let middle = Vec2::new((x + right) as f32 + 0.5, (y + below) as f32 + 0.5);
            out.uvs.push(middle / Vec2::new(width as f32, height as f32));
        }
        let first = 3 * k as u32;
        out.triangles.push([first, first + 1, first + 2]);
    }
    let texture = ImageTexture::new(width, height, texels.into(), [Wrap::Clamp; 2], factor);
    (out, texture.expect("as many texels as width times height, and neither is 0"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefloor_scenes::Texture;

    #[test]
    fn baked_colours_are_linear_over_every_triangle() {
        // More triangles than lie beside each other, with colours far apart.
        let n = ACROSS as u32 + 37;
        let hash = |i: u32| i.wrapping_mul(2_654_435_761) >> 24;
        let colors: Vec<Vec3> = (0..3 * n)
            .map(|i| Vec3::new(hash(i) as f32, hash(i + 7777) as f32, hash(2 * i + 1) as f32) / 255.0)
            .collect();
        let positions = (0..3 * n).map(|i| Vec3::new(i as f32, (i % 3) as f32, (i % 2) as f32)).collect();
        let triangles = (0..n).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh { positions, triangles, ..Mesh::default() };
        let (baked, texture) = bake(&mesh, &colors, Vec3::new(1.0, 0.5, 1.0));
        let texture = Texture::Image(texture);
        assert_eq!(baked.positions, mesh.positions);
        for (k, [p, q, r]) in baked.triangles.iter().map(|t| t.map(|i| baked.uvs[i as usize])).enumerate() {
            let [a, b, c] = [0, 1, 2].map(|i| colors[3 * k + i]);
            for (s, t) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.2, 0.3), (1.0 / 3.0, 1.0 / 3.0)]
            {
                let expected = (a * (1.0 - s - t) + b * s + c * t) * Vec3::new(1.0, 0.5, 1.0);
                let found = texture.eval(p * (1.0 - s - t) + q * s + r * t);
                // Texel coordinates below 2·ACROSS resolve 2·ACROSS·2⁻²⁴ each; colours differ by at most 2 there.
                let tolerance = 4.0 * 2.0 * ACROSS as f32 * f32::EPSILON + MARGIN;
                assert!(
                    (found - expected).abs().max_element() < tolerance,
                    "{k} {s} {t}: {found} {expected}"
                );
                assert!(found.min_element() >= 0.0);
            }
        }
    }
}
