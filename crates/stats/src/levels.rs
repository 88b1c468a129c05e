use crate::ReferenceShare;

/// Errors of one method on one scene by sample count and replicate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Levels {
    spp: Vec<f64>,
    values: Vec<Vec<Option<f64>>>,
    reference: Vec<ReferenceShare>,
}

impl Levels {
    /// No level yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a level: samples per pixel, the error of each replicate (the same replicate at the same index in
    /// all levels, `None` or a value that is not finite where it is missing) and what the reference contributes to
    /// their mean. A level without any value, or whose `spp` is not positive, is ignored.
    pub fn push(&mut self, spp: f64, values: &[Option<f64>], reference: impl Into<ReferenceShare>) {
        let values: Vec<Option<f64>> = values.iter().map(|v| v.filter(|v| v.is_finite())).collect();
        if spp > 0.0 && spp.is_finite() && values.iter().any(Option::is_some) {
            let at = self.spp.partition_point(|&s| s < spp);
            self.spp.insert(at, spp);
            self.values.insert(at, values);
            self.reference.insert(at, reference.into());
        }
    }

    /// Number of levels.
    #[must_use]
    pub fn len(&self) -> usize {
        self.spp.len()
    }

    /// Whether there is no level.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spp.is_empty()
    }

    /// Sample counts, ascending.
    #[must_use]
    pub fn spp(&self) -> &[f64] {
        &self.spp
    }

    /// Values that exist at a level.
    pub(crate) fn present(&self, level: usize) -> Vec<f64> {
        self.values[level].iter().copied().flatten().collect()
    }

    pub(crate) fn reference_se(&self, level: usize) -> f64 {
        self.reference[level].standard_error
    }

    /// What the reference contributes to Σ weight·mean over the levels.
    pub(crate) fn combined(&self, weights: &[f64]) -> ReferenceShare {
        let terms: Vec<_> = weights.iter().copied().zip(&self.reference).filter(|(w, _)| *w != 0.0).collect();
        ReferenceShare::combined(&terms)
    }

    /// Whether the influences of the reference's parts are known wherever it contributes anything.
    pub(crate) fn has_parts(&self) -> bool {
        self.reference.iter().any(ReferenceShare::has_parts)
            && self.reference.iter().all(|share| share.has_parts() || share.standard_error == 0.0)
    }

    /// The value of a replicate at a level.
    pub(crate) fn at(&self, level: usize, replicate: usize) -> Option<f64> {
        self.values[level].get(replicate).copied().flatten()
    }

    /// Replicates that have a value at every level.
    pub(crate) fn complete_replicates(&self) -> Vec<usize> {
        let most = self.values.iter().map(Vec::len).max().unwrap_or(0);
        (0..most).filter(|&r| (0..self.len()).all(|level| self.at(level, r).is_some())).collect()
    }

    /// Squares of the values, for roots of squared errors.
    pub(crate) fn squared(&self) -> Self {
        let square = |v: &Option<f64>| v.map(|v| v * v);
        let mut out = self.clone();
        for (level, values) in out.values.iter_mut().enumerate() {
            let present = self.present(level);
            let mean = present.iter().sum::<f64>() / present.len() as f64; // never empty
            out.reference[level] = self.reference[level].scaled(2.0 * mean);
            *values = self.values[level].iter().map(square).collect();
        }
        out
    }

    /// Spread of the values over replicates relative to the level's `size`, pooled over levels: variance and
    /// its degrees of freedom. `None` if no level has two replicates.
    pub(crate) fn pooled_relative_variance(&self, size: impl Fn(usize) -> f64) -> Option<(f64, u64)> {
        let (mut sum, mut degrees) = (0.0, 0);
        for level in 0..self.len() {
            let values = self.present(level);
            let (mean, variance) = crate::interval::mean_and_variance(&values)?;
            let size = size(level);
            if values.len() < 2 || size <= 0.0 || !mean.is_finite() {
                continue;
            }
            sum += variance * (values.len() - 1) as f64 / (size * size);
            degrees += values.len() as u64 - 1;
        }
        (degrees > 0).then(|| (sum / degrees as f64, degrees))
    }
}
