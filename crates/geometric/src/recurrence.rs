//! The variance of the slides, as defined and as accumulated, beside Welford's.
//!
//! Two slides, whose lines are counted from the function's name on: "Mean" (lines 1-4) and "Variance" (lines 1-5), and
//! "Incremental mean" (lines 1-2) and "Incremental variance" (lines 1-5, two of them for the name and its arguments).
//!
//! For N samples with variance σ², H_N = 1 + 1/2 + … + 1/N:
//!
//! | recurrence | expected value |
//! |---|---|
//! | as written, V ← n·V + d²/(n+1) | grows like N! |
//! | corrected, d from the updated mean | σ²(N − H_N)/N: too low |
//! | corrected, d from the previous mean | σ²(N − 1 + H_{N−1})/N: too high |
//! | corrected, product of both d (Welford) | σ²(N − 1)/N: the population variance |

use noisefloor_denoiser::choices;

choices! {
    /// Which variance a running estimate of the slides' kind converges to on average.
    pub enum Recurrence {
        /// s² with divisor N−1: Welford.
        Unbiased = "unbiased",
        /// Divisor N: the slides' two-pass definition, and the corrected recurrence with the product of both distances.
        Population = "population",
        /// Corrected recurrence, squared distance from the mean that contains the sample.
        UpdatedMean = "updated-mean",
        /// Corrected recurrence, squared distance from the mean before the sample.
        PreviousMean = "previous-mean",
    }
}

impl Recurrence {
    /// Expected value after `n` samples, as a multiple of the true variance σ²; 0 for n = 0, and 0 for n = 1 except
    /// under `Unbiased`, whose factor is 1 wherever it is defined.
    #[must_use]
    pub fn expected_factor(self, n: u32) -> f64 {
        if n == 0 {
            return 0.0;
        }
        let count = f64::from(n); // ≥ 1, so it may divide
        match self {
            Self::Unbiased => 1.0,
            Self::Population => (count - 1.0) / count,
            Self::UpdatedMean => (count - harmonic(n)) / count,
            Self::PreviousMean => (count - 1.0 + harmonic(n - 1)) / count,
        }
    }
}

/// H_n, summed exactly where short and by its asymptotic series (error below 1e-12) beyond; ours.
fn harmonic(n: u32) -> f64 {
    const EULER: f64 = 0.577_215_664_901_532_9;
    if n <= 512 {
        return (1..=n).rev().map(|k| 1.0 / f64::from(k)).sum();
    }
    let n = f64::from(n);
    n.ln() + EULER + 0.5 / n - 1.0 / (12.0 * n * n)
}

/// The running mean and the recurrences of the slides over vector samples, in `f64`. The distance is the length of
/// the vector sample − mean, so each variance is the trace of a covariance.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Incremental {
    count: u32,
    mean: [f64; 3],
    as_written: f64,
    updated_mean: f64,
    previous_mean: f64,
    product: f64,
}

impl Incremental {
    /// Adds one sample to the mean and to every recurrence.
    pub fn push(&mut self, sample: [f64; 3]) {
        let n = f64::from(self.count); // before this sample
        let next = n + 1.0; // ≥ 1, so it may divide
        let before = self.mean;
        for (mean, x) in self.mean.iter_mut().zip(sample) {
            *mean = (*mean * n + x) / next; // Incremental mean, line 2
        }
        // Incremental variance, line 3: whether the mean holds the new sample is not said.
        let delta = |mean: [f64; 3]| [0, 1, 2].map(|c| sample[c] - mean[c]);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (new, old) = (delta(self.mean), delta(before));
        // The first sample has no mean before it and adds nothing.
        let old = if self.count == 0 { [0.0; 3] } else { old };
        // Incremental variance, lines 4-5: the division by n + 1 as printed, of the square alone, and then of all.
        self.as_written = n * self.as_written + dot(new, new) / next;
        self.updated_mean = (n * self.updated_mean + dot(new, new)) / next;
        self.previous_mean = (n * self.previous_mean + dot(old, old)) / next;
        self.product = (n * self.product + dot(old, new)) / next;
        self.count += 1;
    }

    /// Samples seen.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Running mean.
    #[must_use]
    pub fn mean(&self) -> [f64; 3] {
        self.mean
    }

    /// V ← n·V + d²/(n+1), the parentheses as printed, d from the updated mean. Overflows to infinity in time.
    #[must_use]
    pub fn as_written(&self) -> f64 {
        self.as_written
    }

    /// V ← (n·V + d²)/(n+1) for the corrected recurrences; `Unbiased` rescales the product form by N/(N−1) and is
    /// `None` below 2 samples.
    #[must_use]
    pub fn corrected(&self, recurrence: Recurrence) -> Option<f64> {
        match recurrence {
            Recurrence::UpdatedMean => Some(self.updated_mean),
            Recurrence::PreviousMean => Some(self.previous_mean),
            Recurrence::Population => Some(self.product),
            Recurrence::Unbiased => {
                let n = f64::from(self.count);
                (self.count >= 2).then(|| self.product * n / (n - 1.0))
            }
        }
    }
}

/// The slides' two-pass definition: the mean squared distance from the mean, divisor N; 0 without samples. The quotient 1/N,
/// which many languages would take for one of integers as it is printed, is read as one of reals.
#[must_use]
pub fn two_pass(samples: &[[f64; 3]]) -> f64 {
    let n = samples.len().max(1) as f64; // an empty sum is 0 whatever it is divided by
    // Mean, lines 2-4.
    let mean = [0, 1, 2].map(|c| samples.iter().map(|s| s[c]).sum::<f64>() / n);
    // Variance, lines 2-5: a length squared, so one number, though it is declared a vector.
    samples.iter().map(|s| (0..3).map(|c| (s[c] - mean[c]).powi(2)).sum::<f64>()).sum::<f64>() / n
}
