use crate::ShapeError;
use crate::observed::expect;

/// What is known of a reference's noise; planar like the images.
#[derive(Debug, Clone, Copy)]
pub enum ReferenceNoise<'a> {
    /// There is none.
    Exact,
    /// Independent halves, whose residuals are multiplied.
    Halves {
        /// A and B.
        halves: [&'a [f32]; 2],
        /// Independent parts that A and that B are the means of, all of as many samples. With at least 2 per half the totals
        /// tell what the reference adds to their standard errors; otherwise nothing is told.
        parts: [&'a [&'a [f32]]; 2],
    },
    /// The variance v_r of its mean, which is subtracted from the squared residual.
    Variance(&'a [f32]),
    /// Nothing: no squared bias is told, since the reference's noise would pass for it.
    Unknown,
}

/// A reference with its noise.
#[derive(Debug, Clone, Copy)]
pub struct BiasReference<'a> {
    /// r per channel and pixel.
    pub mean: &'a [f32],
    /// What is known of its noise.
    pub noise: ReferenceNoise<'a>,
}

/// Residuals of the mean image in one pixel-channel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Residuals {
    /// D̄ − r.
    pub(super) mean: f64,
    /// D̄ − A and D̄ − B, or D̄ − r twice.
    pub(super) halves: [f64; 2],
    /// What is to be subtracted from their product.
    pub(super) noise: f64,
}

impl<'a> BiasReference<'a> {
    /// Whether a squared bias can be told.
    pub(super) fn squared(&self) -> bool {
        !matches!(self.noise, ReferenceNoise::Unknown)
    }

    /// Parts of A and of B; none unless both have at least 2.
    pub(super) fn parts(&self) -> [&'a [&'a [f32]]; 2] {
        match self.noise {
            ReferenceNoise::Halves { parts, .. } if parts.iter().all(|p| p.len() >= 2) => parts,
            _ => [&[], &[]],
        }
    }

    pub(super) fn check(&self, length: usize) -> Result<(), ShapeError> {
        expect("reference", self.mean.len(), length)?;
        match self.noise {
            ReferenceNoise::Halves { halves, parts } => {
                halves.iter().try_for_each(|half| expect("half of the reference", half.len(), length))?;
                let mut all = parts.iter().copied().flatten();
                all.try_for_each(|part| expect("part of the reference", part.len(), length))
            }
            ReferenceNoise::Variance(v) => expect("variance of the reference", v.len(), length),
            ReferenceNoise::Exact | ReferenceNoise::Unknown => Ok(()),
        }
    }

    pub(super) fn residuals(&self, i: usize, mean: f64) -> Residuals {
        let own = mean - f64::from(self.mean[i]);
        let (halves, noise) = match self.noise {
            ReferenceNoise::Halves { halves, .. } => (halves.map(|half| mean - f64::from(half[i])), 0.0),
            ReferenceNoise::Variance(v) => ([own; 2], f64::from(v[i]).max(0.0)),
            ReferenceNoise::Exact | ReferenceNoise::Unknown => ([own; 2], 0.0),
        };
        // `max` would make 0 of a variance that is no number.
        let unknown = matches!(self.noise, ReferenceNoise::Variance(v) if v[i].is_nan());
        Residuals { mean: own, halves, noise: if unknown { f64::NAN } else { noise } }
    }
}
