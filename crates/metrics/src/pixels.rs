use noisefloor_frame::Image;

use crate::measurer::Measurer;
use crate::ssim::ssim_map;
use crate::tone::tone;

/// Weights of Rec. 709 luma.
pub(crate) const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Everything that metrics average, per pixel; means over the three channels.
pub(crate) struct PixelErrors {
    /// Pixels that take part: finite in the test image and in the reference.
    pub(crate) valid: Vec<bool>,
    /// Squared error, corrected for the reference's noise.
    pub(crate) squared: Vec<f64>,
    /// The same over max(r,0)²+ε, less the bias by that denominator.
    pub(crate) relative: Vec<f64>,
    /// That bias.
    pub(crate) bias: Vec<f64>,
    /// Uncorrected squared error over max(r,0)²+ε.
    pub(crate) relative_plain: Vec<f64>,
    /// Squared error after tone mapping.
    pub(crate) toned: Vec<f64>,
    /// The image itself.
    pub(crate) value: Vec<f64>,
    /// The reference.
    pub(crate) truth: Vec<f64>,
    /// Structural similarity.
    pub(crate) ssim: Vec<f64>,
    /// Values of the test image that are NaN or infinite.
    pub(crate) non_finite_values: usize,
    /// Whether `relative` and `relative_plain` differ at all.
    pub(crate) corrected: bool,
}

impl PixelErrors {
    pub(crate) fn new(measurer: &Measurer<'_>, test: &Image) -> Self {
        let n = test.pixels();
        let mut valid = measurer.valid.clone();
        for plane in test.planes() {
            valid.iter_mut().zip(plane).for_each(|(flag, value)| *flag &= value.is_finite());
        }
        let mut errors = Self {
            squared: vec![0.0; n],
            relative: vec![0.0; n],
            bias: vec![0.0; n],
            relative_plain: vec![0.0; n],
            toned: vec![0.0; n],
            value: vec![0.0; n],
            truth: vec![0.0; n],
            ssim: Vec::new(),
            corrected: measurer.bias.is_known(),
            non_finite_values: test.count_non_finite(),
            valid,
        };
        let mut luma = vec![0.0; n];
        for (c, plane) in test.planes().enumerate() {
            let mean = measurer.mean.plane(c);
            let (weight, toned) = (&measurer.weight[c * n..], &measurer.toned[c * n..]);
            for p in (0..n).filter(|&p| errors.valid[p]) {
                let x = f64::from(plane[p]);
                let e = x - f64::from(mean[p]);
                errors.value[p] += x / 3.0;
                errors.truth[p] += f64::from(mean[p]) / 3.0;
                let squared = measurer.numerator(c * n + p, x, e);
                errors.squared[p] += squared / 3.0;
                let bias = measurer.bias.at(c * n + p, e);
                errors.bias[p] += bias / 3.0;
                errors.relative[p] += (squared * weight[p] - bias) / 3.0;
                errors.relative_plain[p] += e * e * weight[p] / 3.0;
                let t = tone(plane[p]);
                let d = t - toned[p];
                errors.toned[p] += d * d / 3.0;
                luma[p] += LUMA[c] * t;
            }
        }
        errors.ssim = ssim_map(&luma, &measurer.luma, &errors.valid, test.width());
        errors
    }
}
