//! A column with base and leafy capital; lengths in metres.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, arc, lathe, rounded_box, surface};

/// Height of a [`column`] with its impost.
pub const COLUMN_HEIGHT: f32 = 4.6;

/// Parts of a column that stands on the origin.
pub struct Column {
    /// Shaft.
    pub shaft: Mesh,
    /// Base, capital and impost.
    pub stone: Mesh,
}

/// A round column with attic base, swelling shaft and a capital of two rows of leaves.
pub fn column() -> Column {
    let swell = |t: f32| 0.37 - 0.02 * t - 0.045 * t * t;
    let shaft: Vec<Vec2> =
        (0..=8).map(|k| k as f32 / 8.0).map(|t| Vec2::new(swell(t), 0.55 + 3.1 * t)).collect();
    let mut base = arc(Vec2::new(0.45, 0.29), 0.09, -90.0, 90.0, 8);
    base.extend(arc(Vec2::new(0.46, 0.43), 0.05, 210.0, 150.0, 3));
    base.extend(arc(Vec2::new(0.4, 0.5), 0.045, -90.0, 90.0, 6));
    base.push(Vec2::new(0.36, 0.58));
    let mut capital = arc(Vec2::new(0.3, 3.67), 0.045, -90.0, 90.0, 6);
    capital.extend((0..=6).map(|k| bell(k as f32 / 6.0)));
    let square = |half: f32, low: f32, high: f32| {
        let size = Vec3::new(half, 0.5 * (high - low), half);
        rounded_box(size, 0.02, 1).translated(Vec3::Y * (0.5 * (low + high)))
    };
    let mut stone = Mesh::joined([
        square(0.56, 0.0, 0.2),
        lathe(&base, 28),
        lathe(&capital, 28),
        square(0.55, 4.25, 4.38),
        square(0.5, 4.38, COLUMN_HEIGHT),
    ]);
    for k in 0..8 {
        let turn = TAU * k as f32 / 8.0;
        stone.append(leaf(turn, 0.0, 0.62));
        stone.append(leaf(turn + TAU / 16.0, 0.38, 0.62));
    }
    Column { shaft: lathe(&shaft, 28), stone }
}

/// Radius and height of the capital's bell at `t` in [0, 1].
fn bell(t: f32) -> Vec2 {
    Vec2::new(0.3 + 0.06 * t + 0.16 * t.powi(4), 3.72 + 0.55 * t)
}

/// A leaf on the bell at an angle about Y, from `from` over `length` (shares of the bell's height), its tip curled
/// outwards.
fn leaf(turn: f32, from: f32, length: f32) -> Mesh {
    let (across, along) = (6, 8);
    let at = |x: f32, t: f32| {
        let on_bell = bell(from + length * (t - 0.15 * t.powi(4)));
        // Thicker along the rib, thin at the rims, the tip bent away from the bell.
        let radius = on_bell.x + 0.035 - 0.025 * x * x + 0.11 * t.powi(3);
        let width = 0.13 * (0.75 + 0.6 * t - 1.05 * t.powi(3)).max(0.0);
        let angle = turn + x * width / radius;
        Vec3::new(radius * angle.sin(), on_bell.y, radius * angle.cos())
    };
    let mut mesh = surface(across, along, |i, j| {
        let (x, t) = (2.0 * i as f32 / across as f32 - 1.0, j as f32 / along as f32);
        // The normal is only a placeholder.
        Vertex { position: at(x, t), normal: Vec3::Y, uv: Vec2::new(0.13 * x, t * length) }
    });
    // Mean of the triangles around each vertex, by area: the tip is too strongly bent for the normal of the formula.
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
        t.iter().for_each(|&i| normals[i as usize] += (b - a).cross(c - a));
    }
    mesh.normals = normals.iter().map(|n| n.normalize()).collect();
    mesh
}
