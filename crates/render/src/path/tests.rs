use glam::{Vec3, Vec3A};
use noisefloor_frame::Moments;
use noisefloor_scenes::{
    CameraSpec, Color, EnvironmentMap, Material, Mesh, Scattering, Scene, Sky, Sphere, Sun,
};

use super::steps::{emission, reach};
use crate::Prepared;
use crate::bsdf::Lobe;
use crate::bvh::Ray;
use crate::interaction::Interaction;
use crate::intersect::Traversal;
use crate::math::power_heuristic;
use crate::sampler::{Independent, Sampler};

/// Every kind of light over a point at the origin with normal +Y.
fn scene(kind: &str) -> Prepared {
    let material = |emission: f32| Material {
        name: "m".into(),
        scattering: Scattering::Diffuse { albedo: Color::Constant(Vec3::ZERO) },
        emission: Vec3::splat(emission),
    };
    let camera = CameraSpec {
        eye: Vec3::ONE,
        target: Vec3::ZERO,
        up: Vec3::Y,
        vertical_fov_degrees: 30.0,
        lens: None,
    };
    let mut scene = Scene {
        materials: vec![material(0.0), material(3.0)],
        spheres: vec![Sphere { center: Vec3::new(-3.0, 0.0, 0.0), radius: 0.5, material: 0 }],
        ..Scene::empty("test", "", camera)
    };
    match kind {
        "triangle" => scene.meshes.push(Mesh {
            positions: vec![Vec3::new(-1.0, 1.0, -0.5), Vec3::new(1.0, 1.2, -0.5), Vec3::new(0.3, 1.4, 1.0)],
            triangles: vec![[0, 1, 2]],
            material: 1,
            ..Mesh::default()
        }),
        "sphere" => scene.spheres.push(Sphere { center: Vec3::new(0.3, 1.5, 1.0), radius: 0.6, material: 1 }),
        "sun" => {
            let irradiance = Vec3::splat(2.0);
            scene.sun =
                Some(Sun { direction: Vec3::new(0.6, 0.8, 0.0), half_angle_degrees: 9.0, irradiance });
        }
        "map" => {
            let texels = (0..128).map(|i| Vec3::splat(if i == 43 { 40.0 } else { (i % 7) as f32 }));
            let map = EnvironmentMap { width: 16, height: 8, texels: texels.collect() };
            scene.sky = Some(Sky::Map(map.into()));
        }
        _ => {
            scene.sky =
                Some(Sky::Gradient { horizon: Vec3::ONE, zenith: Vec3::splat(4.0), ground: Vec3::ZERO });
        }
    }
    Prepared::new(&scene).unwrap()
}

/// Radiance scattered once towards `viewer`, with light samples only, scattered samples only, or both.
fn estimate(scene: &Prepared, lobe: Lobe, viewer: Vec3A, strategy: &str) -> Moments<1> {
    let at = Interaction {
        point: Vec3A::ZERO,
        geometric: Vec3A::Y,
        normal: Vec3A::Y,
        front: true,
        uv: glam::Vec2::ZERO,
        clearance: 1e-4,
    };
    let mut stack = scene.traversal();
    let mut moments = Moments::default();
    for k in 0..60_000 {
        let sampler = Independent::new(strategy.len() as u64, k);
        let mut sum = 0.0;
        if strategy != "scattered"
            && let Some(light) = scene.lights.sample(at.leave(Vec3A::Y), at.normal, sampler.group(0))
        {
            let (value, density) = lobe.eval(&at, viewer, light.direction);
            let ray = Ray { origin: at.leave(light.direction), direction: light.direction };
            if density > 0.0 && !scene.occluded::<false>(&ray, reach(&light), &mut stack) {
                let weight = if strategy == "both" { power_heuristic(light.density, density) } else { 1.0 };
                sum += (value * light.radiance).x / light.density * weight;
            }
        }
        let u = sampler.group(1);
        if strategy != "light"
            && let Some(s) = lobe.sample(&at, viewer, u[0], u[1])
        {
            let ray = Ray { origin: at.leave(s.direction), direction: s.direction };
            let previous = (strategy == "both").then_some((s.density, at.normal));
            sum += s.weight.x * arriving(scene, &ray, previous, &mut stack).x;
        }
        moments.push([f64::from(sum)]);
    }
    moments
}

fn arriving(scene: &Prepared, ray: &Ray, previous: Option<(f32, Vec3A)>, stack: &mut Traversal) -> Vec3A {
    let Some(hit) = scene.closest::<false>(ray, f32::INFINITY, stack) else {
        return scene.lights.background(ray.direction, previous);
    };
    let geometry = &scene.geometry[hit.primitive as usize];
    let at = geometry.interact(ray, &hit, &scene.attributes);
    emission(scene, geometry, &at, ray, hit.t, previous)
}

#[test]
fn light_samples_scattered_samples_and_both_agree() {
    let viewer = Vec3A::new(0.5, 0.7, -0.2).normalize();
    let lobes =
        [Lobe::Diffuse { albedo: Vec3A::splat(0.7) }, Lobe::Conductor { f0: Vec3A::splat(0.8), alpha: 0.6 }];
    for kind in ["triangle", "sphere", "sun", "sky", "map"] {
        for lobe in lobes {
            let scene = scene(kind);
            let by = |strategy| {
                let m = estimate(&scene, lobe, viewer, strategy);
                (m.mean()[0], m.mean_variance().unwrap()[0])
            };
            let both = by("both");
            assert!(both.0 > 0.0);
            for strategy in ["light", "scattered"] {
                let single = by(strategy);
                let error = (both.1 + single.1).sqrt();
                assert!(error < 0.05 * both.0, "{kind} {strategy}: too noisy to tell");
                assert!(
                    (both.0 - single.0).abs() < 4.5 * error,
                    "{kind} {lobe:?} {strategy}: {} against {} ± {error}",
                    single.0,
                    both.0
                );
            }
        }
    }
}

#[test]
fn light_that_is_sent_into_a_ball_is_what_arrives_on_its_surface() {
    for kind in ["triangle", "sphere", "sun", "sky", "map"] {
        let scene = scene(kind);
        // Far enough for a cone, close by, and around the lamp.
        for (center, radius) in [([0.2, -3.0, 0.5], 0.4f32), ([0.1, 0.2, 0.0], 0.7), ([0.0, 1.0, 0.0], 3.0)] {
            // Distant light starts outside the scene, and so outside every ball in it.
            if radius > scene.radius && !matches!(kind, "triangle" | "sphere") {
                continue;
            }
            let center = Vec3A::from_array(center);
            let ball = crate::lights::Ball { center, radius };
            let chances = scene.lights.towards(ball);
            let (mut sent, mut arrived) = (Moments::<1>::default(), Moments::<1>::default());
            for k in 0..60_000 {
                let sampler = Independent::new(21, k);
                let light = scene.lights.emit(sampler.group(0), sampler.group(1), ball, &chances);
                sent.push([light.map_or(0.0, |(origin, direction, flux)| {
                    let to = center - origin;
                    let along = to.dot(direction);
                    let aside = (to - direction * along).length();
                    let inside = to.length() < radius;
                    // What starts inside never arrives from outside.
                    if aside <= radius && along > 0.0 && !inside { f64::from(flux.x) } else { 0.0 }
                })]);
                let u = sampler.group(2);
                let (s, c) = crate::math::turn(u[3]);
                let sin = (4.0 * u[2] * (1.0 - u[2])).max(0.0).sqrt();
                let normal = Vec3A::new(sin * c, sin * s, 1.0 - 2.0 * u[2]);
                let point = center + normal * radius;
                let found = scene.lights.sample(point, normal, sampler.group(3));
                arrived.push([found.map_or(0.0, |light| {
                    let cos = light.direction.dot(normal).max(0.0);
                    let area = 4.0 * std::f32::consts::PI * radius * radius;
                    f64::from(light.radiance.x * cos / light.density * area)
                })]);
            }
            let at = |m: &Moments<1>| (m.mean()[0], m.mean_variance().unwrap()[0]);
            let ((a, va), (b, vb)) = (at(&sent), at(&arrived));
            let error = (va + vb).sqrt();
            // A lamp inside the ball sends nothing in.
            if matches!(kind, "triangle" | "sphere") && radius == 3.0 {
                assert_eq!((a, b), (0.0, 0.0), "{kind}");
                continue;
            }
            assert!(error < 0.05 * b, "{kind} {center}: {error} is no test of {b}");
            assert!((a - b).abs() < 4.5 * error, "{kind} {center}: {a} sent, {b} arrived ± {error}");
        }
    }
}
