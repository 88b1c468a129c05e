//! Made-up values.

/// Repeatable random numbers (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1), 24 bits.
    pub fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Mean 0, variance 1, near enough to normal.
    pub fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.uniform()).sum::<f32>() - 6.0
    }

    pub fn plane(&mut self, pixels: usize, mut value: impl FnMut(&mut Self) -> f32) -> Vec<f32> {
        (0..pixels).map(|_| value(self)).collect()
    }

    pub fn planes(&mut self, pixels: usize, mut value: impl FnMut(&mut Self) -> f32) -> [Vec<f32>; 3] {
        [(); 3].map(|()| self.plane(pixels, &mut value))
    }
}
