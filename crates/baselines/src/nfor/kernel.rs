//! NLM and REG of the method on images.

use noisefloor_denoiser::DenoiseError;
use noisefloor_frame::Image;
use noisefloor_kernels::KernelError;
use noisefloor_kernels::regression::dense::{
    Alone, Channel, Fit, Planes, Weighting, means, regress as fit,
};

use super::card::ID;
use super::settings::Settings;

/// Largest magnitude of a colour or feature; ours: a tenth of what the kernels take, as means are rounded.
pub(super) const MOST: f32 = 1e14;
/// Largest variance or squared error.
pub(super) const MOST_SQUARE: f32 = 1e30;
/// ε of the program.
pub(super) const EPSILON: f32 = 1e-7;

/// Sizes and damping of one filter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sizes {
    /// F.
    pub patch: usize,
    /// R.
    pub window: usize,
    pub k: f64,
    /// s: 2 where the guide is one half and the variance that of the mean of both.
    pub scale: f64,
    /// ε in squared units of the guide.
    pub epsilon: f32,
}

impl Sizes {
    fn weighting(&self, image: &Image) -> Weighting {
        Weighting {
            width: image.width(),
            height: image.height(),
            window: self.window,
            patch: self.patch,
            k: self.k as f32,
            scale: self.scale as f32,
            epsilon: self.epsilon,
        }
    }
}

/// What weights come from: an image and the variance of its values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Guided<'a> {
    pub image: &'a Image,
    pub variance: &'a Image,
}

impl<'a> Guided<'a> {
    fn channels(&self) -> Vec<Channel<'a>> {
        let planes = self.image.planes().zip(self.variance.planes());
        planes.map(|(value, variance)| Channel { value, variance }).collect()
    }
}

/// NLM: filters images, each channel with its own weights, all with those of one guide.
pub(super) fn filter<const N: usize>(
    images: [&Image; N],
    guide: Guided<'_>,
    sizes: &Sizes,
) -> Result<[Image; N], DenoiseError> {
    let alone: Vec<Alone<'_>> = guide
        .channels()
        .into_iter()
        .enumerate()
        .map(|(c, guide)| Alone { guide, targets: images.iter().map(|image| image.plane(c)).collect() })
        .collect();
    let filtered = means(&sizes.weighting(guide.image), &alone).map_err(|e| refused(&e))?;
    let mut next = 0;
    Ok(images.map(|image| {
        let out = planes(image, filtered.iter().map(|targets| targets[next].as_slice()));
        next += 1;
        out
    }))
}

/// REG: the mean of what all windows' models predict of a colour.
pub(super) fn regress(
    image: &Image,
    guide: Guided<'_>,
    features: &[Image],
    sizes: &Sizes,
    settings: &Settings,
) -> Result<Image, DenoiseError> {
    let call = Fit {
        weighting: sizes.weighting(image),
        join: settings.join(),
        solver: settings.kernel_solver(),
        positions: settings.positions,
    };
    let inputs = Planes {
        guide: guide.channels(),
        features: features.iter().flat_map(Image::planes).collect(),
        image: [0, 1, 2].map(|c| image.plane(c)),
    };
    let out = fit(&call, &inputs).map_err(|e| refused(&e))?;
    // An extrapolation of values near the end of the range may be beyond it.
    Ok(within(&planes(image, out.iter().map(Vec::as_slice)), MOST))
}

/// Keeps values within a range; a NaN stays.
pub(super) fn within(image: &Image, most: f32) -> Image {
    image.map(|v| v.clamp(-most, most))
}

/// An image of the shape of another from its planes.
fn planes<'a>(like: &Image, planes: impl Iterator<Item = &'a [f32]>) -> Image {
    let mut out = Image::new(like.width(), like.height(), like.channels());
    for (to, from) in out.planes_mut().zip(planes) {
        to.copy_from_slice(from);
    }
    out
}

/// The kernels refuse what nobody mended.
fn refused(error: &KernelError) -> DenoiseError {
    DenoiseError::of_kernel(ID, error)
}
