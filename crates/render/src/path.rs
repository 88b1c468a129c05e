//! The path integrator.

use glam::Vec3A;

use crate::bsdf::{Event, Lobe};
use crate::bvh::{Ray, Stack};
use crate::lights::LightSample;
use crate::math::power_heuristic;
use crate::prepare::Prepared;
use crate::sampler::Sampler;
use crate::surface::{Geometry, Interaction};

/// Edges before Russian roulette starts.
const SURE_EDGES: u32 = 3;

/// Least chance to survive it, so that no survivor becomes absurdly bright.
const LEAST_CHANCE: f32 = 1e-3;

/// What one path brings back. Fields that were not asked for stay zero.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// Radiance along the camera ray.
    pub color: Vec3A,
    /// See [`crate::Quantity::Albedo`].
    pub albedo: Vec3A,
    /// See [`crate::Quantity::Normal`].
    pub normal: Vec3A,
    /// See [`crate::Quantity::Depth`].
    pub depth: f32,
    /// 1 if a shadow ray from the first hit reached its light.
    pub reached: f32,
    /// 1 if a shadow ray was traced from the first hit.
    pub traced: f32,
    /// See [`crate::Quantity::Direct`].
    pub direct: Vec3A,
    /// Material, −1 for background.
    pub material: i32,
    /// F0 of the virtual flash.
    pub flash_base: Vec3A,
    /// S of the virtual flash.
    pub eye_light: Vec3A,
}

impl Outcome {
    const NOTHING: Self = Self {
        color: Vec3A::ZERO,
        albedo: Vec3A::ZERO,
        normal: Vec3A::ZERO,
        depth: 0.0,
        reached: 0.0,
        traced: 0.0,
        direct: Vec3A::ZERO,
        material: -1,
        flash_base: Vec3A::ZERO,
        eye_light: Vec3A::ZERO,
    };
}

/// How far the path still belongs to the flash image (moon2013flash, Sec. 3.1).
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reuse {
    /// Only specular and glossy vertices so far.
    Following,
    /// The first diffuse vertex was just left: emission at the next hit is its direct light, then the reuse ends.
    Ending,
    /// F0 is complete.
    Done,
}

/// Traces one path of at most `depth` edges; features are taken at the first hit, or with `follow` at the first that is not
/// specular. `eye`: centre of the lens, where the eye light sits.
pub fn trace<S: Sampler, const FEATURES: bool, const FLASH: bool>(
    scene: &Prepared,
    mut ray: Ray,
    eye: Vec3A,
    (depth, follow): (u32, bool),
    sampler: S,
    stack: &mut Stack,
) -> Outcome {
    let mut out = Outcome::NOTHING;
    let mut throughput = Vec3A::ONE;
    // Product of the squared index ratios in `throughput`: roulette must not see that radiance is low inside glass.
    let mut squared_index = 1.0f32;
    // Density and normal of the last vertex if light sampling competed with its choice.
    let mut previous: Option<(f32, Vec3A)> = None;
    let mut reuse = Reuse::Following;
    let mut direct_open = true;
    // Edge whose end the features belong to, as far as the path has come, and the way to it.
    let mut feature_edge = 1;
    let mut way = 0.0f32;
    let mut tint = Vec3A::ONE;
    let mut edge = 1;
    loop {
        let hit = scene.bvh.closest(&ray, f32::INFINITY, stack);
        let Some(hit) = hit else {
            if FEATURES && edge == feature_edge {
                (out.albedo, out.normal, out.depth, out.material) = (Vec3A::ZERO, Vec3A::ZERO, 0.0, -1);
            }
            out.color += throughput * scene.lights.background(ray.direction, previous);
            break;
        };
        let geometry = &scene.geometry[hit.primitive as usize];
        let surface = &scene.surfaces[geometry.material as usize];
        let last = edge >= depth;
        let shaded = !last || FEATURES && edge == feature_edge || FLASH && reuse == Reuse::Following;
        // At the end of the longest path only emission matters.
        if !(shaded || surface.emits) {
            break;
        }
        let at = geometry.interact(&ray, &hit, &scene.attributes);
        if surface.emits {
            out.color += throughput * emission(scene, geometry, &at, &ray, hit.t, previous);
        }
        if !shaded {
            break;
        }
        let event = surface.scatter.at(at.uv);
        if FEATURES && edge == feature_edge {
            out.albedo = tint * event.albedo();
            out.normal = at.normal;
            way += hit.t;
            out.depth = way;
            out.material = geometry.material as i32;
        }
        if FEATURES && edge == feature_edge + 1 {
            out.direct = out.color;
            direct_open = false;
        }
        if FLASH && reuse == Reuse::Ending {
            out.flash_base = out.color;
            reuse = Reuse::Done;
        }
        let to_viewer = -ray.direction;
        let lobe = match event {
            Event::Lobe(lobe) => lobe,
            Event::Specular(specular) => {
                if last {
                    break;
                }
                let u = sampler.group(2 * edge);
                let (direction, scale) = specular.follow(&at, to_viewer, u[2]);
                throughput *= specular.tint() * scale;
                if FEATURES && follow && edge == feature_edge {
                    tint *= specular.tint();
                    feature_edge += 1;
                }
                squared_index *= scale;
                if !survives(&mut throughput, squared_index, edge, u[3]) {
                    break;
                }
                previous = None;
                ray = Ray { origin: at.leave(direction), direction };
                edge += 1;
                continue;
            }
        };
        if FLASH && reuse == Reuse::Following {
            let to_eye = eye - at.point;
            let squared = to_eye.length_squared().max(scene.least_eye_distance * scene.least_eye_distance);
            let to_eye = to_eye.normalize_or(at.normal);
            out.eye_light += throughput * lobe.eval(&at, to_viewer, to_eye).0 * (1.0 / squared);
        }
        if last {
            break;
        }
        let u = sampler.group(2 * edge - 1);
        // From where the shadow ray starts: a light's rim seen from beside it is another rim.
        let origin = at.leave(at.geometric);
        if let Some(light) = scene.lights.sample(origin, at.normal, u) {
            let (value, density) = lobe.eval(&at, to_viewer, light.direction);
            if density > 0.0 {
                if FEATURES && edge == feature_edge {
                    out.traced = 1.0;
                }
                let shadow = Ray { origin, direction: light.direction };
                if !scene.bvh.occluded(&shadow, reach(&light), stack) {
                    let weight = power_heuristic(light.density, density) / light.density;
                    out.color += throughput * value * light.radiance * weight;
                    if FEATURES && edge == feature_edge {
                        out.reached = 1.0;
                    }
                }
            }
        }
        let v = sampler.group(2 * edge);
        let Some(scattered) = lobe.sample(&at, to_viewer, v[0], v[1]) else { break };
        throughput *= scattered.weight;
        if !survives(&mut throughput, squared_index, edge, v[3]) {
            break;
        }
        if FLASH && reuse == Reuse::Following && matches!(lobe, Lobe::Diffuse { .. }) {
            reuse = Reuse::Ending;
        }
        previous = Some((scattered.density, at.normal));
        ray = Ray { origin: at.leave(scattered.direction), direction: scattered.direction };
        edge += 1;
    }
    if FEATURES && direct_open {
        out.direct = out.color;
    }
    if FLASH && reuse != Reuse::Done {
        out.flash_base = out.color;
    }
    out
}

/// Radiance of a hit towards the viewer, weighted against light sampling if that competed.
#[inline(always)]
fn emission(
    scene: &Prepared,
    geometry: &Geometry,
    at: &Interaction,
    ray: &Ray,
    t: f32,
    previous: Option<(f32, Vec3A)>,
) -> Vec3A {
    if !at.front {
        return Vec3A::ZERO;
    }
    let weight = previous.map_or(1.0, |(density, _)| {
        let cos = ray.direction.dot(at.geometric);
        power_heuristic(density, scene.lights.density(geometry.light, ray.origin, t, cos))
    });
    scene.surfaces[geometry.material as usize].emission * weight
}

/// A shadow ray stops short of its light by more than the rounding of its length.
#[inline(always)]
fn reach(light: &LightSample) -> f32 {
    light.distance * (1.0 - 1e-4)
}

/// Russian roulette: ends dim paths and makes the survivors brighter, so that the mean stays. False also for paths that
/// carry nothing.
#[inline(always)]
fn survives(throughput: &mut Vec3A, squared_index: f32, edge: u32, u: f32) -> bool {
    let brightest = throughput.max_element() / squared_index;
    // Not `brightest <= 0`: false for the NaN of two underflows, too.
    let carries = brightest > 0.0;
    if edge < SURE_EDGES || !carries {
        return carries;
    }
    let chance = brightest.clamp(LEAST_CHANCE, 1.0);
    if u >= chance {
        return false;
    }
    *throughput *= 1.0 / chance;
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use glam::Vec3;
    use noisefloor_frame::Moments;
    use noisefloor_scenes::{
        CameraSpec, Color, EnvironmentMap, Material, Mesh, Scattering, Scene, Sky, Sphere, Sun,
    };

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
                positions: vec![
                    Vec3::new(-1.0, 1.0, -0.5),
                    Vec3::new(1.0, 1.2, -0.5),
                    Vec3::new(0.3, 1.4, 1.0),
                ],
                triangles: vec![[0, 1, 2]],
                material: 1,
                ..Mesh::default()
            }),
            "sphere" => {
                scene.spheres.push(Sphere { center: Vec3::new(0.3, 1.5, 1.0), radius: 0.6, material: 1 })
            }
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
        let mut stack = scene.bvh.stack();
        let mut moments = Moments::default();
        for k in 0..60_000 {
            let sampler = Independent::new(strategy.len() as u64, k);
            let mut sum = 0.0;
            if strategy != "scattered"
                && let Some(light) = scene.lights.sample(at.leave(Vec3A::Y), at.normal, sampler.group(0))
            {
                let (value, density) = lobe.eval(&at, viewer, light.direction);
                let ray = Ray { origin: at.leave(light.direction), direction: light.direction };
                if density > 0.0 && !scene.bvh.occluded(&ray, reach(&light), &mut stack) {
                    let weight =
                        if strategy == "both" { power_heuristic(light.density, density) } else { 1.0 };
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

    fn arriving(scene: &Prepared, ray: &Ray, previous: Option<(f32, Vec3A)>, stack: &mut Stack) -> Vec3A {
        let Some(hit) = scene.bvh.closest(ray, f32::INFINITY, stack) else {
            return scene.lights.background(ray.direction, previous);
        };
        let geometry = &scene.geometry[hit.primitive as usize];
        let at = geometry.interact(ray, &hit, &scene.attributes);
        emission(scene, geometry, &at, ray, hit.t, previous)
    }

    #[test]
    fn light_samples_scattered_samples_and_both_agree() {
        let viewer = Vec3A::new(0.5, 0.7, -0.2).normalize();
        let lobes = [
            Lobe::Diffuse { albedo: Vec3A::splat(0.7) },
            Lobe::Conductor { f0: Vec3A::splat(0.8), alpha: 0.6 },
        ];
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
}
