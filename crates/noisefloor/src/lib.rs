//! Evaluation workbench for Monte Carlo denoisers: everything a user's own program needs, under one name.
//!
//! # Bring a denoiser
//!
//! Write your method in a crate of your own: implement [`Denoiser`], declare its parameters with [`parameters!`], and hand
//! its factory ([`method()`]) to [`main_with`]. The program that results is the whole `noisefloor` command with your method in
//! every list, study and report:
//!
//! ```no_run
//! use noisefloor::{Citation, DenoiseError, Denoiser, Input, MethodCard, NoParams, Output, method};
//!
//! struct Mine;
//!
//! impl Denoiser for Mine {
//!     fn card(&self) -> MethodCard {
//!         MethodCard::new("mine", "My method", Citation::new("me2026", "unpublished"))
//!     }
//!     fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
//!         input.check(&self.card())?;
//!         Ok(Output::from_image(input.target.color.mean.clone()))
//!     }
//! }
//!
//! fn main() -> std::process::ExitCode {
//!     noisefloor::main_with([method("mine", "does nothing yet", None, |_: NoParams| Ok(Mine))])
//! }
//! ```
//!
//! A test of your crate runs it through everything that methods must keep, in one line:
//! `noisefloor::conformance::assert_conforms(&Mine)`. The command says the same, recipe by recipe: `my-program check mine`.
//!
//! The example `box_filter` in this crate is a complete one with a parameter, its check and its claims. What is known only at
//! run time implements [`Factory`] itself.
//!
//! # Bring a metric
//!
//! [`metrics::add`] before [`main_with`]: a study that lists its id gets it, and so does `noisefloor compare --metric ID`.

pub use noisefloor_cli::main_with;
pub use noisefloor_denoiser::{
    Adaptive, Alternative, Bound, BuildError, Caveat, Choices, Citation, Claim, Claims, Cost, DenoiseError,
    Denoiser, Diagnostic, Diagnostics, Entry, Factory, Figure, Guarded, Input, Invariance, Kind, Method,
    MethodCard, Need, NoParams, Output, Param, ParamError, Parameters, Published, Registry, Setting,
    StageSeconds, StageTimer, Unit, choices, method, parameters,
};
pub use noisefloor_frame::{
    Camera, Counts, Estimate, FeatureId, Fidelity, Finding, FindingKind, Flash, Frame, FrameError, Hygiene,
    Image, PixelFilter, Provenance, Reference, Samples, Sampling, Variance, luminance,
};

/// Recipes that every method must keep.
pub use noisefloor_conformance as conformance;

/// Reading and writing frames as OpenEXR.
pub use noisefloor_io as io;

/// Runs of studies.
pub use noisefloor_harness as harness;

/// Inputs held against each other.
pub use noisefloor_inputs as inputs;

/// Image metrics.
pub use noisefloor_metrics as metrics;

/// What is asked of the data: measuring, analysis, exhibits.
pub use noisefloor_questions as questions;

/// The built-in methods.
pub use noisefloor_registry as registry;

/// The path tracer.
pub use noisefloor_render as render;

/// Plots and pages.
pub use noisefloor_report as report;

/// The built-in scenes.
pub use noisefloor_scenes as scenes;

/// Intervals, coverage, bounds, slopes.
pub use noisefloor_stats as stats;

/// Studies as plain data: files, plans, records, summaries, exhibits.
pub use noisefloor_study as study;

/// Frames with known truth.
pub use noisefloor_synthetic as synthetic;
