//! Rough conductor: GGX normals, height-correlated Smith masking, Schlick's Fresnel term, single scattering.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3A;

use super::scattered::Scattered;
use crate::math::{reflect, tangents, turn};

/// Below this α the lobe is narrower than `f32` directions resolve.
pub const SMOOTHEST: f32 = 1e-3;

#[inline(always)]
fn schlick(f0: Vec3A, cos: f32) -> Vec3A {
    let m = (1.0 - cos).clamp(0.0, 1.0);
    let m2 = m * m;
    f0 + (Vec3A::ONE - f0) * (m2 * m2 * m)
}

/// z·(1 + 2Λ), which has no pole at the horizon.
#[inline(always)]
fn shadowing(z: f32, squared_alpha: f32) -> f32 {
    (squared_alpha + (1.0 - squared_alpha) * z * z).sqrt()
}

/// Density of normals at a unit vector with tangential part (x, y) and cosine z.
#[inline(always)]
fn normals(x: f32, y: f32, z: f32, squared_alpha: f32) -> f32 {
    let stretched = (x * x + y * y) / squared_alpha + z * z; // ≥ 1 up to rounding, since α ≤ 1
    FRAC_1_PI / (squared_alpha * stretched * stretched)
}

/// Scattering function times cosine, and the density of [`sample`]; both directions are above the horizon.
#[inline(always)]
pub fn eval(f0: Vec3A, alpha: f32, normal: Vec3A, out: Vec3A, to: Vec3A) -> (Vec3A, f32) {
    let squared_alpha = alpha * alpha;
    let (zo, zi) = (out.dot(normal), to.dot(normal));
    let half = out + to;
    let squared = half.length_squared();
    if squared < 1e-12 {
        return (Vec3A::ZERO, 0.0); // opposite grazing directions
    }
    let half = half * (1.0 / squared.sqrt());
    let z = half.dot(normal);
    let tangential = half - normal * z;
    let d = normals(tangential.length(), 0.0, z, squared_alpha);
    let (so, si) = (shadowing(zo, squared_alpha), shadowing(zi, squared_alpha));
    let fresnel = schlick(f0, out.dot(half));
    // F·D·G₂/(4·zo) with G₂ = 2·zo·zi/(so·zi + si·zo); both terms below are positive because α and zo are.
    (fresnel * (d * zi / (2.0 * (so * zi + si * zo))), d / (2.0 * (zo + so)))
}

/// A direction from the visible normals (Dupuy and Benyoub 2023). `None` if it points below the horizon.
#[inline(always)]
pub fn sample(f0: Vec3A, alpha: f32, normal: Vec3A, out: Vec3A, u: f32, v: f32) -> Option<Scattered> {
    let squared_alpha = alpha * alpha;
    let (t, b) = tangents(normal);
    let (x, y, zo) = (out.dot(t), out.dot(b), out.dot(normal));
    let stretched = Vec3A::new(x * alpha, y * alpha, zo).normalize_or(Vec3A::Z);
    let (s, c) = turn(u);
    let z = (1.0 - v) * (1.0 + stretched.z) - stretched.z;
    let sin = (1.0 - z * z).max(0.0).sqrt();
    let cap = Vec3A::new(sin * c, sin * s, z) + stretched;
    let micro = Vec3A::new(cap.x * alpha, cap.y * alpha, cap.z.max(0.0)).normalize_or(Vec3A::Z);
    let world = (t * micro.x + b * micro.y + normal * micro.z).normalize();
    let direction = reflect(out, world);
    let zi = direction.dot(normal);
    let facing = out.dot(world);
    if zi <= 0.0 || facing <= 0.0 {
        return None;
    }
    let (so, si) = (shadowing(zo, squared_alpha), shadowing(zi, squared_alpha));
    let weight = schlick(f0, facing) * (zi * (zo + so) / (so * zi + si * zo));
    let density = normals(micro.x, micro.y, micro.z, squared_alpha) / (2.0 * (zo + so));
    Some(Scattered { direction, weight, density })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::cosine_hemisphere;
    use crate::sampler::{Independent, Sampler};

    fn directions() -> Vec<Vec3A> {
        [0.05f32, 0.4, 0.9, 1.0].map(|z| Vec3A::new((1.0 - z * z).sqrt(), 0.0, z)).to_vec()
    }

    #[test]
    fn the_weight_is_value_over_density() {
        for alpha in [0.05, 0.3, 1.0] {
            for out in directions() {
                for i in 0..50 {
                    let u = Independent::new(1, i).group(0);
                    let Some(s) = sample(Vec3A::splat(0.6), alpha, Vec3A::Z, out, u[0], u[1]) else {
                        continue;
                    };
                    let (value, density) = eval(Vec3A::splat(0.6), alpha, Vec3A::Z, out, s.direction);
                    assert!((density / s.density - 1.0).abs() < 2e-3, "α {alpha}: {density} {}", s.density);
                    assert!((value.x / density / s.weight.x - 1.0).abs() < 1e-3);
                }
            }
        }
    }

    #[test]
    fn the_function_is_reciprocal() {
        for out in directions() {
            for to in directions() {
                let to = Vec3A::new(0.0, to.x, to.z);
                let f = |a: Vec3A, b: Vec3A| eval(Vec3A::splat(0.3), 0.4, Vec3A::Z, a, b).0.x / b.z;
                assert!((f(out, to) - f(to, out)).abs() <= 1e-5 * f(out, to));
            }
        }
    }

    #[test]
    fn reflected_energy_agrees_with_integration_over_the_hemisphere() {
        // Sampled albedo against the same integral with cosine-distributed directions, within five standard errors.
        let n = 40_000;
        for (alpha, out) in [(0.5, directions()[1]), (0.8, directions()[2])] {
            let (mut a, mut b) =
                (noisefloor_frame::Moments::<1>::default(), noisefloor_frame::Moments::default());
            for i in 0..n {
                let u = Independent::new(7, i).group(0);
                let weight = sample(Vec3A::ONE, alpha, Vec3A::Z, out, u[0], u[1]).map_or(0.0, |s| s.weight.x);
                assert!(weight <= 1.0 + 1e-5, "single scattering never gains: {weight}");
                a.push([f64::from(weight)]);
                let (to, cos) = cosine_hemisphere(Vec3A::Z, u[2], u[3]);
                let value = eval(Vec3A::ONE, alpha, Vec3A::Z, out, to).0.x / (cos * FRAC_1_PI);
                b.push([f64::from(value)]);
            }
            let error = (a.mean_variance().unwrap()[0] + b.mean_variance().unwrap()[0]).sqrt();
            assert!((a.mean()[0] - b.mean()[0]).abs() < 5.0 * error, "{} {}", a.mean()[0], b.mean()[0]);
        }
    }
}
