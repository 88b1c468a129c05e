//! Walls, windows and arches of a Romanesque church; lengths in metres.
//!
//! Walls lie in the XY plane: the front looks along +Z at z = 0, x and y from 0, their thickness goes to −Z.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, cuboid, fan, quad, surface};

/// An opening with a round head, in the middle of a wall.
#[derive(Clone, Copy)]
pub struct Opening {
    /// Half its width, which is the radius of its head.
    pub half: f32,
    /// Height of its lower edge.
    pub sill: f32,
    /// Height at which the head begins.
    pub spring: f32,
}

/// Steps of a half circle.
const STEPS: u32 = 24;

/// Point of a half circle about the origin, from its left end (i = 0) over the top to its right end.
fn half_circle(i: u32) -> Vec2 {
    Vec2::from_angle(PI * (STEPS - i) as f32 / STEPS as f32)
}

impl Opening {
    /// The front of a wall of `size` with this opening.
    pub fn face(self, size: Vec2) -> Mesh {
        let flat = |p: Vec2| Vertex { position: p.extend(0.0), normal: Vec3::Z, uv: p };
        let block = |low: Vec2, high: Vec2| {
            surface(1, 1, |i, j| flat(low + (high - low) * Vec2::new(i as f32, j as f32)))
        };
        let (left, right) = (0.5 * size.x - self.half, 0.5 * size.x + self.half);
        let mut mesh = Mesh::joined(
            [(0.0, left), (right, size.x)]
                .map(|(from, to)| block(Vec2::new(from, self.sill), Vec2::new(to, size.y))),
        );
        if self.sill > 0.0 {
            mesh.append(block(Vec2::ZERO, Vec2::new(size.x, self.sill)));
        }
        let middle = Vec2::new(0.5 * size.x, self.spring);
        mesh.append(surface(STEPS, 1, |i, j| {
            let p = middle + self.half * half_circle(i);
            flat(if j == 0 { p } else { Vec2::new(p.x, size.y) })
        }));
        mesh
    }

    /// The sides of the opening through a wall of `width` and `depth`, and its sill.
    pub fn reveal(self, width: f32, depth: f32) -> Mesh {
        let middle = 0.5 * width;
        // Up on the right, over the head, down on the left; the second corner of each jamb is the head's first point.
        let outline = |i: u32| match i {
            0 => (Vec2::new(middle + self.half, self.sill), -Vec2::X),
            i if i == STEPS + 2 => (Vec2::new(middle - self.half, self.sill), Vec2::X),
            i => {
                let radial = half_circle(STEPS + 1 - i);
                (Vec2::new(middle, self.spring) + self.half * radial, -radial)
            }
        };
        let mut run = vec![0.0];
        for i in 1..=STEPS + 2 {
            run.push(run[i as usize - 1] + outline(i).0.distance(outline(i - 1).0));
        }
        let mut mesh = surface(STEPS + 2, 1, |i, j| {
            let (p, normal) = outline(i);
            let back = depth * j as f32;
            Vertex {
                position: p.extend(-back),
                normal: normal.extend(0.0),
                uv: Vec2::new(back, run[i as usize]),
            }
        });
        let corner = Vec3::new(middle - self.half, self.sill, 0.0);
        mesh.append(quad(corner, Vec3::X * (2.0 * self.half), Vec3::Z * -depth));
        mesh
    }

    /// Leaded glass at z = −`depth`: panes of three kinds, and the cames between them.
    pub fn glazing(self, width: f32, depth: f32, rows: u32) -> ([Mesh; 3], Mesh) {
        const COLUMNS: u32 = 3;
        let mut panes = [Mesh::default(), Mesh::default(), Mesh::default()];
        let corner = Vec3::new(0.5 * width - self.half, self.sill, -depth);
        let cell = Vec2::new(2.0 * self.half / COLUMNS as f32, (self.spring - self.sill) / rows as f32);
        for row in 0..rows {
            for column in 0..COLUMNS {
                let at = corner + (cell * Vec2::new(column as f32, row as f32)).extend(0.0);
                // A light field between coloured borders, with a coloured pane now and then.
                let border = column != 1;
                let kind = if border { 1 + (row + column / 2) % 2 } else { u32::from(row % 4 == 3) };
                panes[kind as usize].append(quad(at, Vec3::X * cell.x, Vec3::Y * cell.y));
            }
        }
        let hub = Vec3::new(0.5 * width, self.spring, -depth);
        let mut bars = Mesh::default();
        let half = 0.012;
        for sector in 0..6 {
            let each = STEPS / 6;
            let mut rim: Vec<Vec3> = (sector * each..=(sector + 1) * each)
                .map(|i| hub + (self.half * half_circle(i)).extend(0.0))
                .collect();
            let middle = rim.iter().fold(hub, |sum, p| sum + *p) / (rim.len() + 1) as f32;
            rim.push(hub);
            let glass = fan(middle, &rim, Vec3::Z, |p| p.truncate());
            panes[(sector % 3) as usize].append(glass);
            if sector > 0 {
                let turn = glam::Affine3A::from_rotation_z(PI * sector as f32 / 6.0);
                let spoke = cuboid(Vec3::new(0.0, -half, 0.0), Vec3::new(self.half, half, 2.0 * half));
                bars.append(spoke.transformed(turn).translated(hub));
            }
        }
        let tall = self.spring - self.sill;
        for column in 1..COLUMNS {
            let at = corner + Vec3::X * (cell.x * column as f32);
            bars.append(cuboid(at - Vec3::X * half, at + Vec3::new(half, tall, 2.0 * half)));
        }
        for row in 1..=rows {
            let at = corner + Vec3::Y * (cell.y * row as f32);
            bars.append(cuboid(at - Vec3::Y * half, at + Vec3::new(2.0 * self.half, half, 2.0 * half)));
        }
        (panes, bars)
    }
}

/// A half ring over the origin in the XY plane with rectangular section, from z = 0 to −`depth`: an arch of stones or
/// a rib. v runs along it.
pub fn band(inner: f32, outer: f32, depth: f32) -> Mesh {
    let sheet = |ends: [(f32, f32); 2], normal: fn(Vec2) -> Vec3, reverse: bool| {
        surface(STEPS, 1, |i, j| {
            let step = if reverse { STEPS - i } else { i };
            let (radius, back) = ends[j as usize];
            Vertex {
                position: (half_circle(step) * radius).extend(-back),
                normal: normal(half_circle(step)),
                uv: Vec2::new(radius - back, PI * outer * step as f32 / STEPS as f32),
            }
        })
    };
    Mesh::joined([
        sheet([(inner, 0.0), (outer, 0.0)], |_| Vec3::Z, false),
        sheet([(inner, depth), (outer, depth)], |_| -Vec3::Z, true),
        sheet([(outer, 0.0), (outer, depth)], |p| p.extend(0.0), false),
        sheet([(inner, depth), (inner, 0.0)], |p| -p.extend(0.0), false),
    ])
}
