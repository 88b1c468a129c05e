//! One JSON line per finished cell of a study (`results.jsonl`).

use std::collections::BTreeMap;

use noisefloor_denoiser::StageSeconds;
use noisefloor_frame::{Finding, Sampling};
use noisefloor_metrics::{Contribution, Measured};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::Key;

/// Version of the record format; a reader refuses newer ones.
pub const RECORD_SCHEMA: u32 = 1;

/// How a cell ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "kebab-case")]
pub enum Outcome {
    /// Ran; the metrics are there.
    Done,
    /// Not run, because inputs are missing or the method does not apply.
    Skipped {
        /// Why, for the report.
        reason: String,
    },
    /// Ran and ended in a typed error.
    Failed {
        /// The error's message.
        reason: String,
    },
}

/// One cell: scene × sampling × spp × replicate × method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// [`RECORD_SCHEMA`] when written.
    pub schema: u32,
    /// Content hash of all that determines the cell's numbers: frame, truth, what the method and the measuring give on fixed
    /// inputs, parameters. Not the program that ran it: one that gives the same numbers goes on where another stopped.
    pub cell: String,
    /// Hash of the program that ran it; empty if it did not say so.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub build: String,
    /// Hash of what the measuring that made the numbers gives on fixed inputs; empty if unknown.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub measuring: String,
    /// Keys of the frame that it is of and of the neighbouring frames that its method looked at; empty in records of earlier
    /// programs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<Key>,
    /// Study name.
    pub study: String,
    /// Scene id within the study.
    pub scene: String,
    /// Kind of sampling of the noisy frame.
    pub sampling: Sampling,
    /// Which photon maps the frame was rendered with: [`crate::Maps::Fixed`] or [`crate::Maps::Fresh`]; absent without
    /// photon mapping.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub photon_maps: Option<crate::Maps>,
    /// Samples per pixel (rounded mean if they vary).
    pub spp: u32,
    /// Replicate, from 0.
    pub replicate: u32,
    /// Samples per pixel of the frame, if it has others than its level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame_spp: Option<u32>,
    /// How the frame's samples were placed, if not evenly.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptive: Option<AdaptiveRecord>,
    /// Method id such as `virtual-flash`.
    pub method: String,
    /// Label of the row in the study; unique within it, equal to the method id unless the study says otherwise.
    pub label: String,
    /// All parameters, defaults included.
    pub params: Value,
    /// How it ended; its fields stand beside the others as `status` and `reason`.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Metric id to value, over all pixels; `null` in JSON if not finite. Ids: mse, rmse, relmse, relmse_trimmed, psnr,
    /// ssim, energy.
    pub metrics: BTreeMap<String, Option<f64>>,
    /// Metric id to the standard error that the reference's own noise contributes (common to all replicates); absent
    /// metrics have none stated.
    #[serde(default)]
    pub metrics_reference_se: BTreeMap<String, f64>,
    /// Metric id to standard error within this one image (block bootstrap), only when the study has one replicate.
    #[serde(default)]
    pub metrics_within_se: BTreeMap<String, f64>,
    /// Metric id to standard error of the logarithm of the ratio to the noisy input's error, within this one image;
    /// only when the study has one replicate.
    #[serde(default)]
    pub ratio_within_se: BTreeMap<String, f64>,
    /// Pixels that the metrics are over: those where input, output and reference are finite. 0 in records that do not
    /// say.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub pixels: u64,
    /// Pixels of the whole image. 0 in records that do not say.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub pixels_of: u64,
    /// Pixel class to metric id to value.
    #[serde(default)]
    pub classes: BTreeMap<String, BTreeMap<String, Option<f64>>>,
    /// Metric id to what the reference's noise does to the value: the bias that was taken out, and the influence of each
    /// part of the reference, by which its share in ratios and slopes is known. Absent metrics have none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub reference: BTreeMap<String, Contribution>,
    /// The same per pixel class.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub class_reference: BTreeMap<String, BTreeMap<String, Contribution>>,
    /// Coverage of the input mean's t-intervals; only on the rows of method `mc`, whose output is that mean.
    #[serde(default)]
    pub coverage: Vec<CoverageCount>,
    /// Violations of each of the method's error bounds.
    #[serde(default)]
    pub bounds: Vec<BoundCount>,
    /// Worst ratio |D−x̄| / (half-width + rounding allowance) per enclosure claim; at most 1 if it held.
    #[serde(default)]
    pub enclosures: Vec<EnclosureCheck>,
    /// The method's estimate of its own squared error beside the measured one; absent if its output has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error_estimate: Option<EstimateCheck>,
    /// What questions measured that have no field of their own here, by the question's id.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub answers: BTreeMap<String, Value>,
    /// Pixels replaced or counted as non-finite in the input and output.
    #[serde(default)]
    pub non_finite: NonFinite,
    /// What was found about the cell's input frame; the same for all rows of a frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub findings: Vec<Finding>,
    /// Named numbers from the method, such as the flash intensity.
    #[serde(default)]
    pub figures: BTreeMap<String, f64>,
    /// Times.
    pub seconds: Seconds,
    /// Peak resident memory of the process during the cell, bytes, where the platform tells; the frame and its truth
    /// are in it. Where the platform cannot reset the peak, it is that of the process so far.
    pub peak_memory_bytes: Option<u64>,
    /// Denoised image, relative to the study's folder.
    pub image: Option<String>,
    /// Diagnostic images, name to path relative to the study's folder.
    #[serde(default)]
    pub diagnostics: BTreeMap<String, String>,
    /// What a program outside said while it ran: path relative to the study's folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log: Option<String>,
    /// Path of each of these files to its hash, so that a damaged one is found.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, String>,
}

impl Record {
    /// The cell's image, diagnostic images and log, relative to the study's folder.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.image.iter().chain(self.diagnostics.values()).chain(&self.log).map(String::as_str)
    }
}

#[expect(clippy::trivially_copy_pass_by_ref)] // what serde asks for
fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl Record {
    /// Takes over what was measured of the cell's image.
    pub fn take(&mut self, measured: Measured) {
        (self.pixels, self.pixels_of) = (measured.pixels as u64, measured.pixels_of as u64);
        self.metrics = measured.values;
        self.classes = measured.classes;
        self.metrics_reference_se = measured.reference_se;
        self.reference = short(measured.reference);
        self.class_reference =
            measured.class_reference.into_iter().map(|(class, found)| (class, short(found))).collect();
    }

    /// What the reference does to a metric over all pixels or in a class.
    pub fn contribution(&self, class: Option<&str>, metric: &str) -> Option<&Contribution> {
        match class {
            None => self.reference.get(metric),
            Some(class) => self.class_reference.get(class)?.get(metric),
        }
    }
}

/// With influences to four digits: they only make standard errors, and there are many of them.
fn short(contributions: BTreeMap<String, Contribution>) -> BTreeMap<String, Contribution> {
    let short = |value: f64| format!("{value:.3e}").parse().unwrap_or(value);
    let of = |c: Contribution| Contribution {
        bias: c.bias,
        noise: short(c.noise),
        parts: c.parts.into_iter().map(short).collect(),
        product: short(c.product),
    };
    contributions.into_iter().map(|(id, contribution)| (id, of(contribution))).collect()
}

/// A frame whose samples were placed in rounds, where its row's method asked for them. They depend on what was seen,
/// so intervals and bounds say nothing of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AdaptiveRecord {
    /// Rounds, the first of them uniform.
    pub rounds: u32,
    /// Mean over the pixels.
    pub mean_spp: f64,
    /// Fewest samples of a pixel.
    pub least: u32,
    /// Most samples of a pixel.
    pub most: u32,
    /// Seconds that the decisions took, which `seconds.render` includes.
    pub density_seconds: Option<f64>,
}

/// A method's estimate of its own squared error beside the squared error that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateCheck {
    /// Over the image.
    pub all: EstimateMeans,
    /// Pixel class to the same over its pixels; classes without pixels are absent.
    pub classes: BTreeMap<String, EstimateMeans>,
    /// The same over ten bins of pixel-channels by rank of the estimate, lowest first; fewer bins if there are fewer
    /// pixel-channels.
    pub deciles: Vec<EstimateMeans>,
    /// Pixel-channels left out because the estimate is not finite there.
    pub non_finite: u64,
    /// Standard error of the logarithm of estimated over measured within this one image, over blocks of about 32×32
    /// pixels; only when the study has one replicate and both are positive.
    #[serde(default)]
    pub within_se: Option<f64>,
    /// Name of the image that the estimate is about and the squared error was measured of, where that is an intermediate
    /// one and not the output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
}

/// Means over some pixel-channels, in squared radiance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EstimateMeans {
    /// Pixel-channels.
    pub count: u64,
    /// Mean of the estimate; may be negative, because an unbiased estimate keeps its sign.
    pub estimated: f64,
    /// Mean of the measured squared error, the reference's noise taken out as in `mse`; may be negative.
    pub measured: f64,
}

impl EstimateMeans {
    /// Estimated over measured: below 1 is too optimistic. `None` unless both are positive.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        (self.estimated > 0.0 && self.measured > 0.0).then(|| self.estimated / self.measured)
    }
}

/// Non-finite values met.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct NonFinite {
    /// Pixels of the input frame whose colour is not finite: filled for methods that look across, and in no number.
    pub input_pixels: usize,
    /// Negative variances, taken as unknown.
    pub negative_variances: usize,
    /// Non-finite values in the output; these pixels are counted, and left out of the metrics.
    pub output_values: usize,
}

/// Times of one cell, wall-clock seconds.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// Rendering the input frame (as recorded when it was rendered, possibly in another run).
    pub render: Option<f64>,
    /// Denoising: median of `denoise_runs`.
    pub denoise: Option<f64>,
    /// Beside them: starting a program and its files, where the method says what it computed for itself; median.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub around: Option<f64>,
    /// All timed runs after the warm-up.
    #[serde(default)]
    pub denoise_runs: Vec<f64>,
    /// Stages of the median run.
    #[serde(default)]
    pub stages: Vec<StageSeconds>,
    /// Threads used.
    #[serde(default)]
    pub threads: u32,
}

/// Coverage of two-sided t-intervals of the input mean in one pixel class, counted over pixel-channels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoverageCount {
    /// 1−α.
    pub confidence: f64,
    /// Pixel class, or `all`.
    pub class: String,
    /// Pixel-channels with s > 0.
    pub total: u64,
    /// Of those: covered, allowing for the reference's noise.
    pub covered: u64,
    /// Of those: covered without the allowance.
    pub covered_uncorrected: u64,
    /// Of the others: with the truth above the interval; 0 in records of programs that did not tell the sides apart.
    #[serde(default)]
    pub truth_above: u64,
    /// With the truth below the interval.
    #[serde(default)]
    pub truth_below: u64,
    /// Pixel-channels with s = 0 whose mean agrees with the truth within the reference's noise.
    pub constant: u64,
    /// Pixel-channels with s = 0 whose mean does not: the event was missed by all samples.
    pub missed: u64,
    /// Standard error of (covered + constant) / all within this one image, over blocks of about 32×32 pixels.
    #[serde(default)]
    pub within_se: Option<f64>,
}

/// How often |D−μ| exceeded a bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundCount {
    /// Name of the claim, such as `Theorem 3.1`.
    pub claim: String,
    /// Whether a proof covers the procedure.
    pub proven: bool,
    /// α of the claim.
    pub alpha: f64,
    /// Pixel class, or `all`.
    pub class: String,
    /// Pixel-channels.
    pub total: u64,
    /// Violations, allowing for the reference's noise.
    pub violations: u64,
    /// Violations without the allowance.
    pub violations_uncorrected: u64,
    /// Of the violations: pixel-channels with s = 0, where the interval is a point (missed events).
    pub violations_missed: u64,
    /// Mean over pixel-channels of |D−μ| / bound, where the bound is positive.
    pub mean_ratio: Option<f64>,
    /// Standard error of violations / total within this one image, over blocks of about 32×32 pixels.
    #[serde(default)]
    pub within_se: Option<f64>,
}

/// The certain half of the theorem: |D−x̄| never exceeds the half-width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EnclosureCheck {
    /// Name of the claim.
    pub claim: String,
    /// Largest |D−x̄| / (t·s/√n·(1+1e-6) + 8·eps·|x̄|) over pixels and channels; 0/0 counts as 0.
    pub worst_ratio: f64,
    /// Whether it held everywhere.
    pub held: bool,
}
