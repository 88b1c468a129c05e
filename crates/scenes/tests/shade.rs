//! The outdoor scene and the bathroom are about indirect light: what the camera sees must lie in shade. Checked by
//! tracing a few rays against every triangle, without any renderer.

use glam::Vec3;
use noisefloor_scenes::{Mesh, Scene, find};

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

/// What a grid of 20 × 15 rays from the camera meets: points just above the surface, with the side that is seen.
fn in_view(scene: &Scene) -> Vec<(Vec3, Vec3)> {
    let camera = &scene.camera;
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let half = (0.5 * camera.vertical_fov_degrees).to_radians().tan();
    let (columns, rows) = (20, 15);
    let mut points = vec![];
    for j in 0..rows {
        for i in 0..columns {
            let x = ((i as f32 + 0.5) / columns as f32 * 2.0 - 1.0) * half * columns as f32 / rows as f32;
            let y = (1.0 - (j as f32 + 0.5) / rows as f32 * 2.0) * half;
            let direction = (forward + right * x + up * y).normalize();
            let Some((distance, normal)) = nearest(scene, camera.eye, direction) else { continue };
            let side = if normal.dot(direction) < 0.0 { normal } else { -normal };
            points.push((camera.eye + direction * distance + side.normalize() * 1e-4, side));
        }
    }
    points
}

#[test]
fn most_of_the_courtyard_in_view_is_in_shade_but_not_all() {
    let scene = (find("outdoor").expect("built in").build)();
    let sun = scene.sun.expect("it has one").direction;
    let points = in_view(&scene);
    let surfaces = points.len();
    let in_sun =
        |(point, side): &&(Vec3, Vec3)| side.dot(sun) > 0.0 && nearest(&scene, *point, sun).is_none();
    let lit = points.iter().filter(in_sun).count();
    assert!(surfaces > 270, "only {surfaces} of 300 rays hit something");
    let share = lit as f64 / surfaces as f64;
    assert!(share > 0.02 && share < 0.2, "{lit} of {surfaces} points are in the sun");
}

#[test]
fn the_bathroom_in_view_is_lit_by_its_brightest_lamp_by_way_of_the_ceiling_only() {
    let scene = (find("bathroom").expect("built in").build)();
    let points = in_view(&scene);
    assert_eq!(points.len(), 300, "the room is closed");
    let lamps = scene.meshes.iter().filter(|m| scene.materials[m.material].emission != Vec3::ZERO);
    let lamp = lamps
        .max_by(|a, b| {
            let red = |m: &Mesh| scene.materials[m.material].emission.x;
            red(a).total_cmp(&red(b))
        })
        .expect("it has lamps");
    let [a, b, c] = lamp.triangles[0].map(|i| lamp.positions[i as usize]);
    let (middle, front) = (0.5 * (a + c), (b - a).cross(c - a));
    let sees = |point: Vec3, side: Vec3| {
        let to = middle - point;
        let open = nearest(&scene, point, to).is_none_or(|(distance, _)| distance > 1.0 - 1e-3);
        side.dot(to) > 0.0 && front.dot(to) < 0.0 && open
    };
    let lit = points.iter().filter(|(point, side)| sees(*point, *side)).count();
    assert!(lit < 15, "{lit} of 300 points see the lamp");
    assert!(sees(Vec3::new(0.0, 2.499, 0.0), Vec3::NEG_Y), "the ceiling does");
}
