use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::surface::{Vertex, push_unless_degenerate, surface};
use crate::Mesh;

/// A round tube along `path` (at least two points, no two equal neighbours) with a radius per point, closed at both
/// ends by flat caps. u runs around, v along, both as lengths.
#[must_use]
pub fn tube(path: &[Vec3], radii: &[f32], sides: u32) -> Mesh {
    let n = sides.max(3);
    let last = path.len() - 1;
    let tangent = |k: usize| (path[(k + 1).min(last)] - path[k.saturating_sub(1)]).normalize();
    // Carry one perpendicular along the path, so that the tube does not twist.
    let mut frames: Vec<(Vec3, Vec3)> = Vec::with_capacity(path.len());
    let mut side = tangent(0).any_orthonormal_vector();
    let mut lengths = vec![0.0];
    for k in 0..path.len() {
        let t = tangent(k);
        side = (side - t * side.dot(t)).try_normalize().unwrap_or_else(|| t.any_orthonormal_vector());
        frames.push((side, t.cross(side)));
        if k > 0 {
            lengths.push(lengths[k - 1] + path[k].distance(path[k - 1]));
        }
    }
    let radius = |k: usize| radii[k.min(radii.len() - 1)];
    let around = |i: u32, k: usize| {
        let (sin, cos) = (TAU * (i % n) as f32 / n as f32).sin_cos();
        frames[k].0 * cos + frames[k].1 * sin
    };
    let mut mesh = surface(n, last as u32, |i, j| {
        let k = j as usize;
        let normal = around(i, k);
        Vertex {
            position: path[k] + normal * radius(k),
            normal,
            uv: Vec2::new(TAU * radii[0] * i as f32 / n as f32, lengths[k]),
        }
    });
    for (k, sign) in [(0, -1.0), (last, 1.0)] {
        let rim: Vec<Vec3> = (0..n).map(|i| path[k] + around(i, k) * radius(k)).collect();
        mesh.append(fan(path[k], &rim, tangent(k) * sign, |p| {
            Vec2::new((p - path[k]).dot(frames[k].0), (p - path[k]).dot(frames[k].1))
        }));
    }
    mesh
}

/// A flat disc of any star-shaped outline: triangles from `center` to the closed `rim`, facing `normal`.
#[must_use]
pub fn fan(center: Vec3, rim: &[Vec3], normal: Vec3, uv: impl Fn(Vec3) -> Vec2) -> Mesh {
    let mut mesh = Mesh::default();
    for &p in [center].iter().chain(rim) {
        mesh.positions.push(p);
        mesh.normals.push(normal);
        mesh.uvs.push(uv(p));
    }
    let n = rim.len() as u32;
    for i in 0..n {
        let (a, b) = (1 + i, 1 + (i + 1) % n);
        let face = (rim[i as usize] - center).cross(rim[(b - 1) as usize] - center);
        let triangle = if face.dot(normal) > 0.0 { [0, a, b] } else { [0, b, a] };
        push_unless_degenerate(&mut mesh, triangle);
    }
    mesh
}

/// A slab with a star-shaped `outline` (counter-clockwise, about the origin of the XY plane) from z = −`depth`/2 to
/// +`depth`/2: its two faces, and its rim apart, so that each can have its own material. Faces have the outline's
/// coordinates as texture coordinates; on the rim u runs along the outline, v across.
#[must_use]
pub fn slab(outline: &[Vec2], depth: f32) -> (Mesh, Mesh) {
    let n = outline.len();
    let half = 0.5 * depth;
    let ring = |z: f32| outline.iter().map(|p| p.extend(z)).collect::<Vec<_>>();
    let faces = Mesh::joined(
        [(half, Vec3::Z), (-half, -Vec3::Z)]
            .map(|(z, normal)| fan(Vec3::Z * z, &ring(z), normal, |p| p.truncate())),
    );
    let mut run = vec![0.0];
    for i in 0..n {
        run.push(run[i] + outline[i].distance(outline[(i + 1) % n]));
    }
    let rim = surface(n as u32, 1, |i, j| {
        let k = i as usize;
        let (before, here, after) = (outline[(k + n - 1) % n], outline[k % n], outline[(k + 1) % n]);
        let along = after - before;
        Vertex {
            position: here.extend(if j == 0 { -half } else { half }),
            normal: Vec3::new(along.y, -along.x, 0.0),
            uv: Vec2::new(run[k], depth * j as f32),
        }
    });
    (faces, rim)
}
