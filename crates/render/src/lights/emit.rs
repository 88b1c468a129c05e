//! Light that leaves its sources: where light paths start.

use std::f32::consts::{PI, TAU};

use glam::Vec3A;

use super::source::{FLUX, Kind, Light, Lights, cap_height};
use crate::math::{cosine_hemisphere, luminance, tangents, turn};

/// Distance from a lamp at which its photons start, in units of its coordinates: as far as hits keep clear of surfaces.
const EMITTER_CLEARANCE: f32 = 3e-6;

/// A sphere that light is sent to.
#[derive(Debug, Clone, Copy)]
pub struct Ball {
    /// Its centre.
    pub center: Vec3A,
    /// Its radius, positive.
    pub radius: f32,
}

impl Ball {
    /// From `point` with the surface normal `normal`: a direction and its cosine over its density, such that every
    /// direction above the surface that meets the ball is found.
    fn aim(&self, point: Vec3A, normal: Vec3A, u: f32, v: f32) -> (Vec3A, f32) {
        let to = self.center - point;
        let squared = to.length_squared();
        let squared_sine = self.radius * self.radius / squared.max(f32::MIN_POSITIVE);
        // From within or close by the cone is hardly narrower than the hemisphere.
        if squared_sine > 0.5 {
            return (cosine_hemisphere(normal, u, v).0, PI);
        }
        let height = cap_height(squared_sine);
        let below = height * u;
        let sin = (below * (2.0 - below)).max(0.0).sqrt();
        let (s, c) = turn(v);
        let axis = to * (1.0 / squared.sqrt());
        let (t, b) = tangents(axis);
        let direction = (t * (sin * c) + b * (sin * s) + axis * (1.0 - below)).normalize();
        (direction, direction.dot(normal).max(0.0) * TAU * height)
    }
}

/// Chances with which sources are chosen.
#[derive(Debug, Clone)]
pub struct Chances {
    cumulative: Vec<f32>,
    chances: Vec<f32>,
}

/// A direction among all, evenly.
fn even_direction(u: f32, v: f32) -> Vec3A {
    let (s, c) = turn(v);
    let sin = (4.0 * u * (1.0 - u)).max(0.0).sqrt();
    Vec3A::new(sin * c, sin * s, 1.0 - 2.0 * u)
}

impl Lights {
    /// Chances of the sources, in proportion to the light that each sends into a sphere.
    pub fn towards(&self, target: Ball) -> Chances {
        let weights: Vec<f64> = self.lights.iter().map(|light| f64::from(light.flux_to(target))).collect();
        let total: f64 = weights.iter().sum();
        let share = |w: f64| if total > 0.0 { (w / total) as f32 } else { 0.0 };
        let mut sum = 0.0;
        let cumulative = weights.iter().map(|w| {
            sum += w;
            share(sum)
        });
        Chances { cumulative: cumulative.collect(), chances: weights.iter().map(|w| share(*w)).collect() }
    }

    /// Light that leaves a source into a sphere, or some more of it: origin, direction, and its flux over the density
    /// of all choices. `u` places it, `v` turns it. Nothing that would meet the sphere is left out. `None` where the
    /// source has nothing to give.
    pub fn emit(
        &self,
        u: [f32; 4],
        v: [f32; 4],
        target: Ball,
        by: &Chances,
    ) -> Option<(Vec3A, Vec3A, Vec3A)> {
        let last = self.lights.len().checked_sub(1)?;
        let index = by.cumulative.partition_point(|&sum| sum <= u[2]).min(last);
        let chance = by.chances[index];
        if chance <= 0.0 {
            return None;
        }
        let (origin, direction, flux) = self.lights[index].emit(u, v, target);
        let flux = flux * (1.0 / chance);
        (flux.is_finite() && flux.max_element() > 0.0).then_some((origin, direction, flux))
    }
}

impl Light {
    /// About the luminous flux into a ball; positive wherever some of it could get there.
    fn flux_to(&self, ball: Ball) -> f32 {
        let share = |at: Vec3A| {
            let squared = (ball.center - at).length_squared();
            (ball.radius * ball.radius / squared.max(f32::MIN_POSITIVE)).min(1.0)
        };
        let squared = ball.radius * ball.radius;
        match &self.kind {
            Kind::Triangle { origin, edge1, edge2, inverse_area, emission, .. } => {
                let middle = *origin + (*edge1 + *edge2) * (1.0 / 3.0);
                luminance(*emission) * PI / inverse_area * share(middle)
            }
            Kind::Sphere { center, radius, emission } => {
                luminance(*emission) * 4.0 * PI * PI * radius * radius * share(*center)
            }
            Kind::Sun(sun) => luminance(sun.radiance) / sun.density() * PI * squared,
            // Its power is half of that through a sphere of radius 1.
            Kind::Sky(sky) => 2.0 * sky.power() * squared,
            Kind::Environment(sky) => sky.mean_luminance() * FLUX * squared,
        }
    }

    /// Origin, direction, flux over density; the source is given.
    fn emit(&self, u: [f32; 4], v: [f32; 4], ball: Ball) -> (Vec3A, Vec3A, Vec3A) {
        // Through a disc that faces the direction from which distant light comes, from beyond the whole scene.
        let distant = |from: Vec3A| {
            let (a, b) = crate::math::concentric_disc(u[0], u[1]);
            let (t, s) = tangents(from);
            let origin = ball.center + (t * a + s * b) * ball.radius;
            (origin + from * self.far, -from, PI * ball.radius * ball.radius)
        };
        match &self.kind {
            Kind::Triangle { origin, edge1, edge2, normal, inverse_area, emission } => {
                let (mut a, mut b) = (u[0], u[1]);
                if a + b > 1.0 {
                    (a, b) = (1.0 - a, 1.0 - b);
                }
                // Clear of the lamp itself, as hits are.
                let size = origin.abs().max_element() + edge1.abs().max_element() + edge2.abs().max_element();
                let point = *origin + *edge1 * a + *edge2 * b + *normal * (EMITTER_CLEARANCE * size);
                let (direction, weight) = ball.aim(point, *normal, v[0], v[1]);
                (point, direction, *emission * (weight / inverse_area))
            }
            Kind::Sphere { center, radius, emission } => {
                let normal = even_direction(u[0], u[1]);
                let lift = EMITTER_CLEARANCE * (center.abs().max_element() + radius);
                let point = *center + normal * (radius + lift);
                let (direction, weight) = ball.aim(point, normal, v[0], v[1]);
                (point, direction, *emission * (weight * 4.0 * PI * radius * radius))
            }
            Kind::Sun(sun) => {
                let (origin, direction, area) = distant(sun.sample(v[0], v[1]));
                (origin, direction, sun.radiance * (area / sun.density()))
            }
            Kind::Sky(sky) => {
                let from = even_direction(v[0], v[1]);
                let (origin, direction, area) = distant(from);
                (origin, direction, sky.radiance(from) * (4.0 * PI * area))
            }
            Kind::Environment(sky) => {
                let (from, radiance, density) = sky.sample(v[0], v[1]);
                let (origin, direction, area) = distant(from);
                // A density of 0 only where the radiance is 0, too.
                (origin, direction, radiance * (area / density.max(1e-30)))
            }
        }
    }
}
