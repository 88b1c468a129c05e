use super::*;
use crate::analytic::{furnace, plane_under_sun};
use crate::{Lens, Sky, Texture};

/// Spoils a valid scene and returns what the check says.
fn verdict(spoil: impl FnOnce(&mut Scene)) -> SceneError {
    let mut scene = plane_under_sun(Vec3::splat(0.5), Vec3::ONE, 30.0);
    assert_eq!(scene.check(), Ok(()));
    spoil(&mut scene);
    scene.check().expect_err("the scene was spoilt")
}

fn mesh_verdict(spoil: impl FnOnce(&mut Mesh)) -> String {
    match verdict(|scene| spoil(&mut scene.meshes[0])) {
        SceneError::BadMesh { mesh: 0, problem, .. } => problem,
        other => panic!("unexpected {other:?}"),
    }
}

#[test]
fn scene_without_anything_to_see_is_refused() {
    assert!(matches!(verdict(|s| s.meshes.clear()), SceneError::Empty { .. }));
    assert!(matches!(verdict(|s| s.meshes[0].triangles.clear()), SceneError::Empty { .. }));
}

#[test]
fn missing_materials_are_named() {
    let error = verdict(|s| s.meshes[0].material = 7);
    assert!(error.to_string().contains("mesh 0 uses material 7, but there are 1"), "{error}");
    let error = verdict(|s| s.add_sphere(Vec3::ZERO, 1.0, 3));
    assert!(error.to_string().contains("sphere 0 uses material 3"), "{error}");
}

#[test]
fn bad_meshes_are_refused_with_the_place() {
    assert_eq!(mesh_verdict(|m| m.positions[2].x = f32::NAN).split(" is").next(), Some("vertex 2"));
    assert_eq!(mesh_verdict(|m| m.triangles[1] = [0, 1, 9]), "triangle 1 uses vertex 9 of 4");
    assert_eq!(mesh_verdict(|m| m.triangles[0] = [1, 1, 2]), "triangle 0 has no area");
    assert_eq!(
        mesh_verdict(|m| m.positions[1] = 0.5 * (m.positions[0] + m.positions[2])),
        "triangle 0 has no area"
    );
    assert_eq!(mesh_verdict(|m| m.normals[3] *= 1.1).split(" has").next(), Some("normal of vertex 3"));
    assert_eq!(mesh_verdict(|m| m.uvs.truncate(2)), "4 vertices but 2 texture coordinates");
}

#[test]
fn small_triangles_are_not_degenerate() {
    let mut scene = furnace(0.5);
    scene.meshes[0].positions.iter_mut().for_each(|p| *p *= 1e-6);
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn textured_mesh_needs_coordinates() {
    let checker = Texture::Checker { frequency: Vec2::ONE, a: Vec3::ZERO, b: Vec3::ONE };
    let error = verdict(|s| {
        s.materials[0] = Material::diffuse("checker", checker);
        s.meshes[0].uvs.clear();
    });
    assert!(error.to_string().contains("no texture coordinates"), "{error}");
}

#[test]
fn numbers_out_of_range_are_refused_with_value_and_range() {
    type Spoil = fn(&mut Scene);
    let cases: [(Spoil, &str); 12] = [
        (|s| s.camera.eye.y = f32::INFINITY, "the camera's eye"),
        (|s| s.camera.up = s.camera.target - s.camera.eye, "the camera's view and its up is 0"),
        (|s| s.camera.vertical_fov_degrees = 180.0, "the field of view is 180, allowed is inside (0, 180)"),
        (|s| s.camera.lens = Some(Lens { radius: 0.1, focus_distance: 0.0 }), "the focus distance is 0"),
        (|s| s.materials[0].emission.x = -1.0, "the emission of `ground` is -1, allowed is at least 0"),
        (
            |s| s.materials[0] = Material::mirror("m", Vec3::splat(1.5)),
            "reflectance of `m` is 1.5, allowed is in [0, 1]",
        ),
        (|s| s.materials[0] = Material::glass("g", 1.0), "refractive index of `g` is 1, allowed is above 1"),
        (|s| s.materials[0] = Material::conductor("c", Vec3::ONE, 0.0), "roughness of `c` is 0"),
        (|s| s.sky = Some(Sky::Constant(Vec3::splat(f32::NAN))), "the sky is"),
        (|s| s.sky = Some(Sky::Constant(Vec3::splat(3e38))), "allowed is at most 1e15"),
        (|s| s.materials[0].emission.x = 3e38, "the emission of `ground` is"),
        (|s| s.add_sphere(Vec3::ZERO, -1.0, 0), "radius of sphere 0 is -1"),
    ];
    for (spoil, expected) in cases {
        let error = verdict(spoil);
        assert!(matches!(error, SceneError::OutOfRange { .. }), "{error:?}");
        assert!(error.to_string().contains(expected), "{error}");
    }
    for direction in [Vec3::ZERO, Vec3::Y * 2.0] {
        let error = verdict(|s| s.sun = s.sun.map(|sun| crate::Sun { direction, ..sun }));
        assert!(error.to_string().contains("the sun's direction"), "{error}");
    }
}
