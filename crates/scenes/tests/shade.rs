//! The outdoor scene is about indirect light: what the camera sees must lie in shade. Checked by tracing a few rays
//! against every triangle, without any renderer.

use glam::Vec3;
use noisefloor_scenes::{Scene, find};

/// Distance along `direction` to the nearest triangle in front of `origin` (Möller and Trumbore 1997), and that
/// triangle's front side.
fn nearest(scene: &Scene, origin: Vec3, direction: Vec3) -> Option<(f32, Vec3)> {
    let mut best: Option<(f32, Vec3)> = None;
    for mesh in &scene.meshes {
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let (u, v) = (b - a, c - a);
            let p = direction.cross(v);
            let determinant = u.dot(p);
            if determinant == 0.0 {
                continue;
            }
            let to = origin - a;
            let x = to.dot(p) / determinant;
            let q = to.cross(u);
            let y = direction.dot(q) / determinant;
            let distance = v.dot(q) / determinant;
            if x >= 0.0
                && y >= 0.0
                && x + y <= 1.0
                && distance > 1e-4
                && best.is_none_or(|(d, _)| distance < d)
            {
                best = Some((distance, u.cross(v)));
            }
        }
    }
    best
}

#[test]
fn most_of_the_courtyard_in_view_is_in_shade_but_not_all() {
    let scene = (find("outdoor").expect("built in").build)();
    let sun = scene.sun.expect("it has one").direction;
    let camera = &scene.camera;
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let half = (0.5 * camera.vertical_fov_degrees).to_radians().tan();
    let (columns, rows) = (20, 15);
    let (mut surfaces, mut lit) = (0, 0);
    for j in 0..rows {
        for i in 0..columns {
            let x = ((i as f32 + 0.5) / columns as f32 * 2.0 - 1.0) * half * columns as f32 / rows as f32;
            let y = (1.0 - (j as f32 + 0.5) / rows as f32 * 2.0) * half;
            let direction = (forward + right * x + up * y).normalize();
            let Some((distance, normal)) = nearest(&scene, camera.eye, direction) else { continue };
            let side = if normal.dot(direction) < 0.0 { normal } else { -normal };
            let point = camera.eye + direction * distance + side.normalize() * 1e-4;
            surfaces += 1;
            lit += usize::from(side.dot(sun) > 0.0 && nearest(&scene, point, sun).is_none());
        }
    }
    assert!(surfaces > 270, "only {surfaces} of 300 rays hit something");
    let share = f64::from(lit as u32) / f64::from(surfaces);
    assert!(share > 0.02 && share < 0.2, "{lit} of {surfaces} points are in the sun");
}
