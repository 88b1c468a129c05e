//! Directions towards sources, and what arrives from infinitely far away.

use std::f32::consts::{FRAC_1_PI, TAU};

use glam::Vec3A;

use super::source::{Kind, Light, Lights, cap_height};
use crate::math::{cosine_hemisphere, power_heuristic, tangents, turn};

/// A direction towards a light.
#[derive(Debug, Clone, Copy)]
pub struct LightSample {
    /// Unit direction.
    pub direction: Vec3A,
    /// How far a shadow ray goes.
    pub distance: f32,
    /// Radiance from there.
    pub radiance: Vec3A,
    /// Density per solid angle, positive.
    pub density: f32,
}

impl Lights {
    /// A direction from `point` towards a light chosen in proportion to power. `normal`: of the surface there, on the
    /// side that is lit. `None` if the light shows its back.
    #[inline(always)]
    pub fn sample(&self, point: Vec3A, normal: Vec3A, u: [f32; 4]) -> Option<LightSample> {
        let light = match &self.lights[..] {
            [] => return None,
            [only] => only,
            many => &many[self.cumulative.partition_point(|&sum| sum <= u[2]).min(many.len() - 1)],
        };
        let mut sample = light.sample(point, normal, u[0], u[1])?;
        sample.density *= light.chance;
        // Excludes densities that underflow or overflow, so that no later quotient is infinite or NaN.
        (sample.density > 1e-30 && sample.density < 1e30).then_some(sample)
    }

    /// Density with which [`Lights::sample`] at the ray's origin gives the direction of a ray that hits light `index`
    /// at distance `t` with geometric cosine `cos` there.
    #[inline(always)]
    pub fn density(&self, index: u32, origin: Vec3A, t: f32, cos: f32) -> f32 {
        let Some(light) = self.lights.get(index as usize) else { return 0.0 };
        light.chance
            * match &light.kind {
                Kind::Triangle { inverse_area, .. } => t * t * inverse_area / cos.abs().max(1e-12),
                Kind::Sphere { center, radius, .. } => {
                    let squared = (*center - origin).length_squared();
                    if squared <= radius * radius * OUTSIDE {
                        0.0
                    } else {
                        1.0 / (TAU * cap_height(radius * radius / squared))
                    }
                }
                Kind::Sun(_) | Kind::Sky(_) | Kind::Environment(_) => 0.0,
            }
    }

    /// Radiance that arrives from infinitely far along `w`, weighted against light sampling. `previous`: density with
    /// which the last vertex sampled `w` and its normal, or `None` if nothing competes.
    #[inline(always)]
    pub fn background(&self, w: Vec3A, previous: Option<(f32, Vec3A)>) -> Vec3A {
        let mut sum = Vec3A::ZERO;
        if let Some((sky, chance)) = &self.sky {
            let weight = previous.map_or(1.0, |(density, normal)| {
                let rival = chance * w.dot(normal).max(0.0) * FRAC_1_PI;
                power_heuristic(density, rival)
            });
            sum += sky.radiance(w) * weight;
        }
        if let Some((sky, chance)) = &self.environment {
            let (radiance, own) = sky.look(w);
            let weight = previous.map_or(1.0, |(density, _)| power_heuristic(density, chance * own));
            sum += radiance * weight;
        }
        if let Some((sun, chance)) = &self.sun
            && sun.contains(w)
        {
            let weight =
                previous.map_or(1.0, |(density, _)| power_heuristic(density, chance * sun.density()));
            sum += sun.radiance * weight;
        }
        sum
    }
}

/// Squared relative distance from a sphere's centre within which the sphere is left to the directions that surfaces
/// choose: its inside does not shine, and from the surface itself its cone is a hemisphere without a centre.
const OUTSIDE: f32 = 1.000_1;

impl Light {
    #[inline(always)]
    fn sample(&self, point: Vec3A, normal: Vec3A, u: f32, v: f32) -> Option<LightSample> {
        match &self.kind {
            Kind::Triangle { origin, edge1, edge2, normal, inverse_area, emission } => {
                // Heitz (2019): keeps neighbourhoods and needs no root.
                let (mut a, mut b) = (u, v);
                if b > a {
                    a *= 0.5;
                    b -= a;
                } else {
                    b *= 0.5;
                    a -= b;
                }
                let to = *origin + *edge1 * a + *edge2 * b - point;
                let squared = to.length_squared();
                let along = -to.dot(*normal);
                if along <= 0.0 {
                    return None;
                }
                let distance = squared.sqrt();
                let direction = to * (1.0 / distance);
                // distance > 0 because `along` is
                let density = squared * distance * inverse_area / along;
                Some(LightSample { direction, distance, radiance: *emission, density })
            }
            Kind::Sphere { center, radius, emission } => {
                sample_sphere(point, *center, *radius, *emission, u, v)
            }
            Kind::Sun(sun) => Some(LightSample {
                direction: sun.sample(u, v),
                distance: f32::INFINITY,
                radiance: sun.radiance,
                density: sun.density(),
            }),
            Kind::Sky(sky) => {
                let (direction, cos) = cosine_hemisphere(normal, u, v);
                Some(LightSample {
                    direction,
                    distance: f32::INFINITY,
                    radiance: sky.radiance(direction),
                    density: cos * FRAC_1_PI,
                })
            }
            Kind::Environment(sky) => {
                let (direction, radiance, density) = sky.sample(u, v);
                Some(LightSample { direction, distance: f32::INFINITY, radiance, density })
            }
        }
    }
}

/// Uniform in the cone of the visible cap; nothing from inside and from the surface itself.
#[inline(always)]
fn sample_sphere(
    point: Vec3A,
    center: Vec3A,
    radius: f32,
    emission: Vec3A,
    u: f32,
    v: f32,
) -> Option<LightSample> {
    let to = center - point;
    let squared = to.length_squared();
    if squared <= radius * radius * OUTSIDE {
        return None;
    }
    let squared_sine = radius * radius / squared;
    let height = cap_height(squared_sine);
    let below = height * u; // 1 − cos of the angle to the centre
    let sin2 = (below * (2.0 - below)).max(0.0);
    let (s, c) = turn(v);
    let sin = sin2.sqrt();
    let distance = squared.sqrt();
    let axis = to * (1.0 / distance);
    let (t, b) = tangents(axis);
    let cos = 1.0 - below;
    let direction = (t * (sin * c) + b * (sin * s) + axis * cos).normalize();
    let near = distance * cos - (radius * radius - squared * sin2).max(0.0).sqrt();
    Some(LightSample { direction, distance: near, radiance: emission, density: 1.0 / (TAU * height) })
}
