use crate::{FrameError, Image, Samples};

/// Variance **of the mean**, per pixel and channel, in squared units of the mean.
///
/// There is no way to make one without saying what the numbers are: [`Variance::of_mean`],
/// [`Variance::from_sample_variance`] (divides by n) or [`Variance::from_halves`].
#[derive(Debug, Clone, PartialEq)]
pub struct Variance(Image);

impl Variance {
    /// The values are already variances of the mean, s²/n.
    #[must_use]
    pub fn of_mean(image: Image) -> Self {
        Self(image)
    }

    /// The values are unbiased variances s² of one sample: divides by the pixel's sample count.
    ///
    /// # Errors
    /// [`FrameError::TooFewSamples`] if some pixel has fewer than 2 samples (s² is undefined there).
    pub fn from_sample_variance(image: &Image, samples: &Samples) -> Result<Self, FrameError> {
        let least = samples.total().least();
        if least < 2 {
            return Err(FrameError::TooFewSamples { what: "sample variance".into(), got: least, least: 2 });
        }
        let mut out = image.clone();
        for plane in out.planes_mut() {
            for (pixel, value) in plane.iter_mut().enumerate() {
                *value = (f64::from(*value) / f64::from(samples.at(pixel))) as f32;
            }
        }
        Ok(Self(out))
    }

    /// Two-buffer estimate (A−B)²·n_A·n_B/n², which is (A−B)²/4 for equal halves. Unbiased if the halves
    /// are independent, whatever the sampler does inside each.
    ///
    /// # Errors
    /// [`FrameError::Mismatch`] if the halves differ in shape, [`FrameError::TooFewSamples`] if a half is empty.
    pub fn from_halves(halves: &[Image; 2], samples: &Samples) -> Result<Self, FrameError> {
        let [a, b] = halves;
        b.expect_shape("half B", a.width(), a.height(), a.channels())?;
        let mut out = a.clone();
        for (plane_out, plane_b) in out.planes_mut().zip(b.planes()) {
            for (pixel, (value, &b)) in plane_out.iter_mut().zip(plane_b).enumerate() {
                let (na, nb) = samples.halves_at(pixel);
                if na == 0 || nb == 0 {
                    let got = na.min(nb);
                    return Err(FrameError::TooFewSamples { what: "half buffer".into(), got, least: 1 });
                }
                let (na, nb) = (f64::from(na), f64::from(nb));
                let difference = f64::from(*value) - f64::from(b);
                *value = (difference * difference * (na * nb) / ((na + nb) * (na + nb))) as f32;
            }
        }
        Ok(Self(out))
    }

    /// Variance of the mean.
    #[must_use]
    pub fn mean_variance(&self) -> &Image {
        &self.0
    }

    /// Variance of the mean, by value.
    #[must_use]
    pub fn into_mean_variance(self) -> Image {
        self.0
    }

    /// Variance s² of one sample: multiplies by the pixel's sample count.
    #[must_use]
    pub fn sample_variance(&self, samples: &Samples) -> Image {
        let mut out = self.0.clone();
        for plane in out.planes_mut() {
            for (pixel, value) in plane.iter_mut().enumerate() {
                *value = (f64::from(*value) * f64::from(samples.at(pixel))) as f32;
            }
        }
        out
    }
}

/// A mean with what is known about its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Sample mean.
    pub mean: Image,
    /// Variance of the mean; absent if one sample was taken or a file carries none.
    pub variance: Option<Variance>,
    /// Half buffers A and B: means of two independent halves of the samples.
    pub halves: Option<[Image; 2]>,
}

impl Estimate {
    /// A mean of which nothing else is known.
    #[must_use]
    pub fn from_mean(mean: Image) -> Self {
        Self { mean, variance: None, halves: None }
    }

    /// Checks that variance and halves have the shape of the mean, naming the buffer `name`.
    ///
    /// # Errors
    /// [`FrameError::Mismatch`].
    pub fn check(&self, name: &str) -> Result<(), FrameError> {
        let (w, h, c) = (self.mean.width(), self.mean.height(), self.mean.channels());
        if let Some(variance) = &self.variance {
            variance.mean_variance().expect_shape(&format!("{name}.variance"), w, h, c)?;
        }
        if let Some([a, b]) = &self.halves {
            a.expect_shape(&format!("{name}.halfA"), w, h, c)?;
            b.expect_shape(&format!("{name}.halfB"), w, h, c)?;
        }
        Ok(())
    }

    /// The rectangle that starts at `(x, y)`, of everything. Panics like [`Image::crop`].
    #[must_use]
    pub fn crop(&self, x: usize, y: usize, width: usize, height: usize) -> Self {
        let cut = |image: &Image| image.crop(x, y, width, height);
        Self {
            mean: cut(&self.mean),
            variance: self.variance.as_ref().map(|v| Variance(cut(&v.0))),
            halves: self.halves.as_ref().map(|[a, b]| [cut(a), cut(b)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Counts;

    #[test]
    fn the_three_constructors_keep_their_factors() {
        let s2 = Image::filled(2, 1, 1, 8.0);
        let four = Samples::uniform(4);
        let from_samples = Variance::from_sample_variance(&s2, &four).unwrap();
        assert_eq!(from_samples.mean_variance().data(), [2.0, 2.0]);
        assert_eq!(from_samples.sample_variance(&four).data(), [8.0, 8.0]);
        let halves = [Image::filled(2, 1, 1, 3.0), Image::filled(2, 1, 1, 1.0)];
        let two_buffer = Variance::from_halves(&halves, &four).unwrap();
        assert_eq!(two_buffer.mean_variance().data(), [1.0, 1.0], "(A−B)²/4 for equal halves");
        let uneven = four.with_half_a(Counts::Uniform(1));
        let two_buffer = Variance::from_halves(&halves, &uneven).unwrap();
        assert_eq!(two_buffer.mean_variance().data(), [0.75, 0.75], "(A−B)²·n_A·n_B/n²");
    }

    #[test]
    fn one_sample_has_no_sample_variance() {
        let image = Image::new(1, 1, 1);
        assert!(Variance::from_sample_variance(&image, &Samples::uniform(1)).is_err());
        let halves = [image.clone(), image];
        assert!(Variance::from_halves(&halves, &Samples::uniform(1)).is_err());
    }
}
