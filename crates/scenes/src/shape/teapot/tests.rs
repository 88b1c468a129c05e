use std::collections::HashMap;

use super::*;
use crate::{CameraSpec, Material, Scene};

const CELLS: u32 = 12;

#[test]
fn patches_and_triangles_are_as_many_as_newell_had() {
    assert_eq!(patches().len(), 32);
    // One row of four patches each at the bottom's middle and at the knob's top has single triangles.
    let expected = 32 * 2 * CELLS * CELLS - 8 * CELLS;
    assert_eq!(teapot(CELLS).triangles.len(), expected as usize);
    assert_eq!(teapot(0), teapot(2));
}

#[test]
fn it_has_the_known_extent() {
    let mesh = teapot(32);
    let low = mesh.positions.iter().fold(Vec3::INFINITY, |m, p| m.min(*p));
    let high = mesh.positions.iter().fold(Vec3::NEG_INFINITY, |m, p| m.max(*p));
    // All but the lip are control points on the surface. The lip's outermost point is where the derivative of x along
    // the spout's middle line vanishes: 3.43408 at v = 0.41. The nearest vertex is half a step off at most and
    // falls short by half the second derivative, 1.49, times its square.
    let short = 0.5 * 1.49 / (64.0 * 64.0);
    assert!(low.distance(Vec3::new(-3.0, 0.0, -2.0)) < 1e-5, "{low}");
    assert!((high.x - 3.43408).abs() < short + 1e-5, "{high}");
    assert!((high.y - 3.15).abs() < 1e-5, "{high}");
    assert!((high.z - 2.0).abs() < 1e-5, "{high}");
}

#[test]
fn normals_are_unit_and_look_to_the_front() {
    for cells in [8, 24] {
        let mesh = teapot(cells);
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let front = (b - a).cross(c - a);
            assert!(t.iter().all(|&i| mesh.normals[i as usize].dot(front) > 0.0), "{cells}: {a} {b} {c}");
        }
    }
}

#[test]
fn body_looks_away_from_the_axis_and_handle_and_spout_from_the_plane_between_their_halves() {
    for (index, patch) in patches().iter().enumerate() {
        let mesh = tessellated(patch, CELLS);
        let center = patch.iter().flatten().fold(Vec3::ZERO, |sum, p| sum + *p) / 16.0;
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            match index {
                // In the order of the profiles: the bottom, the body, the lid without its knob.
                0..4 => assert!(n.y < 1e-5, "{n} at {p}"),
                4..12 => assert!(n.dot(Vec3::new(p.x, 0.0, p.z)) > 0.0, "{n} at {p}"),
                16..20 => assert!(n.y > -1e-5, "{n} at {p}"),
                // Handle, and spout up to where it turns over its lip.
                24..30 => assert!(n.z * center.z > -1e-5, "{n} at {p}"),
                _ => {}
            }
        }
    }
}

#[test]
fn poles_look_straight_up_and_down() {
    let mesh = teapot(CELLS);
    let mut seen = [0, 0];
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        if p.x == 0.0 && p.z == 0.0 {
            let up = if p.y > 1.0 { 1.0 } else { -1.0 };
            seen[usize::from(p.y > 1.0)] += 1;
            assert!(n.y * up > 0.999, "{n} at {p}");
        }
    }
    assert_eq!(seen, [4 * (CELLS + 1); 2], "each pole belongs to four patches");
}

/// Edges without a partner in the other direction lie on the free rims that the original has, and nowhere else.
#[test]
fn patches_join_but_for_the_free_rims() {
    let mesh = teapot(CELLS);
    let place = |i: u32| (mesh.positions[i as usize] * 1e4).to_array().map(|x| x.round() as i32);
    let mut edges = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            *edges.entry((place(t[k]), place(t[(k + 1) % 3]))).or_insert(0) += 1;
        }
    }
    assert!(edges.values().all(|n| *n == 1), "an edge is used twice in one direction");
    let open: Vec<_> = edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).collect();
    // Four quarters of the rim and of the lid; two halves of each end of the handle and of the spout.
    assert_eq!(open.len() as u32, (4 + 4 + 4 + 4) * CELLS);
    for (a, b) in open {
        let p = Vec3::from(std::array::from_fn(|k| (a[k] + b[k]) as f32 * 0.5e-4));
        let radius = Vec2::new(p.x, p.z).length();
        let level = (p.y - 2.4).abs() < 1e-3;
        // The control polygon's circle is too wide by less than 0.6 %, a chord of it too narrow by less than that.
        let lid_or_rim = level && [1.3, 1.4].iter().any(|r| (radius / r - 1.0).abs() < 0.006);
        let spout = (p.x - 1.7).abs() < 1e-3 || level && p.x > 2.79 && p.z.abs() < 0.16;
        let handle = p.x > -2.01 && p.x < -1.49 && p.z.abs() < 0.31;
        assert!(lid_or_rim || spout || handle, "a hole at {p}");
    }
}

#[test]
fn no_triangle_degenerates() {
    let camera =
        CameraSpec { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov_degrees: 40.0, lens: None };
    for cells in [2, 3, 40] {
        let mut scene = Scene::empty("teapot", "Teapot", camera);
        let material = scene.add_material(Material::mirror("metal", Vec3::ONE));
        scene.add_mesh(teapot(cells), material);
        assert_eq!(scene.check(), Ok(()), "{cells}");
    }
}
