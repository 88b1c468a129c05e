use crate::noise::{noise, surfaces};
use noisefloor_frame::{Estimate, Flash, Frame, Image, Samples, Sampling, Variance};

/// A frame for whole methods as from a renderer at 64 independent samples: flat surfaces of 40×40 pixels with noise, and a
/// flash image in two parts with a tenth of it.
#[must_use]
pub fn flash_frame(width: usize, height: usize) -> Frame {
    let mut noise = noise();
    let mut estimate = |scale: f32, error: f32| Estimate {
        mean: Image::from_fn(width, height, 3, |c, x, y| scale * surfaces(c, x, y) + noise(error)),
        variance: Some(Variance::of_mean(Image::filled(width, height, 3, error * error))),
        halves: None,
    };
    let color = estimate(1.0, 0.05);
    let (base, light) = (estimate(0.5, 0.004), estimate(0.5, 0.003));
    let mut frame = Frame::from_color(color, Samples::uniform(64), Sampling::Independent);
    let covariance = Some(Image::filled(width, height, 3, 0.0));
    frame.flash = Some(Flash::Parts { base, light, covariance });
    frame
}
