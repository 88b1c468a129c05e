use crate::{Estimate, Frame, FrameError, Image, Samples, Sampling, Variance};

/// A high-sample-count estimate that stands for the truth, with its own noise kept beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Mean; variance of that mean; halves: the first and the last parts. Features as far as recorded.
    pub frame: Frame,
    /// Means of the independently randomised parts, if they were kept. Equal sample counts.
    pub parts: Vec<Image>,
}

/// How the noise of a reference can be taken out of a squared error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SquaredError {
    /// The truth is exact: nothing to take out.
    Exact,
    /// Product of the residuals to two independent halves.
    Halves,
    /// Squared residual minus the variance of the reference.
    SubtractVariance,
    /// The reference carries neither: its noise passes for error, and results say so.
    Uncorrected,
}

impl Reference {
    /// Fewest parts of a reference that is rendered here.
    pub const LEAST_PARTS: usize = 8;

    /// Puts a reference together from the colour means of independently randomised parts of `spp_per_part` samples each:
    /// the halves are the means of the first and of the last parts, the variance is between-part variance over the number
    /// of parts. An odd part in the middle goes to the first half.
    ///
    /// # Errors
    /// [`FrameError::TooFewParts`] below 2 parts, [`FrameError::Mismatch`] if their shapes differ.
    pub fn from_parts(parts: Vec<Image>, spp_per_part: u32, sampling: Sampling) -> Result<Self, FrameError> {
        if parts.len() < 2 {
            return Err(FrameError::TooFewParts { got: parts.len(), least: 2 });
        }
        let first = &parts[0];
        for (k, part) in parts.iter().enumerate() {
            part.expect_shape(&format!("part{k}"), first.width(), first.height(), first.channels())?;
        }
        let count = parts.len();
        let in_a = count.div_ceil(2);
        let mut mean = first.clone();
        let (mut variance, mut a, mut b) = (mean.clone(), mean.clone(), mean.clone());
        for i in 0..first.data().len() {
            let value = |k: usize| f64::from(parts[k].data()[i]);
            let sum_a: f64 = (0..in_a).map(value).sum();
            let sum_b: f64 = (in_a..count).map(value).sum();
            let centre = (sum_a + sum_b) / count as f64;
            let m2: f64 = (0..count).map(|k| (value(k) - centre).powi(2)).sum();
            mean.data_mut()[i] = centre as f32;
            variance.data_mut()[i] = (m2 / ((count - 1) as f64 * count as f64)) as f32; // count ≥ 2
            a.data_mut()[i] = (sum_a / in_a as f64) as f32; // in_a ≥ 1
            b.data_mut()[i] = (sum_b / (count - in_a) as f64) as f32; // count − in_a ≥ 1
        }
        let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: Some([a, b]) };
        let samples = Samples::uniform(spp_per_part * count as u32)
            .with_half_a(crate::Counts::Uniform(spp_per_part * in_a as u32));
        Ok(Self { frame: Frame::from_color(color, samples, sampling), parts })
    }

    /// A reference that is the exact truth: variance zero, no parts.
    #[must_use]
    pub fn exact(truth: Image) -> Self {
        let variance = Image::new(truth.width(), truth.height(), truth.channels());
        let color = Estimate { mean: truth, variance: Some(Variance::of_mean(variance)), halves: None };
        Self {
            frame: Frame::from_color(color, Samples::uniform(u32::MAX), Sampling::Independent),
            parts: Vec::new(),
        }
    }

    /// What this reference allows.
    #[must_use]
    pub fn squared_error(&self) -> SquaredError {
        let color = &self.frame.color;
        match (&color.halves, &color.variance) {
            (Some(_), _) => SquaredError::Halves,
            (None, Some(v)) if v.mean_variance().data().iter().all(|&v| v == 0.0) => SquaredError::Exact,
            (None, Some(_)) => SquaredError::SubtractVariance,
            (None, None) => SquaredError::Uncorrected,
        }
    }

    /// The reference mean, 3 channels.
    #[must_use]
    pub fn mean(&self) -> &Image {
        &self.frame.color.mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_make_mean_halves_and_variance() {
        let parts: Vec<Image> = [1.0, 3.0, 5.0, 7.0].map(|v| Image::filled(1, 1, 3, v)).to_vec();
        let reference = Reference::from_parts(parts, 16, Sampling::LowDiscrepancy).unwrap();
        let color = &reference.frame.color;
        assert_eq!(color.mean.get(0, 0, 0), 4.0);
        let [a, b] = color.halves.as_ref().unwrap();
        assert_eq!((a.get(0, 0, 0), b.get(0, 0, 0)), (2.0, 6.0));
        // Between-part s² = 20/3; variance of the mean of four parts = 5/3.
        let variance = color.variance.as_ref().unwrap().mean_variance().get(0, 0, 0);
        assert!((variance - 5.0 / 3.0).abs() < 1e-6);
        assert_eq!(reference.frame.samples.at(0), 64);
        assert_eq!(reference.squared_error(), SquaredError::Halves);
        assert_eq!(Reference::exact(Image::new(1, 1, 3)).squared_error(), SquaredError::Exact);
    }
}
