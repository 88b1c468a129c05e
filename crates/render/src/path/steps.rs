//! The steps of a path.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3A;

use crate::bsdf::{Lobe, Specular};
use crate::bvh::Ray;
use crate::geometry::Geometry;
use crate::interaction::Interaction;
use crate::intersect::Traversal;
use crate::lights::LightSample;
use crate::math::power_heuristic;
use crate::medium::Medium;
use crate::prepare::Prepared;
use crate::sampler::Sampler;
use crate::view::View;

/// Edges before Russian roulette starts.
const SURE_EDGES: u32 = 3;

/// Least chance to survive it, so that no survivor becomes absurdly bright.
const LEAST_CHANCE: f32 = 1e-3;

/// A path on its way from the eye.
pub struct Path<S> {
    /// Random numbers: group 2e − 1 for the light and the medium of edge e, group 2e for where it goes on.
    pub sampler: S,
    /// The edge that is being followed.
    pub ray: Ray,
    /// Its number, from 1.
    pub edge: u32,
    /// What was gathered.
    pub color: Vec3A,
    /// Factor on light from here to the eye.
    pub throughput: Vec3A,
    /// Product of the squared index ratios in `throughput`: roulette must not see that radiance is low inside glass.
    squared_index: f32,
    /// Density and normal of the last vertex if light sampling competed with its choice.
    pub previous: Option<(f32, Vec3A)>,
    /// Whether the path is outside glass, where a medium is.
    pub outside: bool,
    /// Length of the way so far.
    pub length: f32,
    /// Edge at whose end the photon maps took over.
    pub gathered: Option<u32>,
    /// What the maps gave.
    pub by_photons: Vec3A,
}

impl<S: Sampler> Path<S> {
    /// At the eye.
    #[inline(always)]
    pub fn new(sampler: S, ray: Ray) -> Self {
        Self {
            sampler,
            ray,
            edge: 1,
            color: Vec3A::ZERO,
            throughput: Vec3A::ONE,
            squared_index: 1.0,
            previous: None,
            outside: true,
            length: 0.0,
            gathered: None,
            by_photons: Vec3A::ZERO,
        }
    }

    /// Whether light that the present edge meets counts: what meets a gathering ray later than directly is in the
    /// photon maps.
    #[inline(always)]
    pub fn counts<const EXTRAS: bool>(&self) -> bool {
        !EXTRAS || self.gathered.is_none_or(|edge| self.edge == edge + 1)
    }

    /// Goes on along a ray. `rival`: density and normal, if light sampling competed with the choice of it.
    #[inline(always)]
    fn go(&mut self, origin: Vec3A, direction: Vec3A, rival: Option<(f32, Vec3A)>) {
        self.previous = rival;
        self.ray = Ray { origin, direction };
        self.edge += 1;
    }

    /// A collision with the medium after a flight of length `t`: light sampling, then a direction by the phase function.
    /// False if the path ends.
    #[inline(always)]
    pub fn scatter_in_medium<const EXTRAS: bool>(
        &mut self,
        scene: &Prepared,
        medium: &Medium,
        t: f32,
        weight: Vec3A,
        traversal: &mut Traversal,
    ) -> bool {
        self.throughput *= weight;
        let forward = self.ray.direction;
        let point = self.ray.origin + forward * t;
        let u = self.sampler.group(2 * self.edge - 1);
        // The normal matters for skies alone, and light from there does not get through a medium.
        if let Some(light) = scene.lights.sample(point, Vec3A::Y, u) {
            let shadow = Ray { origin: point, direction: light.direction };
            if !scene.occluded::<EXTRAS>(&shadow, reach(&light), traversal) {
                let density = medium.phase(forward, light.direction);
                let weight = power_heuristic(light.density, density) / light.density * density;
                self.color +=
                    self.throughput * light.radiance * medium.transmittance(light.distance) * weight;
            }
        }
        let v = self.sampler.group(2 * self.edge);
        let direction = medium.scatter(forward, v[0], v[1]);
        if !self.survives(v[3]) {
            return false;
        }
        self.go(point, direction, Some((medium.phase(forward, direction), Vec3A::Y)));
        true
    }

    /// Reflection or refraction by a mirror or glass. False if the path ends.
    #[inline(always)]
    pub fn follow<const EXTRAS: bool>(
        &mut self,
        specular: &Specular,
        at: &Interaction,
        to_viewer: Vec3A,
        choice: [f32; 4],
    ) -> bool {
        let (direction, scale, _) = specular.follow(at, to_viewer, choice[2]);
        self.throughput *= specular.tint() * scale;
        if EXTRAS && direction.dot(at.geometric) < 0.0 {
            self.outside = !at.front;
        }
        self.squared_index *= scale;
        if !self.survives(choice[3]) {
            return false;
        }
        self.go(at.leave(direction), direction, None);
        true
    }

    /// Adds what the photon maps know about a diffuse surface. True if that is everything, so that the path ends.
    #[inline(always)]
    pub fn gather(&mut self, view: &View<'_>, at: &Interaction, lobe: &Lobe) -> bool {
        let (Some(photons), &Lobe::Diffuse { albedo }) = (view.photons, lobe) else { return false };
        let left = view.depth - self.edge; // not the last edge
        if self.gathered.is_some() {
            self.by_photons += self.throughput * albedo * photons.global(at, left) * FRAC_1_PI;
            return true;
        }
        let (caustic, _) = photons.caustic(at, view.pixel * self.length, left);
        self.by_photons += self.throughput * albedo * caustic * FRAC_1_PI;
        false
    }

    /// Adds light by a shadow ray, weighted against the chance that the surface's own choice finds it. Whether the light
    /// was reached, if a ray was traced.
    #[inline(always)]
    pub fn sample_light<const EXTRAS: bool>(
        &mut self,
        scene: &Prepared,
        at: &Interaction,
        lobe: &Lobe,
        to_viewer: Vec3A,
        traversal: &mut Traversal,
    ) -> Option<bool> {
        let u = self.sampler.group(2 * self.edge - 1);
        // From where the shadow ray starts: a light's rim seen from beside it is another rim.
        let origin = at.leave(at.geometric);
        let light = scene.lights.sample(origin, at.normal, u)?;
        let (value, density) = lobe.eval(at, to_viewer, light.direction);
        let shadow = (density > 0.0).then_some(Ray { origin, direction: light.direction })?;
        if scene.occluded::<EXTRAS>(&shadow, reach(&light), traversal) {
            return Some(false);
        }
        let mut weight = Vec3A::splat(power_heuristic(light.density, density) / light.density);
        if EXTRAS
            && self.outside
            && let Some(medium) = &scene.medium
        {
            weight *= medium.transmittance(light.distance);
        }
        self.color += self.throughput * value * light.radiance * weight;
        Some(true)
    }

    /// Chooses where the path goes from a surface. False if it ends.
    #[inline(always)]
    pub fn bounce<const EXTRAS: bool>(
        &mut self,
        view: &View<'_>,
        at: &Interaction,
        lobe: &Lobe,
        to_viewer: Vec3A,
        choice: [f32; 4],
    ) -> bool {
        let Some(scattered) = lobe.sample(at, to_viewer, choice[0], choice[1]) else { return false };
        self.throughput *= scattered.weight;
        if !self.survives(choice[3]) {
            return false;
        }
        if EXTRAS && view.gather && self.gathered.is_none() && matches!(lobe, Lobe::Diffuse { .. }) {
            self.gathered = Some(self.edge);
        }
        self.go(at.leave(scattered.direction), scattered.direction, Some((scattered.density, at.normal)));
        true
    }

    /// Russian roulette: ends dim paths and makes the survivors brighter, so that the mean stays. False also for paths
    /// that carry nothing.
    #[inline(always)]
    fn survives(&mut self, u: f32) -> bool {
        let brightest = self.throughput.max_element() / self.squared_index;
        // Not `brightest <= 0`: false for the NaN of two underflows, too.
        let carries = brightest > 0.0;
        if self.edge < SURE_EDGES || !carries {
            return carries;
        }
        let chance = brightest.clamp(LEAST_CHANCE, 1.0);
        if u >= chance {
            return false;
        }
        self.throughput *= 1.0 / chance;
        true
    }
}

/// Radiance of a hit towards the viewer, weighted against light sampling if that competed (Veach 1997, the power
/// heuristic).
#[inline(always)]
pub fn emission(
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
pub fn reach(light: &LightSample) -> f32 {
    light.distance * (1.0 - 1e-4)
}
