//! Random numbers for simulations and tests: SplitMix64 (Steele, Lea, Flood 2014) and Box–Muller. The same for a seed on every
//! machine.

/// Standard normal numbers, and uniform ones.
#[derive(Debug, Clone)]
pub struct Normals(u64);

impl Normals {
    /// The sequence of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number above 0 and below 1.
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }

    /// A number of mean 0 and variance 1.
    #[expect(clippy::should_implement_trait)] // it never ends
    pub fn next(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
