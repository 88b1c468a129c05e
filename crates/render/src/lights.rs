//! Light sources: sampling them, and the density with which a direction that was sampled otherwise would have been.

mod emit;

use std::f32::consts::{FRAC_1_PI, PI, TAU};
use std::sync::Arc;

use glam::{Vec3, Vec3A};
use noisefloor_scenes::Sky;

pub use emit::Ball;

use crate::environment::Environment;
use crate::math::{cosine_hemisphere, luminance, tangents, turn};

/// A source with the probability that it is chosen.
#[derive(Debug, Clone)]
pub struct Light {
    kind: Kind,
    chance: f32,
    /// Distance at which everything that can be hit is passed; for distant light.
    far: f32,
}

#[derive(Debug, Clone)]
enum Kind {
    Triangle { origin: Vec3A, edge1: Vec3A, edge2: Vec3A, normal: Vec3A, inverse_area: f32, emission: Vec3A },
    Sphere { center: Vec3A, radius: f32, emission: Vec3A },
    Sun(SunDisc),
    Sky(Gradient),
    Environment(Arc<Environment>),
}

/// A sky whose radiance is a formula of the direction's height; constant ones are a blend of equals.
#[derive(Debug, Clone, Copy)]
pub struct Gradient {
    horizon: Vec3A,
    rise: Vec3A,
    ground: Vec3A,
}

/// The sun with what its sampling needs.
#[derive(Debug, Clone, Copy)]
pub struct SunDisc {
    direction: Vec3A,
    radiance: Vec3A,
    /// 1 − cos of the half angle, and the squared chord of the half angle: differences that survive rounding.
    height: f32,
    squared_chord: f32,
}

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

/// All sources of a scene.
#[derive(Debug, Clone, Default)]
pub struct Lights {
    lights: Vec<Light>,
    /// Running sums of the chances; the last is 1.
    cumulative: Vec<f32>,
    sky: Option<(Gradient, f32)>,
    environment: Option<(Arc<Environment>, f32)>,
    sun: Option<(SunDisc, f32)>,
}

impl SunDisc {
    /// From the irradiance on a surface that faces the sun.
    pub fn new(direction: Vec3A, half_angle: f32, irradiance: Vec3A) -> Self {
        let (sin_half, sin) = ((0.5 * half_angle).sin(), half_angle.sin());
        Self {
            direction,
            radiance: irradiance / (PI * sin * sin), // half_angle > 0: checked on preparation
            height: 2.0 * sin_half * sin_half,
            squared_chord: 4.0 * sin_half * sin_half,
        }
    }

    #[inline]
    fn contains(&self, w: Vec3A) -> bool {
        (w - self.direction).length_squared() <= self.squared_chord
    }

    #[inline]
    fn density(&self) -> f32 {
        1.0 / (TAU * self.height)
    }

    #[inline]
    fn sample(&self, u: f32, v: f32) -> Vec3A {
        let below = self.height * u; // 1 − cos
        let sin = (below * (2.0 - below)).max(0.0).sqrt();
        let (s, c) = turn(v);
        let (t, b) = tangents(self.direction);
        (t * (sin * c) + b * (sin * s) + self.direction * (1.0 - below)).normalize()
    }
}

impl Gradient {
    fn new(horizon: Vec3, zenith: Vec3, ground: Vec3) -> Self {
        Self { horizon: horizon.into(), rise: (zenith - horizon).into(), ground: ground.into() }
    }

    #[inline]
    fn radiance(&self, w: Vec3A) -> Vec3A {
        if w.y < 0.0 { self.ground } else { self.horizon + self.rise * w.y }
    }

    /// Half the sky's luminous flux through a sphere of radius 1; the other half is left to directions that surfaces
    /// choose.
    fn power(&self) -> f32 {
        // The mean over the upper hemisphere of a blend by the cosine is the middle.
        let mean = (self.horizon + (self.horizon + self.rise)) * 0.25 + self.ground * 0.5;
        0.5 * luminance(mean) * FLUX
    }
}

/// Flux of radiance 1 from everywhere through a sphere of radius 1.
const FLUX: f32 = 4.0 * PI * PI;

fn formula(sky: Gradient) -> (Kind, f32) {
    (Kind::Sky(sky), sky.power())
}

/// Collects sources with their powers.
#[derive(Debug, Default)]
pub struct LightsBuilder {
    sources: Vec<(Kind, f32)>,
}

impl LightsBuilder {
    /// An emissive triangle; returns its index.
    pub fn triangle(&mut self, v: [Vec3A; 3], emission: Vec3A) -> u32 {
        let (edge1, edge2) = (v[1] - v[0], v[2] - v[0]);
        let scaled = edge1.cross(edge2);
        let area = 0.5 * scaled.length(); // positive: degenerate triangles are dropped before
        let kind = Kind::Triangle {
            origin: v[0],
            edge1,
            edge2,
            normal: scaled.normalize(),
            inverse_area: 1.0 / area,
            emission,
        };
        self.sources.push((kind, PI * area * luminance(emission)));
        (self.sources.len() - 1) as u32
    }

    /// An emissive sphere; returns its index.
    pub fn sphere(&mut self, center: Vec3A, radius: f32, emission: Vec3A) -> u32 {
        let power = 4.0 * PI * PI * radius * radius * luminance(emission);
        // Of huge spheres only its being the largest matters.
        let power = power.min(f32::MAX);
        self.sources.push((Kind::Sphere { center, radius, emission }, power));
        (self.sources.len() - 1) as u32
    }

    /// Adds the distant sources and fixes the chances. `radius`: of the scene.
    pub fn finish(mut self, sun: Option<SunDisc>, sky: Option<&Sky>, radius: f32) -> Lights {
        let disc = PI * radius * radius;
        if let Some(sun) = sun {
            let irradiance = sun.radiance * (TAU * sun.height);
            self.sources.push((Kind::Sun(sun), (disc * luminance(irradiance)).min(f32::MAX)));
        }
        if let Some(sky) = sky {
            let (kind, power) = match sky {
                Sky::Constant(radiance) => formula(Gradient::new(*radiance, *radiance, *radiance)),
                Sky::Gradient { horizon, zenith, ground } => {
                    formula(Gradient::new(*horizon, *zenith, *ground))
                }
                Sky::Map(map) => {
                    let environment = Environment::new(Arc::clone(map));
                    let power = environment.mean_luminance() * FLUX;
                    (Kind::Environment(Arc::new(environment)), power)
                }
            };
            self.sources.push((kind, (radius * radius * power).min(f32::MAX)));
        }
        let total: f64 = self.sources.iter().map(|s| f64::from(s.1)).sum();
        let mut out = Lights::default();
        let mut sum = 0.0;
        for (kind, power) in self.sources {
            // A black light keeps its place, so that indices hold, and is never chosen.
            let chance = if total > 0.0 { f64::from(power) / total } else { 0.0 };
            sum += chance;
            let chance = chance as f32;
            match &kind {
                Kind::Sun(sun) => out.sun = Some((*sun, chance)),
                Kind::Sky(sky) => out.sky = Some((*sky, chance)),
                Kind::Environment(sky) => out.environment = Some((Arc::clone(sky), chance)),
                _ => {}
            }
            out.lights.push(Light { kind, chance, far: 2.0 * radius });
            out.cumulative.push(sum as f32);
        }
        if total > 0.0
            && let Some(last) = out.lights.iter().rposition(|light| light.chance > 0.0)
        {
            // Rounding must not leave a gap below 1.
            out.cumulative[last..].fill(1.0);
        } else {
            out.lights.clear();
        }
        out
    }
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
                crate::math::power_heuristic(density, rival)
            });
            sum += sky.radiance(w) * weight;
        }
        if let Some((sky, chance)) = &self.environment {
            let (radiance, own) = sky.look(w);
            let weight =
                previous.map_or(1.0, |(density, _)| crate::math::power_heuristic(density, chance * own));
            sum += radiance * weight;
        }
        if let Some((sun, chance)) = &self.sun
            && sun.contains(w)
        {
            let weight = previous
                .map_or(1.0, |(density, _)| crate::math::power_heuristic(density, chance * sun.density()));
            sum += sun.radiance * weight;
        }
        sum
    }
}

/// Squared relative distance from a sphere's centre within which the sphere is left to the directions that surfaces
/// choose: its inside does not shine, and from the surface itself its cone is a hemisphere without a centre.
const OUTSIDE: f32 = 1.000_1;

/// 1 − cos of the half angle under which a sphere is seen, from the squared sine; without cancellation.
#[inline]
fn cap_height(squared_sine: f32) -> f32 {
    squared_sine / (1.0 + (1.0 - squared_sine).max(0.0).sqrt())
}

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
