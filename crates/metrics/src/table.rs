//! The table of metrics.

use std::sync::RwLock;

use crate::constants::EPSILON;
use crate::error::MetricError;
use crate::flip;
use crate::metric::{Better, Metric, Rule};
use crate::pixels::mean;
use crate::rules;

/// The metrics that are always measured, in the order of display.
pub const METRICS: &[Metric] = &[
    Metric {
        averaging: "mean over pixels and channels",
        unit: "radiance²",
        reference_noise_removed: true,
        order: Some(2),
        ..Metric::new(
            "mse",
            "MSE",
            "mean (x−r)², with (x−r)² taken as (x−r_A)(x−r_B) from the reference's halves, as (x−r)²−var(r) where it has \
             a variance only, as it stands where it is exact",
            Rule::Over(|pixels, of| Some(mean(&pixels.squared, of))),
        )
    },
    Metric {
        averaging: "root after the mean over pixels and channels",
        unit: "radiance",
        reference_noise_removed: true,
        order: Some(1),
        ..Metric::new(
            "rmse",
            "RMSE",
            "√max(0, MSE)",
            Rule::Over(|pixels, of| Some(mean(&pixels.squared, of).max(0.0).sqrt())),
        )
    },
    Metric {
        epsilon: Some(EPSILON),
        averaging: "ratio per pixel and channel, then mean over pixels and channels",
        reference_noise_removed: true,
        order: Some(2),
        ..Metric::new(
            "relmse",
            "rMSE",
            "mean (x−r)²/(max(r,0)²+ε), ε = 0.01, squared error corrected as in MSE, less the bias by the reference's \
             noise in the denominator",
            Rule::Over(|pixels, of| Some(mean(&pixels.relative, of))),
        )
    },
    Metric {
        epsilon: Some(EPSILON),
        averaging: "ratio per pixel and channel, mean over channels, then mean over the pixels kept",
        reference_noise_removed: true,
        ..Metric::new(
            "relmse_trimmed",
            "rMSE trimmed",
            "as rMSE, without the 0.1 % of the pixels (rounded up) where the mean of (x−r)²/(max(r,0)²+ε) over the \
             channels is largest",
            Rule::Over(rules::relmse_trimmed),
        )
    },
    Metric {
        averaging: "mean over pixels and channels before the logarithm",
        better: Better::Higher,
        unit: "dB",
        ..Metric::new(
            "psnr",
            "PSNR",
            "−10·log10 mean (T(x)−T(r))², T(x) = sRGB curve of clamp(x, 0, 1) at exposure 1, peak 1; no value for equal \
             images",
            Rule::Over(|pixels, of| Some(-10.0 * mean(&pixels.toned, of).log10())),
        )
    },
    Metric {
        better: Better::Higher,
        ..Metric::new(
            "ssim",
            "SSIM",
            "structural similarity (Wang et al. 2004) of Rec. 709 luma of T(x) and T(r), T as for PSNR; Gaussian window \
             11×11, σ = 1.5, K1 = 0.01, K2 = 0.03, peak 1; at the border and beside left-out pixels the window is \
             clipped and its weights are normalised",
            Rule::Map(rules::ssim),
        )
    },
    Metric {
        averaging: "means over pixels and all three channels together, then their ratio",
        better: Better::CloserTo(1.0),
        ..Metric::new(
            "energy",
            "energy",
            "mean x / mean r; no value where mean r is not positive",
            Rule::Over(rules::energy),
        )
    },
];

/// Metrics that are measured where somebody asks for them.
pub const ON_REQUEST: &[Metric] = &[Metric {
    non_finite: "a pixel with a NaN or infinite channel is counted and left out; its neighbours see the reference there",
    ..Metric::new(
        "hdr_flip",
        "HDR-FLIP",
        "HDR-FLIP (Andersson et al. 2021, version 1.7): the largest LDR-FLIP of each pixel over exposures of max(x,0) and \
         max(r,0), 67.02 pixels per degree, ACES tone curve; as many exposures as there are stops, rounded up and at \
         least 2, evenly from that which puts the largest luminance of r at 85 % of the display to that which puts the \
         median there; no value where no channel of r exceeds 1e-6",
        Rule::Map(flip::hdr_flip_map),
    )
}];

/// Metrics that this program does not have by itself.
static ADDED: RwLock<Vec<&'static Metric>> = RwLock::new(Vec::new());

/// Adds a metric of your own to those that are measured on request, for the rest of the program: from then on its id may
/// stand wherever the id of a built-in metric may.
///
/// ```
/// use noisefloor_frame::{Image, Reference};
/// use noisefloor_metrics::{Measurer, Metric, Rule, add, metric};
///
/// add(Metric::new(
///     "largest",
///     "largest error",
///     "max |x−r|",
///     Rule::Over(|pixels, of| {
///         let [x, r] = [pixels.test(), pixels.reference()].map(|image| image.plane(0));
///         of.iter().map(|&p| f64::from((x[p] - r[p]).abs())).reduce(f64::max)
///     }),
/// ))?;
/// let truth = Reference::exact(Image::filled(16, 16, 3, 0.5));
/// let measurer = Measurer::new(&truth, None)?.with(&[metric("largest")?]);
/// assert_eq!(measurer.measure(&Image::filled(16, 16, 3, 0.75))?.values["largest"], Some(0.25));
/// # Ok::<(), noisefloor_metrics::MetricError>(())
/// ```
///
/// # Errors
/// [`MetricError::Taken`] if there is one of that id.
pub fn add(metric: Metric) -> Result<(), MetricError> {
    let mut added = ADDED.write().unwrap_or_else(std::sync::PoisonError::into_inner);
    if METRICS.iter().chain(ON_REQUEST).chain(added.iter().copied()).any(|other| other.id == metric.id) {
        return Err(MetricError::Taken { id: metric.id });
    }
    added.push(Box::leak(Box::new(metric)));
    Ok(())
}

/// The metrics that are measured on request: ours, then what was [added](add).
#[must_use]
pub fn on_request() -> Vec<&'static Metric> {
    let added = ADDED.read().unwrap_or_else(std::sync::PoisonError::into_inner);
    ON_REQUEST.iter().chain(added.iter().copied()).collect()
}

/// The metric of this id, always measured or on request.
///
/// # Errors
/// [`MetricError::Unknown`] listing the known ids.
pub fn metric(id: &str) -> Result<&'static Metric, MetricError> {
    let known = || METRICS.iter().chain(on_request());
    known().find(|metric| metric.id == id).ok_or_else(|| MetricError::Unknown {
        id: id.to_owned(),
        known: known().map(|metric| metric.id).collect::<Vec<_>>().join(", "),
    })
}
