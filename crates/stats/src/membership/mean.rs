/// A mean of samples, and what is known of its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleMean {
    /// x̄.
    pub mean: f64,
    /// Variance of the mean, s²/n; negative ones count as 0.
    pub variance: f64,
    /// Samples.
    pub n: u32,
}

impl SampleMean {
    pub(crate) fn standard_error(&self) -> f64 {
        self.variance.max(0.0).sqrt()
    }
}
