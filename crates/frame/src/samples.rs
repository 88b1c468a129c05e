use serde::{Deserialize, Serialize};

/// Samples per pixel: one number for all pixels, or one per pixel after adaptive rounds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub enum Counts {
    /// The same number everywhere.
    Uniform(u32),
    /// Row by row, as many entries as the frame has pixels.
    PerPixel(Vec<u32>),
}

impl Counts {
    /// The count of the pixel with this row-major index. Panics out of range.
    #[must_use]
    pub fn at(&self, pixel: usize) -> u32 {
        match self {
            Self::Uniform(n) => *n,
            Self::PerPixel(counts) => counts[pixel],
        }
    }

    /// The smallest count.
    #[must_use]
    pub fn least(&self) -> u32 {
        match self {
            Self::Uniform(n) => *n,
            Self::PerPixel(counts) => counts.iter().copied().min().unwrap_or(0),
        }
    }

    /// The one count of all pixels, if they agree on one.
    #[must_use]
    pub fn uniform(&self) -> Option<u32> {
        match self {
            Self::Uniform(n) => Some(*n),
            Self::PerPixel(counts) => {
                let first = *counts.first()?;
                counts.iter().all(|&n| n == first).then_some(first)
            }
        }
    }

    /// The mean count over `pixels` pixels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        match self {
            Self::Uniform(n) => f64::from(*n),
            // `max(1)` only matters for an empty map, whose mean is then zero.
            Self::PerPixel(c) => c.iter().map(|&n| f64::from(n)).sum::<f64>() / c.len().max(1) as f64,
        }
    }
}

/// How many samples made a frame, and how many of them went into half A. Half B has the rest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Samples {
    total: Counts,
    half_a: Counts,
}

impl Samples {
    /// `n` samples in every pixel, even sample indices in half A: ⌈n/2⌉ there, ⌊n/2⌋ in half B.
    #[must_use]
    pub fn uniform(n: u32) -> Self {
        Self { total: Counts::Uniform(n), half_a: Counts::Uniform(n.div_ceil(2)) }
    }

    /// Per-pixel counts, split by parity like [`Samples::uniform`].
    #[must_use]
    pub fn per_pixel(counts: Vec<u32>) -> Self {
        let half_a = counts.iter().map(|n| n.div_ceil(2)).collect();
        Self { total: Counts::PerPixel(counts), half_a: Counts::PerPixel(half_a) }
    }

    /// Replaces the number of samples in half A (the rest is in half B).
    #[must_use]
    pub fn with_half_a(self, half_a: Counts) -> Self {
        Self { half_a, ..self }
    }

    /// All samples.
    #[must_use]
    pub fn total(&self) -> &Counts {
        &self.total
    }

    /// Samples in half A.
    #[must_use]
    pub fn half_a(&self) -> &Counts {
        &self.half_a
    }

    /// `(n_A, n_B)` of a pixel; n_B saturates at zero if a file claims more in A than in total.
    #[must_use]
    pub fn halves_at(&self, pixel: usize) -> (u32, u32) {
        let a = self.half_a.at(pixel);
        (a, self.total.at(pixel).saturating_sub(a))
    }

    /// All samples of one pixel.
    #[must_use]
    pub fn at(&self, pixel: usize) -> u32 {
        self.total.at(pixel)
    }
}
