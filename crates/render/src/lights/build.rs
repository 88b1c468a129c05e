//! From the lamps, the sun and the sky of a scene to its sources.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use glam::Vec3A;
use noisefloor_scenes::Sky;

use super::source::{FLUX, Gradient, Kind, Light, Lights, SunDisc};
use crate::environment::Environment;
use crate::math::luminance;

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
