//! Integer hashing in place of a random number generator: the same indices give the same values on every machine.

/// Mixes 32 bits so that each input bit changes about half of the output bits (a bijection; multiply and
/// shift-xor rounds after Wellons' search for low-bias mixers, 2018).
#[inline]
#[must_use]
pub const fn mix(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Uniform in [0, 1) from the upper 24 bits, so that every value is exact in `f32`.
#[inline]
#[must_use]
pub fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Hash of a lattice point in the plane: a linear combination and a single multiply round, because textures look it
/// up for every brick and tile they show. The upper bits are the good ones.
#[inline]
#[must_use]
pub fn lattice(x: i32, y: i32, seed: u32) -> u32 {
    let line = (x as u32).wrapping_mul(0x9e37_79b1).wrapping_add((y as u32).wrapping_mul(0x85eb_ca77));
    let h = line.wrapping_add(seed.wrapping_mul(0xc2b2_ae3d));
    let h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    (h ^ (h >> 13)).wrapping_mul(0x297a_2d39)
}

/// A numbered stream of values for placing things: `Placement::new(seed)` always yields the same sequence.
#[derive(Debug, Clone)]
pub struct Placement {
    state: u32,
    index: u32,
}

impl Placement {
    /// The stream numbered `seed`.
    #[must_use]
    pub fn new(seed: u32) -> Self {
        Self { state: mix(seed ^ 0x5bd1_e995), index: 0 }
    }

    /// Next value, uniform in [0, 1).
    pub fn unit(&mut self) -> f32 {
        self.index = self.index.wrapping_add(1);
        unit(mix(self.state ^ self.index.wrapping_mul(0x9e37_79b9)))
    }

    /// Next value, uniform in [low, high).
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placement_repeats_and_differs_between_seeds() {
        let take = |seed| (0..8).scan(Placement::new(seed), |p, _| Some(p.unit())).collect::<Vec<_>>();
        assert_eq!(take(3), take(3));
        assert_ne!(take(3), take(4));
    }

    #[test]
    fn placement_is_uniform_to_the_standard_error() {
        let mut placement = Placement::new(11);
        let n = 40_000;
        let mean = (0..n).map(|_| f64::from(placement.range(-1.0, 1.0))).sum::<f64>() / f64::from(n);
        // A uniform on [-1, 1) has standard deviation 1/√3.
        assert!(mean.abs() < 4.0 / (3.0 * f64::from(n)).sqrt(), "{mean}");
    }

    #[test]
    fn neighbouring_lattice_points_are_uncorrelated() {
        let n = 100;
        let value = |x, y| f64::from(unit(lattice(x, y, 5))) - 0.5;
        for step in [(1, 0), (0, 1), (1, 1), (-1, 1), (2, 0), (0, 3)] {
            let mut sum = 0.0;
            for y in -n..n {
                for x in -n..n {
                    sum += value(x, y) * value(x + step.0, y + step.1);
                }
            }
            // 4n² products, each with standard deviation 1/12.
            assert!(sum.abs() < 4.0 * f64::from(2 * n) / 12.0, "{step:?}: {sum}");
        }
    }
}
