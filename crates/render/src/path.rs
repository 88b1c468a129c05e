//! The path integrator.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3A;

use crate::bsdf::{Event, Lobe};
use crate::bvh::{Hit, Ray};
use crate::camera::Eye;
use crate::geometry::Geometry;
use crate::interaction::Interaction;
use crate::intersect::Traversal;
use crate::lights::LightSample;
use crate::limits::DEEPEST;
use crate::math::power_heuristic;
use crate::medium::Flight;
use crate::photons::PhotonMaps;
use crate::prepare::Prepared;
use crate::sampler::Sampler;

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
    /// See [`crate::Quantity::Brdf`].
    pub brdf: Vec3A,
    /// See [`crate::Quantity::Motion`].
    pub motion: [f32; 2],
    /// See [`crate::Quantity::Caustics`].
    pub caustics: f32,
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
        brdf: Vec3A::ZERO,
        motion: [0.0; 2],
        caustics: 0.0,
    };
}

/// What all paths of an image have in common.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// Centre of the lens, where the eye light sits.
    pub eye: Vec3A,
    /// Most edges of a path.
    pub depth: u32,
    /// Whether features are taken at the first hit that is not specular.
    pub follow: bool,
    /// Photon maps, for caustics as a feature.
    pub photons: Option<&'a PhotonMaps>,
    /// Whether the photon maps give what comes after the first diffuse vertex.
    pub gather: bool,
    /// Width of a pixel at distance 1.
    pub pixel: f32,
    /// The camera in this frame and in the next, if anything moves.
    pub frames: Option<[Eye; 2]>,
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

/// Traces one path. What most scenes do not need (a medium, moving bodies, photon maps, rare features) is there only with
/// `EXTRAS`.
pub fn trace<S: Sampler, const FEATURES: bool, const FLASH: bool, const EXTRAS: bool>(
    scene: &Prepared,
    mut ray: Ray,
    view: &View<'_>,
    sampler: S,
    traversal: &mut Traversal,
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
    // Whether the path is outside glass, where a medium is.
    let mut outside = true;
    // Edge at whose end the photon maps took over, what they gave, and the length of the path.
    let mut gathered: Option<u32> = None;
    let mut by_photons = Vec3A::ZERO;
    let mut length = 0.0f32;
    let mut edge = 1;
    loop {
        let hit = scene.closest::<EXTRAS>(&ray, f32::INFINITY, traversal);
        let before = throughput;
        if EXTRAS
            && outside
            && let Some(medium) = &scene.medium
        {
            // Finite: an infinite thickness of a colour without extinction would not be a number.
            let limit = hit.map_or(f32::MAX, |hit| hit.t);
            match medium.fly(limit, throughput, sampler.group(2 * edge - 1)[3]) {
                Flight::Passed(weight) => throughput *= weight,
                Flight::Scattered(t, weight) => {
                    // Features and the eye light belong to the surface ahead, whatever floats before it.
                    if let Some(hit) = hit
                        && (FEATURES && edge == feature_edge || FLASH && reuse == Reuse::Following)
                    {
                        let at = scene.interact::<EXTRAS>(&ray, &hit, traversal);
                        let surface =
                            &scene.surfaces[scene.geometry[hit.primitive as usize].material as usize];
                        let event = surface.scatter.at(at.uv);
                        if FEATURES && edge == feature_edge {
                            way += hit.t;
                            let (to_viewer, u) = (-ray.direction, sampler.group(2 * edge));
                            let seen = Seen { hit: &hit, at: &at, event: &event, to_viewer, u };
                            describe::<EXTRAS>(&mut out, scene, view, &seen, (tint, way), traversal);
                        }
                        if FLASH
                            && reuse == Reuse::Following
                            && let Event::Lobe(lobe) = event
                        {
                            out.eye_light += eye_light(scene, view, before, &lobe, &at, -ray.direction);
                        }
                    }
                    if FEATURES && edge == feature_edge + 1 {
                        out.direct = out.color;
                        direct_open = false;
                    }
                    if FLASH {
                        if reuse == Reuse::Ending {
                            out.flash_base = out.color;
                            reuse = Reuse::Done;
                        } else if reuse == Reuse::Following {
                            reuse = Reuse::Ending;
                        }
                    }
                    if edge >= view.depth {
                        break;
                    }
                    throughput *= weight;
                    let point = ray.origin + ray.direction * t;
                    let u = sampler.group(2 * edge - 1);
                    // The normal matters for skies alone, and light from there does not get through a medium.
                    if let Some(light) = scene.lights.sample(point, Vec3A::Y, u) {
                        let shadow = Ray { origin: point, direction: light.direction };
                        if !scene.occluded::<EXTRAS>(&shadow, reach(&light), traversal) {
                            let density = medium.phase(ray.direction, light.direction);
                            let weight = power_heuristic(light.density, density) / light.density * density;
                            out.color +=
                                throughput * light.radiance * medium.transmittance(light.distance) * weight;
                        }
                    }
                    let v = sampler.group(2 * edge);
                    let direction = medium.scatter(ray.direction, v[0], v[1]);
                    if !survives(&mut throughput, squared_index, edge, v[3]) {
                        break;
                    }
                    previous = Some((medium.phase(ray.direction, direction), Vec3A::Y));
                    ray = Ray { origin: point, direction };
                    edge += 1;
                    continue;
                }
            }
        }
        // With photon maps, light that meets the gathering ray later than directly is in the maps.
        let counts = !EXTRAS || gathered.is_none_or(|g| edge == g + 1);
        let Some(hit) = hit else {
            if FEATURES && edge == feature_edge {
                (out.albedo, out.normal, out.depth, out.material) = (Vec3A::ZERO, Vec3A::ZERO, 0.0, -1);
                if EXTRAS {
                    (out.brdf, out.motion, out.caustics) = (Vec3A::ZERO, [0.0; 2], 0.0);
                }
            }
            if counts {
                out.color += throughput * scene.lights.background(ray.direction, previous);
            }
            break;
        };
        let geometry = &scene.geometry[hit.primitive as usize];
        let surface = &scene.surfaces[geometry.material as usize];
        let last = edge >= view.depth;
        let shaded = !last || FEATURES && edge == feature_edge || FLASH && reuse == Reuse::Following;
        // At the end of the longest path only emission matters.
        if !(shaded || surface.emits) {
            break;
        }
        let at = scene.interact::<EXTRAS>(&ray, &hit, traversal);
        if surface.emits && counts {
            out.color += throughput * emission(scene, geometry, &at, &ray, hit.t, previous);
        }
        if !shaded {
            break;
        }
        let event = surface.scatter.at(at.uv);
        if FEATURES && edge == feature_edge {
            way += hit.t;
            // Without rare features the numbers are not looked at.
            let u = if EXTRAS { sampler.group(2 * edge) } else { [0.0; 4] };
            let seen = Seen { hit: &hit, at: &at, event: &event, to_viewer: -ray.direction, u };
            describe::<EXTRAS>(&mut out, scene, view, &seen, (tint, way), traversal);
        }
        if FEATURES && edge == feature_edge + 1 {
            out.direct = out.color;
            direct_open = false;
        }
        if FLASH && reuse == Reuse::Ending {
            out.flash_base = out.color;
            reuse = Reuse::Done;
        }
        if EXTRAS {
            length += hit.t;
        }
        let to_viewer = -ray.direction;
        let lobe = match event {
            Event::Lobe(lobe) => lobe,
            Event::Specular(specular) => {
                if last {
                    break;
                }
                let u = sampler.group(2 * edge);
                let (direction, scale, _) = specular.follow(&at, to_viewer, u[2]);
                throughput *= specular.tint() * scale;
                if FEATURES && view.follow && edge == feature_edge {
                    tint *= specular.tint();
                    feature_edge += 1;
                }
                if EXTRAS && direction.dot(at.geometric) < 0.0 {
                    outside = !at.front;
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
            out.eye_light += eye_light(scene, view, before, &lobe, &at, to_viewer);
        }
        if last {
            break;
        }
        if EXTRAS
            && view.gather
            && let Some(photons) = view.photons
            && let Lobe::Diffuse { albedo } = lobe
        {
            let left = view.depth - edge; // not the last edge
            if gathered.is_some() {
                by_photons += throughput * albedo * photons.global(&at, left) * FRAC_1_PI;
                break;
            }
            let (caustic, _) = photons.caustic(&at, view.pixel * length, left);
            by_photons += throughput * albedo * caustic * FRAC_1_PI;
        }
        if !EXTRAS || gathered.is_none() {
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
                    if !scene.occluded::<EXTRAS>(&shadow, reach(&light), traversal) {
                        let mut weight =
                            Vec3A::splat(power_heuristic(light.density, density) / light.density);
                        if EXTRAS
                            && outside
                            && let Some(medium) = &scene.medium
                        {
                            weight *= medium.transmittance(light.distance);
                        }
                        out.color += throughput * value * light.radiance * weight;
                        if FEATURES && edge == feature_edge {
                            out.reached = 1.0;
                        }
                    }
                }
            }
        }
        let v = sampler.group(2 * edge);
        let scattered = lobe.sample(&at, to_viewer, v[0], v[1]);
        let Some(scattered) = scattered else { break };
        throughput *= scattered.weight;
        if !survives(&mut throughput, squared_index, edge, v[3]) {
            break;
        }
        if FLASH && reuse == Reuse::Following && matches!(lobe, Lobe::Diffuse { .. }) {
            reuse = Reuse::Ending;
        }
        if EXTRAS && view.gather && gathered.is_none() && matches!(lobe, Lobe::Diffuse { .. }) {
            gathered = Some(edge);
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
    if EXTRAS {
        out.color += by_photons;
    }
    out
}

/// A surface whose features are wanted, and the numbers with which a path goes on from there.
struct Seen<'a> {
    hit: &'a Hit,
    at: &'a Interaction,
    event: &'a Event,
    to_viewer: Vec3A,
    u: [f32; 4],
}

/// The features of a surface behind specular ones of this tint, `way` along the path.
#[inline(always)]
fn describe<const EXTRAS: bool>(
    out: &mut Outcome,
    scene: &Prepared,
    view: &View<'_>,
    seen: &Seen<'_>,
    (tint, way): (Vec3A, f32),
    traversal: &Traversal,
) {
    out.albedo = tint * seen.event.albedo();
    out.normal = seen.at.normal;
    out.depth = way;
    out.material = scene.geometry[seen.hit.primitive as usize].material as i32;
    if EXTRAS {
        rarities(out, scene, view, seen, traversal);
        out.brdf *= tint;
    }
}

/// The features that few ask for.
#[inline(never)]
fn rarities(out: &mut Outcome, scene: &Prepared, view: &View<'_>, seen: &Seen<'_>, traversal: &Traversal) {
    let &Seen { hit, at, event, to_viewer, u } = seen;
    // Of the direction that the path takes, or would take if it went on.
    out.brdf = match event {
        Event::Specular(specular) => specular.tint(),
        Event::Lobe(lobe) => lobe.sample(at, to_viewer, u[0], u[1]).map_or(Vec3A::ZERO, |s| s.weight),
    };
    if let Some(frames) = &view.frames {
        let [start, end] = scene.over_a_frame(hit, at.point, traversal);
        out.motion = match (frames[0].project(start), frames[1].project(end)) {
            (Some(from), Some(to)) => [to[0] - from[0], to[1] - from[1]],
            _ => [0.0; 2],
        };
    }
    if let Some(photons) = view.photons {
        out.caustics = photons.caustic(at, view.pixel * out.depth, DEEPEST).1;
    }
}

/// Light of unit intensity at the eye, scattered by a lobe and without a shadow.
#[inline(always)]
fn eye_light(
    scene: &Prepared,
    view: &View<'_>,
    throughput: Vec3A,
    lobe: &Lobe,
    at: &Interaction,
    to_viewer: Vec3A,
) -> Vec3A {
    let to_eye = view.eye - at.point;
    let squared = to_eye.length_squared().max(scene.least_eye_distance * scene.least_eye_distance);
    let to_eye = to_eye.normalize_or(at.normal);
    throughput * lobe.eval(at, to_viewer, to_eye).0 * (1.0 / squared)
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
mod tests;
