use noisefloor_frame::{Image, Reference};

use crate::measurer::Measurer;
use crate::{EPSILON, MetricError};

/// What an error map shows; each is a mean over the three channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// x − r, radiance.
    Signed,
    /// |x − r|, radiance.
    Absolute,
    /// |x − r|/√(max(r,0)²+ε), ε = 0.01.
    Relative,
    /// Squared error with the reference's noise taken out, as in MSE, whose mean over the map is the MSE; may
    /// be negative.
    Squared,
    /// The same over max(r,0)²+ε, less the bias by that denominator; its mean is rMSE.
    RelativeSquared,
}

/// Error of each pixel, one channel. Not finite where the test image or the reference is not.
///
/// # Errors
/// [`MetricError::Shape`] if the shapes differ.
pub fn error_map(test: &Image, reference: &Reference, kind: ErrorKind) -> Result<Image, MetricError> {
    let measurer = Measurer::new(reference, None)?;
    let (w, h) = (measurer.truth.mean.width(), measurer.truth.mean.height());
    test.expect_shape("test image", w, h, 3)?;
    let n = w * h;
    Ok(Image::from_fn(w, h, 1, |_, x, y| {
        let sum: f64 = (0..3)
            .map(|c| {
                let i = c * n + y * w + x;
                let (value, r) = (f64::from(test.data()[i]), f64::from(measurer.truth.mean.data()[i]));
                let e = value - r;
                let scale = r.max(0.0).powi(2) + EPSILON; // positive
                match kind {
                    ErrorKind::Signed => e,
                    ErrorKind::Absolute => e.abs(),
                    ErrorKind::Relative => e.abs() / scale.sqrt(),
                    ErrorKind::Squared => measurer.truth.numerator(i, value, e),
                    ErrorKind::RelativeSquared => {
                        measurer.truth.numerator(i, value, e) / scale - measurer.bias.at(i, e)
                    }
                }
            })
            .sum();
        (sum / 3.0) as f32
    }))
}
