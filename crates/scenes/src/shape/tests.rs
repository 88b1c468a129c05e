use std::collections::HashMap;
use std::f64::consts::PI;

use glam::{Vec2, Vec3};

use super::*;
use crate::{CameraSpec, Material, Scene};

/// Volume by the divergence theorem; positive if fronts look outwards.
fn volume(mesh: &Mesh) -> f64 {
    let at = |i: u32| mesh.positions[i as usize].as_dvec3();
    mesh.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum()
}

/// Every directed edge has exactly one partner in the other direction, vertices at one place counting as one.
fn is_closed(mesh: &Mesh) -> bool {
    let place = |i: u32| {
        let p = mesh.positions[i as usize] * 1e4;
        [p.x.round() as i64, p.y.round() as i64, p.z.round() as i64]
    };
    let mut edges = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            *edges.entry((place(t[k]), place(t[(k + 1) % 3]))).or_insert(0) += 1;
        }
    }
    edges.iter().all(|(&(a, b), &n)| n == 1 && edges.get(&(b, a)) == Some(&1))
}

/// Shading normals look to the front of the triangles around them.
fn normals_face_the_front(mesh: &Mesh) -> bool {
    mesh.triangles.iter().all(|t| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
        let front = (b - a).cross(c - a);
        t.iter().all(|&i| mesh.normals[i as usize].dot(front) > 0.0)
    })
}

fn solids() -> Vec<(&'static str, Mesh, f64)> {
    let bottle = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.8], [0.2, 1.0], [0.2, 1.3], [0.0, 1.3]].map(Vec2::from);
    let path = [Vec3::ZERO, Vec3::Y, Vec3::new(0.3, 2.0, 0.0)];
    let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(Vec2::from);
    let (faces, rim) = slab(&square, 0.25);
    // A cone's frustum has h·π/3·(R² + R·r + r²).
    let neck = 0.2 * PI / 3.0 * (0.25 + 0.1 + 0.04);
    vec![
        ("cuboid", cuboid(Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 3.0)), 6.0),
        ("lathe", lathe(&bottle, 256), PI * 0.25 * 0.8 + neck + PI * 0.04 * 0.3),
        ("cylinder", cylinder(0.5, 2.0, 256), PI * 0.5),
        ("ball", rounded_box(Vec3::ONE, 1.0, 24), PI * 4.0 / 3.0),
        ("tube", tube(&path[..2], &[0.1, 0.1], 200), PI * 0.01),
        ("slab", Mesh::joined([faces, rim]), 1.0),
    ]
}

#[test]
fn solids_are_closed_face_outwards_and_have_their_volume() {
    for (name, mesh, expected) in solids() {
        assert!(is_closed(&mesh), "{name} has a hole");
        assert!(normals_face_the_front(&mesh), "{name} has normals to the back");
        let share = volume(&mesh) / expected;
        // Inscribed polyhedra lose less than a percent at these resolutions.
        assert!(share > 0.99 && share < 1.0 + 1e-4, "{name}: volume is {share} of what it should be");
    }
}

#[test]
fn rounded_box_is_the_box_without_its_corners() {
    let half = Vec3::new(1.0, 2.0, 0.5);
    let mesh = rounded_box(half, 0.25, 5);
    assert!(is_closed(&mesh) && normals_face_the_front(&mesh));
    let size = mesh.positions.iter().fold(Vec3::ZERO, |m, p| m.max(p.abs()));
    assert!(size.distance(half) < 1e-6, "{size}");
    let box_volume = 8.0;
    assert!(volume(&mesh) > 0.9 * box_volume && volume(&mesh) < box_volume);
}

#[test]
fn bent_tube_is_closed() {
    let path = [Vec3::ZERO, Vec3::Y, Vec3::new(0.5, 1.5, 0.2), Vec3::new(0.0, 2.0, 1.0)];
    let mesh = tube(&path, &[0.1, 0.08, 0.06, 0.02], 8);
    assert!(is_closed(&mesh));
    assert!(volume(&mesh) > 0.0);
}

#[test]
fn moved_mesh_keeps_unit_normals_and_its_front() {
    let map = Affine3A::from_scale(Vec3::new(2.0, 0.5, 1.0)) * Affine3A::from_rotation_x(0.7);
    let mesh = rounded_box(Vec3::ONE, 0.3, 3).transformed(map).translated(Vec3::X);
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
    assert!(normals_face_the_front(&mesh));
    let flipped = mesh.clone().flipped();
    assert!(normals_face_the_front(&flipped));
    assert!((volume(&flipped) + volume(&mesh)).abs() < 1e-9);
}

#[test]
fn smoothed_ball_has_the_normals_of_a_ball() {
    let mesh = rounded_box(Vec3::ONE, 1.0, 12).smoothed();
    // Over a cell of a twelfth of 45° a facet leans by at most half of that.
    let lean = (45.0f32 / 12.0).to_radians();
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        assert!(p.normalize().dot(*n) > lean.cos(), "{p} has {n}");
    }
    // Twelve sides at right angles: every corner of a cube looks along its diagonal or nearly so.
    let cube = cuboid(-Vec3::ONE, Vec3::ONE).smoothed();
    assert!(cube.positions.iter().zip(&cube.normals).all(|(p, n)| p.normalize().dot(*n) > 0.8));
    assert!(normals_face_the_front(&cube));
}

#[test]
fn leaf_has_six_proper_triangles() {
    let leaf = LeafShape {
        base: Vec3::ONE,
        along: Vec3::new(1.0, 0.3, 0.0),
        up: Vec3::Y,
        length: 0.08,
        width: 0.04,
        droop: 0.3,
        fold: 0.15,
    };
    let mesh = leaf.mesh(7);
    assert_eq!(mesh.triangles.len(), 6);
    assert!(normals_face_the_front(&mesh));
    assert!(mesh.normals.iter().all(|n| n.y > 0.0), "the upper side looks up");
    assert!(mesh.uvs.iter().all(|uv| uv.x > 7.0 && uv.x < 8.0));
    let camera = CameraSpec {
        eye: Vec3::ZERO,
        target: Vec3::ONE,
        up: Vec3::Y,
        vertical_fov_degrees: 40.0,
        lens: None,
    };
    let mut scene = Scene::empty("leaf", "Leaf", camera);
    let green = scene.add_material(Material::diffuse("green", Vec3::Y * 0.5));
    scene.add_mesh(mesh, green);
    assert_eq!(scene.check(), Ok(()));
}
