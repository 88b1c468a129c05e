//! The analysis of a study (`summary.json`): everything a report shows, each number with its uncertainty.

mod progress;

use std::collections::BTreeMap;

use noisefloor_frame::Finding;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::study::RowFrames;

pub use progress::{Missing, Progress};

/// Version of the summary format.
pub const SUMMARY_SCHEMA: u32 = 1;

/// Where the uncertainty of an [`Interval`] comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// Student t over replicates, the reference's own noise added.
    Replicates,
    /// Bootstrap over 32×32 blocks of one image: says nothing about other random seeds.
    WithinImage,
    /// No uncertainty could be estimated.
    None,
}

/// A number with its uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Point estimate.
    pub value: f64,
    /// Standard error, in the unit of the value.
    pub standard_error: Option<f64>,
    /// Lower end.
    pub low: Option<f64>,
    /// Upper end.
    pub high: Option<f64>,
    /// Two-sided confidence of low and high.
    pub confidence: f64,
    /// Replicates (or blocks) behind it.
    pub n: u32,
    /// Origin of the uncertainty.
    pub source: Source,
    /// The estimate is not above the reference's floor (or not positive): print "< this" and plot an arrow.
    pub below: Option<f64>,
}

/// What the study was and where it ran.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// [`SUMMARY_SCHEMA`] when written.
    pub schema: u32,
    /// The study.
    pub study: StudyInfo,
    /// The machine and program.
    pub environment: Environment,
    /// Scenes in study order.
    pub scenes: Vec<SceneSummary>,
    /// Rows in study order.
    pub methods: Vec<MethodSummary>,
    /// One per scene × spp × row that ran.
    pub cells: Vec<CellSummary>,
    /// Rows that did not run somewhere, with the reason.
    pub skipped: Vec<Skipped>,
    /// Coverage of the input's intervals.
    pub coverage: Vec<CoverageSummary>,
    /// Measured violations of error bounds.
    pub bounds: Vec<BoundSummary>,
    /// Slopes and verdicts, per scene × row × metric.
    pub slopes: Vec<SlopeSummary>,
    /// Comparisons per scene × spp × metric.
    pub comparisons: Vec<Comparison>,
    /// Ratios of errors beside those that the source work reports.
    #[serde(default)]
    pub paper: Vec<PaperResult>,
    /// Methods' estimates of their own error beside the measured one, per scene × spp × row × pixel class.
    #[serde(default)]
    pub estimates: Vec<EstimateSummary>,
    /// Samples of rows that get as much time as another row, per scene × spp.
    #[serde(default)]
    pub equal_time: Vec<EqualTime>,
    /// Errors that change from frame to frame, per sequence × spp × row.
    #[serde(default)]
    pub flicker: Vec<FlickerSummary>,
    /// How far the study got; absent where that is not known, as in summaries of earlier programs.
    #[serde(default)]
    pub progress: Option<Progress>,
    /// Whether it was made from a recorded study, which keeps no images.
    #[serde(default)]
    pub recorded: bool,
    /// What was found about the inputs, most serious first.
    #[serde(default)]
    pub findings: Vec<Finding>,
    /// Statements that a reader must see first: marked cells, violated enclosures, short references.
    pub warnings: Vec<String>,
}

/// The study file's own words.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyInfo {
    /// Name such as `vfi-fig09`.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// What it asks, in a sentence or two.
    pub question: String,
    /// What the source work reports, and what we see; paragraphs.
    pub analysis: Vec<String>,
    /// Command that made it.
    pub command: String,
    /// Metric shown first, such as `relmse`.
    pub primary_metric: String,
    /// Metrics in display order: id, and how to read it.
    pub metrics: Vec<MetricInfo>,
    /// Sample counts in ascending order.
    pub spp: Vec<u32>,
    /// Which spp levels the image viewer shows (all if empty).
    pub viewer_spp: Vec<u32>,
    /// Which of [`crate::FIGURES`] are drawn (all if empty).
    #[serde(default)]
    pub figures: Vec<String>,
    /// Figures this study reproduces, such as `moon2013flash Fig. 9`.
    pub reproduces: Option<String>,
}

/// How to read a metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetricInfo {
    /// Id such as `relmse`.
    pub id: String,
    /// Short name such as `rMSE`.
    pub name: String,
    /// Formula with epsilon and averaging order.
    pub formula: String,
    /// Whether smaller is better.
    pub lower_is_better: bool,
    /// The right value of a metric that is neither error nor score: it ranks no rows and enters no ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ideal: Option<f64>,
    /// Unit, or empty.
    pub unit: String,
    /// Whether the reference's noise is taken out.
    pub reference_noise_removed: bool,
    /// 2 for squared errors, 1 for their roots; absent where plain Monte Carlo has no rate.
    #[serde(default)]
    pub order: Option<u32>,
}

/// Machine, program and load.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Environment {
    /// Program version.
    pub version: String,
    /// Processor model, where the platform tells.
    pub cpu: String,
    /// Logical processors.
    pub logical_cpus: u32,
    /// Threads used.
    pub threads: u32,
    /// Instruction set that the kernels chose, such as `avx512`.
    pub simd: String,
    /// Operating system and architecture.
    pub platform: String,
    /// One-minute load average when the study began, where the platform tells.
    pub load_at_start: Option<f64>,
    /// Build profile, `release` or `debug`.
    pub profile: String,
    /// Date and time of the analysis, UTC, ISO 8601.
    pub date: String,
}

/// A scene of the study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneSummary {
    /// Id within the study.
    pub id: String,
    /// Title.
    pub title: String,
    /// What it models or where it came from.
    pub about: String,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Replicates per spp level, by spp.
    pub replicates: BTreeMap<u32, u32>,
    /// Random seeds, path depth, filter and whatever else fixes the frames; name to value.
    pub settings: BTreeMap<String, String>,
    /// The reference.
    pub reference: ReferenceSummary,
    /// Pixels per class.
    pub classes: BTreeMap<String, u64>,
    /// Image of the reference, relative to the study's folder; empty in a recorded study, which has no images.
    pub reference_image: String,
    /// Seconds to render one frame, by spp: median over replicates, and threads used.
    pub render_seconds: BTreeMap<u32, f64>,
    /// Images of the noisy and denoised frames of replicate 0: row label to spp to path.
    pub images: BTreeMap<String, BTreeMap<u32, String>>,
    /// Diagnostic images of replicate 0: row label to spp to name to path.
    pub diagnostics: BTreeMap<String, BTreeMap<u32, BTreeMap<String, String>>>,
}

/// What stands for the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceSummary {
    /// Samples per pixel; 0 for exact truth, and where it is unknown.
    pub spp: u64,
    /// Whether it is the exact truth.
    #[serde(default)]
    pub exact: bool,
    /// Independent parts (0: unknown or exact).
    pub parts: u32,
    /// Sampling, or `exact`.
    pub sampling: String,
    /// How its noise is taken out of squared errors, in words.
    pub correction: String,
    /// Samples over the largest level of the study.
    pub ratio_to_top: f64,
    /// Whether the ratio is at least 16, as the coverage correction assumes.
    pub long_enough: bool,
    /// Metric id to the floor: the standard error that the reference itself contributes.
    pub floor: BTreeMap<String, f64>,
    /// Metric id to the largest bias by the reference's noise that was estimated and taken out of a value on this scene,
    /// relative to that value (relative metrics).
    pub bias: BTreeMap<String, f64>,
}

impl ReferenceSummary {
    /// Whether it is the exact truth, also in summaries of programs that told it by the sampling only.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact || self.sampling == "exact"
    }

    /// `exact truth`, `reference of 4096 samples per pixel`, or that their number is unknown.
    #[must_use]
    pub fn name(&self) -> String {
        match self.spp {
            _ if self.is_exact() => "exact truth".into(),
            0 => "reference of an unknown number of samples per pixel".into(),
            spp => format!("reference of {spp} samples per pixel"),
        }
    }
}

/// A row of the study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MethodSummary {
    /// Label, unique.
    pub label: String,
    /// Method id.
    pub method: String,
    /// Name for people.
    pub name: String,
    /// Citation key.
    pub citation: String,
    /// Source in full.
    pub reference: String,
    /// All parameters.
    pub params: Value,
    /// Notes of the card.
    pub notes: Vec<String>,
    /// Which frames it got.
    #[serde(default)]
    pub frames: RowFrames,
    /// Whether its card claims an estimate of its own error.
    #[serde(default)]
    pub estimates_error: bool,
}

/// Averages over the replicates of one scene × spp × row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Metric id to mean over replicates.
    pub metrics: BTreeMap<String, Interval>,
    /// Metric id to ratio to `mc` (geometric mean over paired replicates); below 1 is better for errors.
    pub ratio_to_mc: BTreeMap<String, Interval>,
    /// Metric id to the bias by the reference's noise that was estimated and taken out of the mean, in its unit; what is
    /// left of it is smaller. Metrics without any are absent.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub reference_bias: BTreeMap<String, f64>,
    /// Pixel class to metric id to mean over replicates.
    pub classes: BTreeMap<String, BTreeMap<String, Interval>>,
    /// Pixel class to metric id to ratio to `mc`.
    pub class_ratio_to_mc: BTreeMap<String, BTreeMap<String, Interval>>,
    /// Median seconds of denoising.
    pub denoise_seconds: Option<f64>,
    /// Smallest and largest timed run.
    pub denoise_seconds_range: Option<[f64; 2]>,
    /// Median seconds of rendering the input.
    pub render_seconds: Option<f64>,
    /// How many times more samples plain Monte Carlo needs for the same error: metric id to multiplier, for squared
    /// errors and their roots; none for a row that is left out of the ranking.
    pub equal_error: BTreeMap<String, Interval>,
    /// Whether the multiplier reaches beyond the rendered levels.
    pub equal_error_extrapolated: BTreeMap<String, bool>,
    /// Peak memory in bytes, largest over replicates.
    pub peak_memory_bytes: Option<u64>,
    /// Worst enclosure ratio over replicates and claims, if the method claims one; at most 1 if it held.
    pub enclosure_worst_ratio: Option<f64>,
    /// Named numbers of the method, mean over replicates.
    pub figures: BTreeMap<String, f64>,
    /// Replicates behind these numbers: those that all ranked rows of the level have; all of its own for a row that is
    /// left out of the ranking.
    pub replicates: u32,
    /// Replicates that the study asks for; 0 where that is not known.
    #[serde(default)]
    pub planned_replicates: u32,
    /// Pixels that the metrics are over, the fewest of a replicate; 0 where that is not known.
    #[serde(default)]
    pub pixels: u64,
    /// Pixels of the whole image; 0 where that is not known.
    #[serde(default)]
    pub pixels_of: u64,
    /// Why the row takes no part in the ranking and is never called best: it did not run on all frames that other rows
    /// ran on, or gave values that are not finite.
    #[serde(default)]
    pub left_out: Option<String>,
    /// Input pixels that were not finite, over all replicates.
    pub invalid_input_pixels: u64,
    /// Output values that were not finite, over all replicates.
    pub non_finite_output: u64,
}

/// A row that did not run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skipped {
    /// Scene id.
    pub scene: String,
    /// Sample counts concerned.
    pub spp: Vec<u32>,
    /// Row label.
    pub label: String,
    /// `skipped` or `failed`.
    pub status: String,
    /// Why.
    pub reason: String,
}

/// Coverage of the intervals of the input mean.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoverageSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Nominal 1−α.
    pub confidence: f64,
    /// Pixel class or `all`.
    pub class: String,
    /// Fraction of pixel-channels covered, allowing for the reference's noise; pixels without variance count as
    /// covered if constant.
    pub covered: Interval,
    /// The same without the allowance.
    pub covered_uncorrected: Interval,
    /// Fraction without variance whose value is right.
    pub constant: f64,
    /// Fraction without variance whose value is wrong: missed events.
    pub missed: f64,
    /// Why the number must be read with care, if so.
    pub mark: Option<String>,
}

/// Violations of an error bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoundSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Claim name.
    pub claim: String,
    /// Whether a proof covers this procedure.
    pub proven: bool,
    /// α: the rate that must not be exceeded.
    pub alpha: f64,
    /// Pixel class or `all`.
    pub class: String,
    /// Rate of violations over pixel-channels, allowing for the reference's noise.
    pub violations: Interval,
    /// The same without the allowance.
    pub violations_uncorrected: f64,
    /// Part of the rate that comes from pixels without variance.
    pub missed: f64,
    /// Mean of |D−μ| over the bound: how loose it is.
    pub mean_ratio: Option<f64>,
    /// `holds` (interval below or reaching α), `fails` (interval above α), `undecided` without an interval.
    pub verdict: String,
    /// Why the number must be read with care, if so.
    pub mark: Option<String>,
}

/// A ratio of two rows' errors beside the one that the source work reports.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperResult {
    /// What is compared, for people.
    pub what: String,
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Label of the row whose error is above the fraction line.
    pub row: String,
    /// Label of the row whose error is below it.
    pub over: String,
    /// Metric id.
    pub metric: String,
    /// Our ratio: geometric mean over paired replicates; absent where `reason` says why.
    pub ours: Option<Interval>,
    /// The source's ratio, from and to; equal for one number.
    pub paper: [f64; 2],
    /// Where the source says it.
    pub source: String,
    /// `agrees` (our interval meets the source's range, and not 1 as well where that does not), `larger gain than the paper's`, `smaller gain than the
    /// paper's`, `larger loss than the paper's` and `smaller loss than the paper's` where the source's ratio is not
    /// below 1, `opposite sign` (our interval and the source's range are on different sides of 1), `undecided` without
    /// an interval, `no number` without a ratio.
    pub verdict: String,
    /// Why there is no ratio, or no verdict.
    #[serde(default)]
    pub reason: Option<String>,
}

/// A method's estimate of its own squared error beside the measured one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateSummary {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Name of the image that estimate and measured error are about, where that is an intermediate one of the method and
    /// not its output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// Pixel class or `all`.
    pub class: String,
    /// Mean estimated squared error; may be negative.
    pub estimated: Interval,
    /// Mean measured squared error, the reference's noise taken out.
    pub measured: Interval,
    /// Estimated over measured (geometric mean over replicates), or estimated − measured where `is_ratio` is false.
    pub effect: Interval,
    /// Whether `effect` is a ratio: all means of all replicates are positive.
    pub is_ratio: bool,
    /// `calibrated` (the interval contains equality), `too optimistic` (estimates too small an error), `too
    /// pessimistic`, or `undecided` without an interval.
    pub verdict: String,
    /// Means over ten bins of pixel-channels by rank of the estimate, lowest first; only for class `all`.
    pub deciles: Vec<EstimateBin>,
    /// Pixel-channels whose estimate is not finite, over all replicates.
    pub non_finite: u64,
}

/// One bin of pixel-channels by rank of the estimate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateBin {
    /// Mean estimated squared error.
    pub estimated: Interval,
    /// Mean measured squared error.
    pub measured: Interval,
}

/// How much a row's error changes over the frames of a sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlickerSummary {
    /// Name of the sequence.
    pub sequence: String,
    /// Scene ids by frame.
    pub scenes: Vec<String>,
    /// Samples per pixel.
    pub spp: u32,
    /// Row label.
    pub label: String,
    /// Unbiased variance over the frames of the error of each pixel and channel, mean over these, less the mean
    /// variance of the references; mean over replicates.
    pub variance: Interval,
    /// The same over that of the row `first` (geometric mean over paired replicates); absent for that row itself, and
    /// where a corrected variance is not positive.
    pub ratio_to_first: Option<Interval>,
    /// Label of the first row of the study that has numbers here.
    pub first: String,
    /// Squared error over the same frames, pixels and channels, less the mean variance of the references.
    pub squared_error: Interval,
    /// Mean variance of the references that was subtracted; absent if one of them states none, whose noise then counts.
    pub reference_variance: Option<f64>,
}

/// Convergence of one row on one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SlopeSummary {
    /// Scene id.
    pub scene: String,
    /// Row label.
    pub label: String,
    /// Metric id.
    pub metric: String,
    /// Slope of log error against log spp, fitted per replicate; −1 for plain Monte Carlo's MSE, −½ for RMSE.
    pub slope: Interval,
    /// `consistent`, `plateaus`, or `undecided`.
    pub verdict: String,
    /// The verdict in a sentence, with the bias where it plateaus.
    pub sentence: String,
    /// Error floor b of error(n) = b + c/n where the verdict is `plateaus`.
    pub bias: Option<Interval>,
}

/// All pairs of rows at one scene × spp × metric, Holm-corrected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel.
    pub spp: u32,
    /// Metric id.
    pub metric: String,
    /// Labels from best to worst.
    pub ranking: Vec<String>,
    /// Labels that the replicates cannot tell from the best (always contains the best).
    pub best_group: Vec<String>,
    /// `all-pairs` or `with-best`.
    pub family: String,
    /// Pairs compared, with the Holm-adjusted p-value.
    pub pairs: Vec<PairResult>,
}

/// One comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairResult {
    /// First label.
    pub a: String,
    /// Second label.
    pub b: String,
    /// Error of a over error of b (or difference a−b where `is_ratio` is false).
    pub effect: Interval,
    /// Whether `effect` is a ratio.
    pub is_ratio: bool,
    /// Holm-adjusted p-value.
    pub p_adjusted: f64,
    /// Whether they can be told apart at 95 %.
    pub distinguishable: bool,
}

/// A row that gets as much time as another takes with its denoising.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EqualTime {
    /// Scene id.
    pub scene: String,
    /// Level of the other row.
    pub spp: u32,
    /// Label of the row.
    pub label: String,
    /// Label of the other row.
    pub with: String,
    /// Samples per pixel that its frames had, as the study says.
    pub used: u32,
    /// Samples per pixel that the medians of this run imply: the level, and the other row's denoising time over the
    /// time of a sample per pixel. Of an adaptive row all its time, since placing samples is part of it.
    pub implied: Option<f64>,
    /// Median seconds of the other row's denoising.
    pub denoise_seconds: f64,
    /// Median seconds of one sample in every pixel, rendered plainly.
    pub seconds_per_sample: Option<f64>,
}
