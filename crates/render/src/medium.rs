//! Homogeneous participating medium: free flights, transmittance, and the phase function of Henyey and Greenstein.

use std::f32::consts::FRAC_1_PI;

use glam::Vec3A;

use crate::math::{tangents, turn};

/// A medium ready for sampling.
#[derive(Debug, Clone, Copy)]
pub struct Medium {
    extinction: Vec3A,
    scattering: Vec3A,
    mean_cosine: f32,
}

/// How far light gets.
#[derive(Debug, Clone, Copy)]
pub enum Flight {
    /// To the surface ahead, with this factor on radiance.
    Passed(Vec3A),
    /// Scattered at a distance, with this factor on radiance.
    Scattered(f32, Vec3A),
}

impl Medium {
    /// From a checked description.
    pub fn new(medium: &noisefloor_scenes::Medium) -> Self {
        Self {
            extinction: medium.extinction().into(),
            scattering: medium.scattering.into(),
            mean_cosine: medium.mean_cosine,
        }
    }

    /// Share of light that gets through a distance, which is finite.
    #[inline]
    pub fn transmittance(&self, distance: f32) -> Vec3A {
        let thickness = self.extinction * distance;
        Vec3A::new((-thickness.x).exp(), (-thickness.y).exp(), (-thickness.z).exp())
    }

    /// Samples a flight towards a surface at `limit`, finite. The colour whose extinction sets the density is chosen in
    /// proportion to `throughput`, which is not all zero, and the factor divides by the mean density under that choice:
    /// the sum of the throughput over the colours never grows, however long the path and however the coefficients
    /// differ. A medium that does not scatter only dims, without a random choice.
    #[inline]
    pub fn fly(&self, limit: f32, throughput: Vec3A, u: f32) -> Flight {
        if self.scattering == Vec3A::ZERO {
            return Flight::Passed(self.transmittance(limit));
        }
        let shares = throughput * (1.0 / throughput.element_sum());
        let (channel, from) = if u < shares.x {
            (0, 0.0)
        } else if u < shares.x + shares.y || shares.z <= 0.0 {
            (1, shares.x)
        } else {
            (2, shares.x + shares.y)
        };
        // A colour is only chosen if its share is positive, up to rounding at the borders.
        let rest = ((u - from) / shares[channel].max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON);
        let rate = self.extinction[channel];
        // 1 − rest is at least f32::EPSILON, so the logarithm is finite.
        let t = if rate > 0.0 { -(1.0 - rest).ln() / rate } else { f32::MAX };
        // Both means are positive: the chosen colour's transmittance is at least f32::EPSILON at t, or at limit if t
        // passes it.
        if t < limit {
            let through = self.transmittance(t);
            let density = (shares * self.extinction).dot(through).max(f32::MIN_POSITIVE);
            return Flight::Scattered(t, self.scattering * through / density);
        }
        let through = self.transmittance(limit);
        let chance = shares.dot(through).max(f32::MIN_POSITIVE);
        Flight::Passed(through / chance)
    }

    /// Phase function for light that travels along `forward` and goes on along `to`, per solid angle; also the density of
    /// [`Medium::scatter`].
    #[inline]
    pub fn phase(&self, forward: Vec3A, to: Vec3A) -> f32 {
        let g = self.mean_cosine;
        // Positive because |g| ≤ 0.95 and the cosine is at most 1 up to rounding.
        let base = 1.0 + g * g - 2.0 * g * forward.dot(to);
        0.25 * FRAC_1_PI * (1.0 - g * g) / (base * base.sqrt())
    }

    /// A direction with the phase function as density.
    #[inline]
    pub fn scatter(&self, forward: Vec3A, u: f32, v: f32) -> Vec3A {
        let g = self.mean_cosine;
        let cos = if g.abs() < 1e-3 {
            1.0 - 2.0 * u
        } else {
            let ratio = (1.0 - g * g) / (1.0 + g - 2.0 * g * u); // the denominator is at least 1 − |g|
            (1.0 + g * g - ratio * ratio) / (2.0 * g)
        };
        let cos = cos.clamp(-1.0, 1.0);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (s, c) = turn(v);
        let (t, b) = tangents(forward);
        (t * (sin * c) + b * (sin * s) + forward * cos).normalize()
    }
}

/// Density of directions that are as likely as any.
#[cfg(test)]
const EVEN: f32 = 0.25 * FRAC_1_PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Independent, Sampler};
    use glam::Vec3;
    use noisefloor_frame::Moments;

    fn medium(absorption: Vec3, scattering: Vec3, mean_cosine: f32) -> Medium {
        Medium::new(&noisefloor_scenes::Medium { absorption, scattering, mean_cosine })
    }

    #[test]
    fn flights_have_the_transmittance_and_the_scattered_light_of_the_closed_form() {
        let (absorption, scattering) = (Vec3::new(0.1, 0.0, 1.5), Vec3::new(0.4, 0.9, 0.0));
        let medium = medium(absorption, scattering, 0.0);
        let limit = 1.7f32;
        let throughput = Vec3A::new(0.5, 0.2, 0.9);
        let (mut passed, mut scattered) = (Moments::<3>::default(), Moments::<3>::default());
        for k in 0..200_000 {
            let (a, b) = match medium.fly(limit, throughput, Independent::new(5, k).group(0)[0]) {
                Flight::Passed(weight) => (weight, Vec3A::ZERO),
                Flight::Scattered(t, weight) => {
                    assert!(t < limit);
                    (Vec3A::ZERO, weight)
                }
            };
            // The promise that keeps long paths tame.
            let sum = throughput.element_sum() * 1.001;
            assert!(a.dot(throughput) <= sum && b.dot(throughput) <= sum);
            passed.push(a.to_array().map(f64::from));
            scattered.push(b.to_array().map(f64::from));
        }
        for c in 0..3 {
            let (a, s) = (f64::from(absorption[c]), f64::from(scattering[c]));
            let through = (-(a + s) * f64::from(limit)).exp();
            for (moments, truth) in [(&passed, through), (&scattered, s / (a + s) * (1.0 - through))] {
                let error = moments.mean_variance().unwrap()[c].sqrt();
                let mean = moments.mean()[c];
                assert!((mean - truth).abs() <= 4.5 * error + 1e-6, "channel {c}: {mean} ± {error}, {truth}");
            }
        }
    }

    #[test]
    fn a_medium_that_only_absorbs_takes_no_chances() {
        let medium = medium(Vec3::splat(0.5), Vec3::ZERO, 0.0);
        for u in [0.0, 0.4, 0.999_999] {
            let Flight::Passed(weight) = medium.fly(2.0, Vec3A::ONE, u) else { panic!("nothing scatters") };
            assert!((weight.x - (-1.0f32).exp()).abs() < 1e-6);
        }
    }

    #[test]
    fn directions_follow_the_phase_function() {
        let forward = Vec3A::new(0.6, 0.0, 0.8);
        for g in [-0.9, -0.3, 0.0, 5e-4, 0.5, 0.95] {
            let medium = medium(Vec3::ZERO, Vec3::ONE, g);
            let (mut cosine, mut total) = (Moments::<1>::default(), Moments::<1>::default());
            for k in 0..60_000 {
                let u = Independent::new(9, k).group(0);
                let to = medium.scatter(forward, u[0], u[1]);
                cosine.push([f64::from(to.dot(forward))]);
                // The same integral with even directions: the function is normalised.
                let even = crate::math::turn(u[3]);
                let (z, r) = (1.0 - 2.0 * u[2], (4.0 * u[2] * (1.0 - u[2])).max(0.0).sqrt());
                let w = Vec3A::new(r * even.0, r * even.1, z);
                total.push([f64::from(medium.phase(forward, w) / EVEN)]);
            }
            for (moments, truth) in [(&cosine, f64::from(g)), (&total, 1.0)] {
                let error = moments.mean_variance().unwrap()[0].sqrt();
                let mean = moments.mean()[0];
                assert!(
                    (mean - truth).abs() <= 4.5 * error + 1e-6,
                    "g = {g}: {mean} ± {error}, expected {truth}"
                );
            }
        }
    }
}
