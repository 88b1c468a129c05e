//! The analysis of a study (`summary.json`): everything a report shows, each number with its uncertainty.

mod about;
mod cell;
mod claim;
mod claims;
mod compare;
mod equal_time;
mod estimate;
mod flicker;
mod interval;
mod progress;
mod scene;
mod verdict;
mod warning;

use std::collections::BTreeMap;

use noisefloor_frame::Finding;
use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use about::{Environment, MetricInfo, StudyInfo};
pub use cell::{CellSummary, MethodSummary, Skipped};
pub use claim::{ClaimFamily, ClaimId, ClaimSummary, Scale};
pub use claims::{BoundSummary, CoverageSummary};
pub use compare::{Comparison, PairResult, PaperResult, SlopeSummary};
pub use equal_time::EqualTime;
pub use estimate::{EstimateBin, EstimateSummary};
pub use flicker::FlickerSummary;
pub use interval::{Interval, Source};
pub use progress::{Completion, Missing};
pub use scene::{ReferenceSummary, SceneSummary};
pub use verdict::{Agreement, Status};
pub use warning::{Warning, WarningKind};

/// Version of the summary format.
pub const SUMMARY_SCHEMA: u32 = 1;

/// What the study was and where it ran.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
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
    pub progress: Option<Completion>,
    /// Whether it was made from a recorded study, which keeps no images.
    #[serde(default)]
    pub recorded: bool,
    /// What was found about the inputs, most serious first.
    #[serde(default)]
    pub findings: Vec<Finding>,
    /// Statements that a reader must see first: marked cells, violated enclosures, short references.
    pub warnings: Vec<Warning>,
    /// Every claim that was judged, by question, scene, level and row.
    #[serde(default)]
    pub claims: Vec<ClaimSummary>,
    /// All of them together.
    #[serde(default)]
    pub family: ClaimFamily,
    /// What questions found that have no field of their own here, by the question's id.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub answers: BTreeMap<String, Value>,
}
