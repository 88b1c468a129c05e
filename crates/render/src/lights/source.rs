//! Sources as they are kept.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use glam::{Vec3, Vec3A};

use crate::environment::Environment;
use crate::math::{luminance, tangents, turn};

/// A source with the probability that it is chosen.
#[derive(Debug, Clone)]
pub struct Light {
    pub(super) kind: Kind,
    pub(super) chance: f32,
    /// Distance at which everything that can be hit is passed; for distant light.
    pub(super) far: f32,
}

/// What shines.
#[derive(Debug, Clone)]
pub(super) enum Kind {
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
    pub(super) radiance: Vec3A,
    /// 1 − cos of the half angle, and the squared chord of the half angle: differences that survive rounding.
    pub(super) height: f32,
    squared_chord: f32,
}

/// All sources of a scene.
#[derive(Debug, Clone, Default)]
pub struct Lights {
    pub(super) lights: Vec<Light>,
    /// Running sums of the chances; the last is 1.
    pub(super) cumulative: Vec<f32>,
    pub(super) sky: Option<(Gradient, f32)>,
    pub(super) environment: Option<(Arc<Environment>, f32)>,
    pub(super) sun: Option<(SunDisc, f32)>,
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
    pub(super) fn contains(&self, w: Vec3A) -> bool {
        (w - self.direction).length_squared() <= self.squared_chord
    }

    #[inline]
    pub(super) fn density(&self) -> f32 {
        1.0 / (TAU * self.height)
    }

    #[inline]
    pub(super) fn sample(&self, u: f32, v: f32) -> Vec3A {
        let below = self.height * u; // 1 − cos
        let sin = (below * (2.0 - below)).max(0.0).sqrt();
        let (s, c) = turn(v);
        let (t, b) = tangents(self.direction);
        (t * (sin * c) + b * (sin * s) + self.direction * (1.0 - below)).normalize()
    }
}

impl Gradient {
    pub(super) fn new(horizon: Vec3, zenith: Vec3, ground: Vec3) -> Self {
        Self { horizon: horizon.into(), rise: (zenith - horizon).into(), ground: ground.into() }
    }

    #[inline]
    pub(super) fn radiance(&self, w: Vec3A) -> Vec3A {
        if w.y < 0.0 { self.ground } else { self.horizon + self.rise * w.y }
    }

    /// Half the sky's luminous flux through a sphere of radius 1; the other half is left to directions that surfaces
    /// choose.
    pub(super) fn power(&self) -> f32 {
        // The mean over the upper hemisphere of a blend by the cosine is the middle.
        let mean = (self.horizon + (self.horizon + self.rise)) * 0.25 + self.ground * 0.5;
        0.5 * luminance(mean) * FLUX
    }
}

/// Flux of radiance 1 from everywhere through a sphere of radius 1.
pub(super) const FLUX: f32 = 4.0 * PI * PI;

/// 1 − cos of the half angle under which a sphere is seen, from the squared sine; without cancellation.
#[inline]
pub(super) fn cap_height(squared_sine: f32) -> f32 {
    squared_sine / (1.0 + (1.0 - squared_sine).max(0.0).sqrt())
}
