//! What holds for every built-in scene.

use std::collections::HashMap;

use glam::{Vec2, Vec3};
use noisefloor_scenes::{Color, Material, Mesh, Models, Scattering, Scene, builtin, find};

fn scenes() -> impl Iterator<Item = Scene> {
    builtin().iter().map(|entry| (entry.build)())
}

fn scene(id: &str) -> Scene {
    (find(id).expect("built in").build)()
}

fn triangles(scene: &Scene) -> usize {
    scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
}

#[test]
fn every_scene_passes_its_check() {
    for scene in scenes() {
        assert_eq!(scene.check(), Ok(()), "{}", scene.id);
    }
}

#[test]
fn building_twice_gives_the_same_scene() {
    for entry in builtin() {
        assert!((entry.build)() == (entry.build)(), "{}", entry.id);
    }
}

#[test]
fn models_declare_what_the_contents_show() {
    let none = Models::default();
    let specular_box = Models { specular: true, area_lights: true, ..none };
    assert_eq!(scene("cornell").models(), specular_box);
    assert_eq!(scene("cornell-diffuse").models(), Models { area_lights: true, ..none });
    let kitchen = Models { depth_of_field: true, textures: true, glossy: true, area_lights: true, ..none };
    assert_eq!(scene("toaster").models(), kitchen);
    assert_eq!(scene("nave").models(), Models { glossy: false, ..kitchen });
    assert_eq!(scene("outdoor").models(), Models { textures: true, sun: true, sky: true, ..none });
    assert_eq!(scene("rings").models(), Models { sky: true, ..kitchen });
    let meeting = Models { textures: true, glossy: true, area_lights: true, ..none };
    assert_eq!(scene("conference").models(), meeting);
    assert_eq!(scene("teapot").models(), meeting);
    assert_eq!(scene("spin").models(), Models { motion_blur: true, ..meeting });
    assert_eq!(scene("bathroom").models(), Models { specular: true, ..meeting });
    assert_eq!(scene("shower").models(), Models { specular: true, ..meeting });
    let quads = Models { depth_of_field: true, textures: true, sky: true, ..none };
    assert_eq!(scene("two-quads").models(), quads);
    // Finite lamps only: a medium fills a closed scene, and light from infinitely far away could not get in.
    assert_eq!(scene("fog").models(), Models { textures: true, area_lights: true, medium: true, ..none });
    for id in ["furnace", "direct", "gradient"] {
        assert_eq!(scene(id).models(), Models { area_lights: true, ..none }, "{id}");
    }
}

#[test]
fn triangle_counts_stay_in_their_budgets() {
    assert_eq!(triangles(&scene("cornell")), 12);
    assert_eq!(triangles(&scene("cornell-diffuse")), 32);
    for (id, budget) in [
        ("toaster", 8_000..12_000),
        ("outdoor", 60_000..150_000),
        ("conference", 8_000..30_000),
        ("teapot", 30_000..60_000),
        ("nave", 20_000..120_000),
        ("bathroom", 10_000..60_000),
        ("shower", 10_000..60_000),
        ("rings", 50_000..150_000),
        ("fog", 60_000..200_000),
        ("spin", 5_000..60_000),
    ] {
        let count = triangles(&scene(id));
        assert!(budget.contains(&count), "{id} has {count}");
    }
}

#[test]
fn no_material_is_unused() {
    for scene in scenes() {
        for (i, material) in scene.materials.iter().enumerate() {
            let used =
                scene.meshes.iter().any(|m| m.material == i) || scene.spheres.iter().any(|s| s.material == i);
            assert!(used, "{}: `{}`", scene.id, material.name);
        }
    }
}

#[test]
fn lamps_shine_on_what_the_camera_looks_at() {
    for scene in scenes() {
        for mesh in scene.meshes.iter().filter(|m| scene.materials[m.material].emission != Vec3::ZERO) {
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
                let front = (b - a).cross(c - a);
                // Or on the camera, where the lamp is all around it.
                let [target, eye] = [scene.camera.target, scene.camera.eye].map(|p| front.dot(p - a));
                // Or it lights the room by way of the ceiling, which must then be above it.
                let uplight = front.normalize().y > 0.999 && roofed(&scene, (a + b + c) / 3.0);
                assert!(target.max(eye) > 0.0 || uplight, "{}: a lamp faces away", scene.id);
            }
        }
    }
}

/// Whether some triangle that looks down is straight above `point`.
fn roofed(scene: &Scene, point: Vec3) -> bool {
    scene.meshes.iter().any(|mesh| {
        mesh.triangles.iter().any(|t| {
            let corners = t.map(|i| mesh.positions[i as usize] - point);
            let flat = corners.map(|p| Vec2::new(p.x, p.z));
            // Seen from above, a front that looks down runs clockwise about every point in it.
            let around = (0..3).all(|k| flat[k].perp_dot(flat[(k + 1) % 3]) >= 0.0);
            face(mesh, t).normalize().y < -0.999 && around && corners[0].y > 0.0
        })
    })
}

#[test]
fn only_what_is_below_a_ceiling_is_roofed() {
    let room = scene("bathroom");
    assert!(roofed(&room, Vec3::new(0.0, 2.2, 0.0)));
    assert!(!roofed(&room, Vec3::new(0.0, 2.6, 0.0)), "over the ceiling");
    assert!(!roofed(&room, Vec3::new(2.0, 2.2, 0.0)), "outside");
}

#[test]
fn shading_normals_never_oppose_the_triangle() {
    for scene in scenes() {
        for mesh in scene.meshes.iter().filter(|m| !m.normals.is_empty()) {
            let name = &scene.materials[mesh.material].name;
            for t in &mesh.triangles {
                let front = face(mesh, t);
                let against = t.iter().any(|&i| mesh.normals[i as usize].dot(front) < 0.0);
                assert!(!against, "{}: `{name}` has a normal to the back", scene.id);
            }
        }
    }
}

/// Refraction needs to know inside from outside.
#[test]
fn glass_is_closed_and_faces_outwards() {
    let glass = |m: &Material| matches!(m.scattering, Scattering::Glass { .. });
    let mut checked = 0;
    for scene in scenes() {
        for mesh in scene.meshes.iter().filter(|mesh| glass(&scene.materials[mesh.material])) {
            let name = &scene.materials[mesh.material].name;
            assert!(is_closed(mesh), "{}: `{name}` has a hole", scene.id);
            assert!(volume(mesh) > 0.0, "{}: `{name}` is inside out", scene.id);
            checked += 1;
        }
    }
    assert!(checked >= 2, "the shower has a pane and a flask");
}

#[test]
fn holes_doubled_and_turned_triangles_are_not_closed() {
    let whole = noisefloor_scenes::shape::cuboid(Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.5, 0.9, 0.7));
    assert!(is_closed(&whole) && (volume(&whole) - 0.112).abs() < 1e-6);
    assert!(is_closed(&whole.clone().flipped()) && volume(&whole.clone().flipped()) < 0.0);
    let changed = |change: fn(&mut Mesh)| {
        let mut mesh = whole.clone();
        change(&mut mesh);
        is_closed(&mesh)
    };
    assert!(!changed(|mesh| mesh.triangles.truncate(11)), "a triangle is missing");
    assert!(!changed(|mesh| mesh.triangles.push(mesh.triangles[0])), "a triangle is there twice");
    assert!(!changed(|mesh| mesh.triangles[3].swap(0, 1)), "a triangle is turned");
    assert!(!changed(|mesh| mesh.positions[2].x += 1e-3), "a seam gapes");
}

/// Every directed edge has exactly one partner in the other direction, vertices at one place counting as one. A place
/// is a cube with sides of a hundred-thousandth of the scene's unit.
fn is_closed(mesh: &Mesh) -> bool {
    let place = |i: u32| (mesh.positions[i as usize] * 1e5).to_array().map(|c| c.round() as i64);
    let mut edges = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            *edges.entry((place(t[k]), place(t[(k + 1) % 3]))).or_insert(0) += 1;
        }
    }
    edges.iter().all(|(&(a, b), &n)| n == 1 && edges.get(&(b, a)) == Some(&1))
}

/// Volume by the divergence theorem; positive if fronts look outwards.
fn volume(mesh: &Mesh) -> f32 {
    let at = |i: u32| mesh.positions[i as usize];
    mesh.triangles.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c))) / 6.0).sum()
}

#[test]
fn reflectances_are_physical_over_the_whole_of_each_texture() {
    for scene in scenes() {
        for mesh in &scene.meshes {
            let material = &scene.materials[mesh.material];
            let (Scattering::Diffuse { albedo: color } | Scattering::Conductor { f0: color, .. }) =
                &material.scattering
            else {
                continue;
            };
            let Color::Texture(texture) = color else { continue };
            for &uv in &mesh.uvs {
                let c = texture.eval(uv);
                assert!(c.min_element() >= 0.0 && c.max_element() < 1.0, "`{}` reflects {c}", material.name);
            }
        }
    }
}

#[test]
fn cornell_blocks_stand_inside_the_box() {
    let scene = scene("cornell-diffuse");
    for p in scene.meshes.iter().flat_map(|mesh| &mesh.positions) {
        assert!(p.min_element() >= 0.0 && p.max_element() <= 5.6, "{p}");
    }
    // Seen from within, every wall shows its front.
    let inside = Vec3::new(2.78, 4.0, 0.5);
    for mesh in &scene.meshes[..5] {
        for t in &mesh.triangles {
            assert!(face(mesh, t).dot(inside - mesh.positions[t[0] as usize]) > 0.0);
        }
    }
}

fn face(mesh: &Mesh, triangle: &[u32; 3]) -> Vec3 {
    let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
    (b - a).cross(c - a)
}
