//! Pots, shrubs and climbers; lengths in metres, each standing on the origin.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};

use crate::Mesh;
use crate::hash::Placement;
use crate::shape::{LeafShape, arc, lathe, tube};

/// How a shrub grows.
#[derive(Clone, Copy)]
pub struct Habit {
    /// Length of the first branches; every fork shortens them by about a third.
    pub branch: f32,
    /// Forks from the stem to the last twigs.
    pub forks: u32,
    /// Angle in degrees by which a branch leaves its parent, at most.
    pub spread: f32,
    /// Leaves per last twig.
    pub leaves: u32,
    /// Length and width of a leaf.
    pub leaf: Vec2,
    /// Which plant.
    pub seed: u32,
}

/// Wood and leaves of a shrub.
pub fn shrub(habit: Habit) -> (Mesh, Mesh) {
    let mut growth = Growth { habit, placement: Placement::new(habit.seed), wood: vec![], leaves: vec![] };
    for stem in 0..4 {
        let turn = TAU * (stem as f32 + growth.placement.unit()) / 4.0;
        let lean = Vec3::new(0.35 * turn.cos(), 1.0, 0.35 * turn.sin()).normalize();
        growth.grow(Vec3::new(0.05 * turn.cos(), 0.0, 0.05 * turn.sin()), lean, habit.branch, 0);
    }
    (Mesh::joined(growth.wood), Mesh::joined(growth.leaves))
}

struct Growth {
    habit: Habit,
    placement: Placement,
    wood: Vec<Mesh>,
    leaves: Vec<Mesh>,
}

impl Growth {
    fn grow(&mut self, base: Vec3, direction: Vec3, length: f32, depth: u32) {
        let bend = self.around(direction, 12.0);
        // Twigs turn towards the light.
        let end = (direction + bend + 0.12 * Vec3::Y).normalize();
        let middle = base + direction * (0.5 * length);
        let tip = middle + end * (0.5 * length);
        let thick = 0.055 * length;
        let sides = if depth < 2 { 6 } else { 3 };
        self.wood.push(tube(&[base, middle, tip], &[thick, 0.8 * thick, 0.6 * thick], sides));
        if depth == self.habit.forks {
            self.foliage(base, middle, tip, end);
            return;
        }
        for child in 0..3 {
            let from = if child == 0 { tip } else { base.lerp(tip, self.placement.range(0.35, 1.0)) };
            let out = self.around(end, self.habit.spread);
            let shorter = length * self.placement.range(0.58, 0.78);
            self.grow(from, out, shorter, depth + 1);
        }
    }

    fn foliage(&mut self, base: Vec3, middle: Vec3, tip: Vec3, direction: Vec3) {
        for k in 0..self.habit.leaves {
            let t = (k as f32 + self.placement.unit()) / self.habit.leaves as f32;
            let at = if t < 0.5 { base.lerp(middle, 2.0 * t) } else { middle.lerp(tip, 2.0 * t - 1.0) };
            let along = self.around(direction, 75.0);
            let size = self.placement.range(0.7, 1.15);
            let leaf = LeafShape {
                base: at + along * 0.012,
                along,
                up: self.around(Vec3::Y, 35.0),
                length: self.habit.leaf.x * size,
                width: self.habit.leaf.y * size,
                droop: self.placement.range(0.05, 0.35),
                fold: self.placement.range(0.02, 0.18),
            };
            self.leaves.push(leaf.mesh(self.leaves.len() as u32));
        }
    }

    /// A unit vector within `degrees` of `axis`.
    fn around(&mut self, axis: Vec3, degrees: f32) -> Vec3 {
        let side = axis.any_orthonormal_vector();
        let turn = Quat::from_axis_angle(axis, TAU * self.placement.unit());
        let tilt = (degrees * self.placement.unit().sqrt()).to_radians();
        (turn * (axis * tilt.cos() + side * tilt.sin())).normalize()
    }
}

/// Leaves of a climber on the wall z = 0, up to `height` over a stretch of `width` about the origin: dense at the
/// foot, ragged towards the top.
pub fn climber(width: f32, height: f32, leaves: u32, seed: u32) -> Mesh {
    let mut placement = Placement::new(seed);
    let meshes = (0..leaves).map(|number| {
        let y = height * placement.unit().powf(1.3);
        // Runners: leaves gather along a few wavering lines.
        let runner = (placement.unit() * 7.0).floor();
        let waver = (1.7 * y + 2.1 * runner).sin() * 0.12 + (4.1 * y + runner).sin() * 0.05;
        let x = width * ((runner + 0.5) / 7.0 - 0.5) * (1.0 + 0.3 * y / height) + waver;
        let spread = 0.16 * (1.0 - 0.6 * y / height);
        let base = Vec3::new(
            x + placement.range(-spread, spread),
            y + placement.range(-0.05, 0.05),
            placement.range(0.015, 0.09),
        );
        LeafShape {
            base: base.max(Vec3::new(f32::MIN, 0.06, 0.0)),
            along: Vec3::new(
                placement.range(-0.9, 0.9),
                placement.range(-1.0, 0.25),
                placement.range(0.1, 0.5),
            ),
            up: Vec3::new(placement.range(-0.3, 0.3), 0.5, 1.0),
            length: placement.range(0.05, 0.085),
            width: placement.range(0.045, 0.07),
            droop: 0.12,
            fold: 0.08,
        }
        .mesh(number)
    });
    Mesh::joined(meshes)
}

/// Leaves lying loosely in a layer over the rectangle `low` to `high`, gathered in patches.
pub fn canopy(low: Vec3, high: Vec3, leaves: u32, seed: u32) -> Mesh {
    let mut placement = Placement::new(seed);
    let mut inside = |from: Vec3, to: Vec3| {
        let t = Vec3::new(placement.unit(), placement.unit(), placement.unit());
        from + (to - from) * t
    };
    let patches: Vec<Vec3> = (0..14).map(|_| inside(low, high)).collect();
    let meshes = (0..leaves).map(|number| {
        let reach = Vec3::new(0.45, 0.06, 0.3);
        let patch = patches[number as usize % patches.len()];
        let offset = inside(-reach, reach) + inside(-reach, reach);
        LeafShape {
            base: patch + 0.5 * offset,
            along: inside(Vec3::new(-1.0, -0.6, -1.0), Vec3::new(1.0, 0.1, 1.0)),
            up: inside(Vec3::new(-0.4, 1.0, -0.4), Vec3::new(0.4, 1.0, 0.4)),
            length: 0.09,
            width: 0.065,
            droop: 0.2,
            fold: 0.1,
        }
        .mesh(number)
    });
    Mesh::joined(meshes)
}

/// A flower pot, 0.5 high, and its soil.
pub fn pot() -> (Mesh, Mesh) {
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.2, 0.0)];
    profile.extend([Vec2::new(0.27, 0.2), Vec2::new(0.3, 0.4), Vec2::new(0.34, 0.41)]);
    profile.extend(arc(Vec2::new(0.33, 0.48), 0.02, 0.0, 180.0, 4));
    profile.extend([Vec2::new(0.29, 0.4), Vec2::new(0.0, 0.4)]);
    let soil = [Vec2::new(0.295, 0.44), Vec2::new(0.0, 0.46)];
    (lathe(&profile, 40), lathe(&soil, 24))
}
