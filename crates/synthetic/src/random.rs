//! Counter-based random numbers: a pure function of seed, purpose, pixel and position in the pixel's stream.

use std::f64::consts::TAU;

/// Increment of the SplitMix64 sequence (Steele, Lea, Flood 2014): the odd integer next to 2⁶⁴/golden ratio.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

/// Output function of SplitMix64.
#[inline]
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The random numbers of one pixel for one purpose.
#[derive(Debug, Clone)]
pub(crate) struct Stream {
    state: u64,
    spare: Option<f64>,
}

impl Stream {
    /// Streams differ if any argument does.
    pub(crate) fn new(seed: u64, purpose: u64, pixel: usize) -> Self {
        let key = mix(seed.wrapping_add(STEP)) ^ mix(purpose.wrapping_mul(STEP).wrapping_add(1));
        Self { state: mix(mix(key).wrapping_add((pixel as u64).wrapping_mul(STEP))), spare: None }
    }

    #[inline]
    fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mix(self.state)
    }

    /// Uniform in the open interval (0, 1): 52 random bits and a half, so that neither end is possible.
    #[inline]
    pub(crate) fn uniform(&mut self) -> f64 {
        ((self.bits() >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
    }

    /// Standard normal (Box, Muller 1958).
    #[inline]
    pub(crate) fn normal(&mut self) -> f64 {
        if let Some(z) = self.spare.take() {
            return z;
        }
        let radius = (-2.0 * self.uniform().ln()).sqrt(); // u in (0, 1): the logarithm is negative
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        self.spare = Some(radius * sin);
        radius * cos
    }

    /// Chi-square with `degrees` degrees of freedom; zero if that is zero.
    pub(crate) fn chi_square(&mut self, degrees: u32) -> f64 {
        match degrees {
            0 => 0.0,
            1 => self.normal().powi(2),
            _ => 2.0 * self.gamma(0.5 * f64::from(degrees)),
        }
    }

    /// Gamma of shape ≥ 1 and scale 1, by exact rejection (Marsaglia, Tsang 2000).
    fn gamma(&mut self, shape: f64) -> f64 {
        let d = shape - 1.0 / 3.0; // at least 2/3
        let c = 1.0 / (9.0 * d).sqrt();
        loop {
            let z = self.normal();
            let v = (1.0 + c * z).powi(3);
            if v > 0.0 && self.uniform().ln() < 0.5 * z * z + d - d * v + d * v.ln() {
                return d * v;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Stream;

    /// Mean and variance of `n` draws lie within 5 standard errors; `kurtosis` is the fourth central moment
    /// over variance².
    fn check(name: &str, n: usize, mean: f64, variance: f64, kurtosis: f64, mut draw: impl FnMut() -> f64) {
        let draws: Vec<f64> = (0..n).map(|_| draw()).collect();
        let m = draws.iter().sum::<f64>() / n as f64;
        let v = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n as f64;
        let se_mean = (variance / n as f64).sqrt();
        let se_variance = variance * ((kurtosis - 1.0) / n as f64).sqrt();
        assert!((m - mean).abs() < 5.0 * se_mean, "{name}: mean {m}, expected {mean} ± {se_mean}");
        assert!((v - variance).abs() < 5.0 * se_variance, "{name}: variance {v}, expected {variance}");
    }

    #[test]
    fn draws_have_the_moments_of_their_laws() {
        let mut s = Stream::new(1, 0, 0);
        check("uniform", 100_000, 0.5, 1.0 / 12.0, 1.8, || s.uniform());
        check("normal", 100_000, 0.0, 1.0, 3.0, || s.normal());
        for k in [1u32, 2, 3, 14, 1022] {
            let degrees = f64::from(k);
            let kurtosis = 3.0 + 12.0 / degrees;
            check("chi-square", 50_000, degrees, 2.0 * degrees, kurtosis, || s.chi_square(k));
        }
    }

    #[test]
    fn streams_differ_by_seed_purpose_and_pixel() {
        let first = |seed, purpose, pixel| Stream::new(seed, purpose, pixel).bits();
        let all = [first(0, 0, 0), first(1, 0, 0), first(0, 1, 0), first(0, 0, 1), first(1, 1, 1)];
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b));
        }
        assert_eq!(first(7, 8, 9), first(7, 8, 9));
    }

    #[test]
    fn neighbouring_streams_are_uncorrelated() {
        let n = 20_000;
        let dot: f64 =
            (0..n).map(|p| Stream::new(3, 0, p).normal() * Stream::new(3, 0, p + 1).normal()).sum();
        // The sum of n products of independent standard normals has variance n.
        assert!(dot.abs() < 5.0 * (n as f64).sqrt(), "{dot}");
    }
}
