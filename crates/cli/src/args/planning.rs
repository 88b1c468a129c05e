//! Arguments of verbs before a study and after two.

use std::path::PathBuf;

use super::values::{Size, margin, power, probability, ratio};

/// `noisefloor plan`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor plan quick\n  noisefloor plan rdfc-fig06 --ratio 0.98        replicates to tell 2 %\n  \
    noisefloor plan my-study.toml --replicates 8    what 8 replicates would tell, and cost\n  \
    noisefloor plan quick --from reports/rdfc-fig06    with the spread of a recorded study\n  noisefloor plan quick --json\n\n\
    A ratio is told if the 95 % interval of the paired log ratio over replicates excludes 1 at the first step of Holm's rule \
    over the pairs of rows of a cell. Nothing is run but a short calibration; a tiny frame of every scene is rendered to know \
    what the cache has."
)]
pub struct Plan {
    /// Name of a built-in study or scene, a study file, a glTF file, or a folder of EXR frames with a reference
    pub study: String,
    /// Ratio of two errors that the study is to tell from 1: its replicates are told
    #[arg(long, value_name = "RATIO", default_value = "0.95", value_parser = ratio)]
    pub ratio: f64,
    /// Plan for this many replicates at every level instead of the study's own
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub replicates: Option<u32>,
    /// Share of studies that would tell the ratio of the columns beside those of half of them
    #[arg(long, value_name = "SHARE", default_value = "0.8", value_parser = power)]
    pub power: f64,
    /// Folder of the study's results: finished cells cost nothing, and their spread is used
    /// [default: noisefloor-results/STUDY]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Take the spread over replicates from this folder of a study that was run, or this recording
    #[arg(long, value_name = "DIR")]
    pub from: Option<PathBuf>,
    /// Size of rendered and synthetic scenes, in pixels
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// Folder for rendered frames, shared by all studies [default: the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Samples per pixel of frames that do not say it themselves (folders only)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: Option<u32>,
    /// Threads for the calibration, as for the run [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// `noisefloor gate`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor gate baseline/quick noisefloor-results/quick\n  \
    noisefloor gate reports/vfi-fig09 noisefloor-results/vfi-fig09 --margin 0.02\n  \
    noisefloor gate old new --metric mse --strict --json\n\n\
    For every row, and every row on a scene at a level: same (all numbers equal bit by bit), within margin (the interval of \
    new/old lies inside 1/(1+MARGIN) … 1+MARGIN), better, worse, or cannot be told. The chance of any false better or worse is at \
    most ALPHA per gate: half of it for the rows, half for the cells, each by Holm's rule. A cell that does not run any more counts \
    as worse. Frames, references and measuring must be the same; what the new folder has in addition is not looked at.\n\n\
    Exit codes: 0 nothing is worse, 4 something is worse, 5 the two cannot be compared, 6 with --strict: of something it \
    cannot be told; 1 and 2 as elsewhere.")]
pub struct Gate {
    /// Results of the old version: a folder of `noisefloor run`, or a recording
    pub old: PathBuf,
    /// Results of the new version on the same inputs
    pub new: PathBuf,
    /// Error to compare [default: the primary metric of the old study]
    #[arg(long, value_name = "ID")]
    pub metric: Option<String>,
    /// Relative change of an error that does not matter; 0 if every one does
    #[arg(long, value_name = "SHARE", default_value = "0.01", value_parser = margin)]
    pub margin: f64,
    /// Largest chance of any false `better` or `worse` per gate
    #[arg(long, value_name = "P", default_value = "0.05", value_parser = probability)]
    pub alpha: f64,
    /// Fail also where it cannot be told whether something changed
    #[arg(long)]
    pub strict: bool,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}
