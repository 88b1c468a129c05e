//! The path integrator.

use glam::Vec3A;

use crate::bsdf::{Event, Lobe};
use crate::bvh::{Ray, Stack};
use crate::lights::LightSample;
use crate::math::power_heuristic;
use crate::prepare::Prepared;
use crate::sampler::Sampler;
use crate::surface::NONE;

/// Edges before Russian roulette starts.
const SURE_EDGES: u32 = 3;

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
    /// See [`crate::Quantity::Visibility`].
    pub visibility: f32,
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
        visibility: 0.0,
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

/// Traces one path of at most `depth` edges. `eye`: centre of the lens, where the eye light sits.
pub fn trace<S: Sampler, const FEATURES: bool, const FLASH: bool>(
    scene: &Prepared,
    mut ray: Ray,
    eye: Vec3A,
    depth: u32,
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
    let mut edge = 1;
    loop {
        let hit = scene.bvh.closest(&ray, f32::INFINITY, stack);
        let Some(hit) = hit else {
            out.color += throughput * scene.lights.background(ray.direction, previous);
            break;
        };
        let geometry = &scene.geometry[hit.primitive as usize];
        let at = geometry.interact(&ray, &hit, &scene.attributes);
        let surface = &scene.surfaces[geometry.material as usize];
        if surface.emits && at.front {
            let weight = match previous {
                Some((density, _)) if geometry.light != NONE => {
                    let cos = ray.direction.dot(at.geometric);
                    power_heuristic(density, scene.lights.density(geometry.light, ray.origin, hit.t, cos))
                }
                _ => 1.0,
            };
            out.color += throughput * surface.emission * weight;
        }
        let event = surface.scatter.at(at.uv);
        if FEATURES && edge == 1 {
            out.albedo = event.albedo();
            out.normal = at.normal;
            out.depth = hit.t;
            out.material = geometry.material as i32;
        }
        if FEATURES && edge == 2 {
            out.direct = out.color;
            direct_open = false;
        }
        if FLASH && reuse == Reuse::Ending {
            out.flash_base = out.color;
            reuse = Reuse::Done;
        }
        let to_viewer = -ray.direction;
        let light_edge = edge < depth;
        let lobe = match event {
            Event::Lobe(lobe) => lobe,
            Event::Specular(specular) => {
                if !light_edge {
                    break;
                }
                let u = sampler.group(2 * edge);
                let (direction, scale) = specular.follow(&at, to_viewer, u[2]);
                throughput *= specular.tint() * scale;
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
        if !light_edge {
            break;
        }
        let u = sampler.group(2 * edge - 1);
        if let Some(light) = scene.lights.sample(at.point, at.normal, u) {
            let (value, density) = lobe.eval(&at, to_viewer, light.direction);
            if density > 0.0 {
                let blocked = scene.bvh.occluded(
                    &Ray { origin: at.leave(light.direction), direction: light.direction },
                    reach(&light),
                    stack,
                );
                if !blocked {
                    let weight = power_heuristic(light.density, density) / light.density;
                    out.color += throughput * value * light.radiance * weight;
                    if FEATURES && edge == 1 {
                        out.visibility = 1.0;
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

/// A shadow ray stops short of its light by more than the rounding of its length.
#[inline(always)]
fn reach(light: &LightSample) -> f32 {
    light.distance * (1.0 - 1e-4)
}

/// Russian roulette: ends dim paths and makes the survivors brighter, so that the mean stays. False also for paths that
/// carry nothing.
#[inline(always)]
fn survives(throughput: &mut Vec3A, squared_index: f32, edge: u32, u: f32) -> bool {
    let brightest = throughput.max_element() / squared_index; // products of positive finite ratios
    if edge < SURE_EDGES {
        return brightest > 0.0;
    }
    let chance = brightest.min(0.95);
    if u >= chance {
        return false;
    }
    *throughput *= 1.0 / chance; // chance > u ≥ 0
    true
}
