//! Stein's unbiased risk estimate of a filter's squared error (Sec. 6, Eq. 5).

use noisefloor_frame::Image;

/// The terms of Eq. 5, (F − u)² − σ² + 2·σ²·dF/du, per pixel and channel, with the estimated variance for σ². Negative values
/// are right on average and kept.
pub(crate) fn sure(filtered: &Image, noisy: &Image, variance: &Image, derivative: &Image) -> Image {
    let mut out = filtered.clone();
    let inputs = noisy.data().iter().zip(variance.data()).zip(derivative.data());
    for (value, ((u, variance), derivative)) in out.data_mut().iter_mut().zip(inputs) {
        let d = f64::from(*value) - f64::from(*u);
        let variance = f64::from(*variance);
        *value = (d * d - variance + 2.0 * variance * f64::from(*derivative)) as f32;
    }
    out
}

/// Sum over the channels, that of Eq. 5: one plane.
pub(crate) fn sum_of_channels(image: &Image) -> Image {
    channelwise(image, |sum, _| sum)
}

/// Mean over the channels: one plane.
pub(crate) fn mean_of_channels(image: &Image) -> Image {
    // A frame has at least one channel.
    channelwise(image, |sum, channels| sum / channels as f64)
}

fn channelwise(image: &Image, finish: impl Fn(f64, usize) -> f64) -> Image {
    let channels = image.channels();
    let sum = |p: usize| image.planes().map(|plane| f64::from(plane[p])).sum::<f64>();
    let values = (0..image.pixels()).map(|p| finish(sum(p), channels) as f32).collect();
    Image::from_vec(image.width(), image.height(), 1, values).expect("one value per pixel")
}
