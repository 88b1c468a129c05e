//! The serpent's head, in a frame of its own: the neck ends at the origin, the snout points to +Z, the crown to +Y.

use std::f32::consts::TAU;

use glam::{Affine3A, Vec2, Vec3};

use crate::Mesh;
use crate::shape::{Vertex, rounded_box, surface, tube};

/// Parts by material; about 1.1 long without the horns.
pub struct Head {
    pub skin: Mesh,
    pub horn: Mesh,
    pub eyes: Mesh,
    pub mouth: Mesh,
}

/// A cross-section: place along Z, height of its middle, half its width, half its height above and below the middle.
type Section = [f32; 5];

const SKULL: [Section; 10] = [
    [-0.3, 0.0, 0.15, 0.15, 0.15],
    [-0.12, 0.01, 0.2, 0.2, 0.19],
    [0.05, 0.03, 0.25, 0.21, 0.19],
    [0.22, 0.05, 0.265, 0.2, 0.13],
    [0.38, 0.04, 0.22, 0.15, 0.09],
    [0.55, 0.02, 0.155, 0.1, 0.07],
    [0.72, 0.01, 0.125, 0.085, 0.06],
    [0.86, 0.02, 0.13, 0.1, 0.06],
    [0.96, 0.01, 0.1, 0.08, 0.055],
    [1.02, 0.0, 0.0, 0.0, 0.0],
];

const JAW: [Section; 7] = [
    [-0.05, 0.0, 0.14, 0.04, 0.08],
    [0.1, 0.0, 0.185, 0.04, 0.085],
    [0.3, 0.0, 0.15, 0.035, 0.07],
    [0.5, 0.0, 0.11, 0.03, 0.055],
    [0.7, 0.0, 0.09, 0.03, 0.05],
    [0.8, 0.0, 0.065, 0.03, 0.045],
    [0.87, 0.0, 0.0, 0.0, 0.0],
];

pub fn head() -> Head {
    // The jaw hangs open about its hinge.
    let hinge = Affine3A::from_translation(Vec3::new(0.0, -0.1, 0.06)) * Affine3A::from_rotation_x(0.36);
    let jaw = loft(&JAW, 24, 48).transformed(hinge);
    let mut skin = Mesh::joined([loft(&SKULL, 48, 90), jaw]);
    let mut horn = Mesh::default();
    let mut eyes = Mesh::default();
    for side in [-1.0, 1.0] {
        let at = |x: f32, y: f32, z: f32| Vec3::new(side * x, y, z);
        // Brow and nostril.
        skin.append(spine(at(0.12, 0.17, 0.5), at(0.27, 0.22, 0.38), at(0.24, 0.2, 0.08), 0.045, 0.02));
        skin.append(spine(at(0.03, 0.1, 0.94), at(0.09, 0.15, 0.92), at(0.1, 0.07, 0.82), 0.022, 0.02));
        eyes.append(rounded_box(Vec3::splat(0.058), 0.058, 5).translated(at(0.185, 0.115, 0.385)));
        horn.append(spine(at(0.13, 0.16, 0.02), at(0.3, 0.5, -0.2), at(0.26, 0.62, -0.75), 0.062, 0.005));
        horn.append(spine(at(0.2, 0.1, -0.04), at(0.42, 0.22, -0.2), at(0.46, 0.2, -0.52), 0.045, 0.004));
        // Frill of spikes behind the cheek.
        for k in 0..4 {
            let y = 0.02 - 0.07 * k as f32;
            let long = 0.36 - 0.05 * k as f32;
            let tip = at(0.22 + 0.6 * long, 1.7 * y, 0.02 - long);
            horn.append(spine(
                at(0.19 - 0.02 * k as f32, y, 0.06),
                at(0.34, 1.4 * y, 0.0),
                tip,
                0.035,
                0.003,
            ));
        }
        // Teeth: down from the upper jaw, up from the lower one.
        for k in 0..9 {
            let z = 0.42 + 0.062 * k as f32;
            let long = if k == 6 { 0.13 } else { 0.055 + 0.012 * (k % 3) as f32 };
            let root = at(0.175 - 0.011 * k as f32, -0.025, z);
            horn.append(cone(root, root - Vec3::Y * long, 0.016));
            let root = at(0.125 - 0.0075 * k as f32, 0.015, z - 0.08);
            let tooth = cone(root, root + Vec3::Y * (0.8 * long), 0.013);
            horn.append(tooth.transformed(hinge));
        }
        // Whiskers that float beside the snout.
        horn.append(spine(at(0.1, 0.0, 0.84), at(0.55, -0.1, 1.0), at(0.62, -0.75, 0.72), 0.016, 0.003));
    }
    let tongue = spine(
        Vec3::new(0.0, 0.03, 0.1),
        Vec3::new(0.0, 0.09, 0.5),
        Vec3::new(0.02, -0.02, 0.98),
        0.045,
        0.006,
    );
    Head { skin, horn, eyes, mouth: tongue.transformed(hinge) }
}

/// A tapering tube along the quadratic curve from `a` towards `b` and to `c`, slightly ringed.
fn spine(a: Vec3, b: Vec3, c: Vec3, thick: f32, thin: f32) -> Mesh {
    let steps = 28;
    let share = |i: u32| i as f32 / steps as f32;
    let path: Vec<Vec3> =
        (0..=steps).map(|i| a.lerp(b, share(i)).lerp(b.lerp(c, share(i)), share(i))).collect();
    let radii: Vec<f32> = (0..=steps)
        .map(|i| {
            let ring = if i % 2 == 0 { 1.0 } else { 0.93 };
            ring * (thick + (thin - thick) * share(i))
        })
        .collect();
    tube(&path, &radii, 12)
}

fn cone(root: Vec3, tip: Vec3, thick: f32) -> Mesh {
    tube(&[root, root.lerp(tip, 0.6), tip], &[thick, 0.6 * thick, 0.08 * thick], 6)
}

/// A closed skin through the cross-sections, blended smoothly from one to the next.
fn loft(sections: &[Section], columns: u32, rows: u32) -> Mesh {
    let pieces = (sections.len() - 1) as f32;
    let at = |v: f32| {
        let k = ((v * pieces) as usize).min(sections.len() - 2);
        let t = v * pieces - k as f32;
        // Catmull-Rom without overshoot to negative sizes.
        let (a, b, c, d) = (
            &sections[k.saturating_sub(1)],
            &sections[k],
            &sections[k + 1],
            &sections[(k + 2).min(sections.len() - 1)],
        );
        let mut out = [0.0; 5];
        for (n, value) in out.iter_mut().enumerate() {
            let (m0, m1) = (0.5 * (c[n] - a[n]), 0.5 * (d[n] - b[n]));
            let (t2, t3) = (t * t, t * t * t);
            let smooth = (2.0 * t3 - 3.0 * t2 + 1.0) * b[n] + (t3 - 2.0 * t2 + t) * m0;
            *value = smooth + (3.0 * t2 - 2.0 * t3) * c[n] + (t3 - t2) * m1;
        }
        out[2..].iter_mut().for_each(|size| *size = size.max(0.0));
        out
    };
    let point = |u: f32, v: f32| {
        let [z, y, width, above, below] = at(v);
        let (sin, cos) = (TAU * u).sin_cos();
        let height = if sin > 0.0 { above } else { below };
        Vec3::new(width * cos, y + height * sin, z)
    };
    surface(columns, rows, |i, j| {
        let (u, v) = ((i % columns) as f32 / columns as f32, j as f32 / rows as f32);
        Vertex { position: point(u, v), normal: Vec3::Y, uv: Vec2::new(u, v) }
    })
    .smoothed()
}
