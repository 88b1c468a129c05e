//! Arguments of every verb, with examples in each help text.

mod planning;
mod shot;
mod values;

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use noisefloor_frame::Statistic;
use noisefloor_kernels::InstructionSet;
use noisefloor_metrics::Metric;

use crate::exit;
pub use planning::{Gate, Plan};
pub use shot::Shot;
pub use values::{Pixel, Size};
use values::{positive, stops};

/// Evaluation workbench for Monte Carlo denoisers.
#[derive(Debug, Parser)]
#[command(
    name = "noisefloor",
    version,
    about = "Evaluation workbench for Monte Carlo denoisers",
    long_about = "Renders or imports noisy frames with their statistics, runs denoisers on them, and reports error \
        against samples, error against seconds, coverage of confidence intervals, and whether error bounds held.\n\n\
        Without a verb it runs the built-in study `quick`.",
    after_help = format!("Examples:\n  noisefloor                          run the study `quick` (a few minutes)\n  \
        noisefloor run vfi-fig09            reproduce a figure\n  \
        noisefloor run study.toml           run your own study\n  \
        noisefloor methods                  what can be compared\n  \
        noisefloor convert out.exr out.png  look at a picture\n\n{}", exit::help())
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub verb: Option<Verb>,
    /// Filter with another instruction set than the best: portable, avx2 or avx512. Results have the same bits
    #[arg(long, global = true, hide = true, value_name = "LEVEL")]
    pub instruction_set: Option<InstructionSet>,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Run a study and write its report; continues where an earlier run stopped
    Run(Run),
    /// Tell what a study will cost and which ratios of errors its replicates can tell, running nothing
    Plan(Plan),
    /// Compare two results of the same inputs, of an old and a new version: did any error change?
    Gate(Gate),
    /// Render one noisy frame with its statistics
    Render(Render),
    /// Denoise one frame
    Denoise(Denoise),
    /// Measure images against a reference
    Compare(Compare),
    /// Make a picture to look at: OpenEXR to PNG
    Convert(Convert),
    /// Make the analysis and the report again from kept records and images, running nothing
    Report(Report),
    /// Write the tables and charts of a study as files: CSV, JSON, LaTeX and Markdown; SVG, PNG and PDF
    Export(Export),
    /// Record a study for a repository: its numbers without images, and a README with its tables and plots
    Record(Record),
    /// List the denoising methods with their parameters, or show one with its page
    Methods(List),
    /// Run a method through the recipes that every method must keep: one's own, before it is compared
    Check(Check),
    /// List the built-in scenes with what they model
    Scenes(Scenes),
}

impl Default for Verb {
    fn default() -> Self {
        Self::Run(Run::default())
    }
}

/// `noisefloor run`.
#[derive(Debug, Default, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor run quick\n  noisefloor run quick --size 320x240 --out /tmp/quick\n  \
    noisefloor run vfi-table1 --threads 8\n  noisefloor run quick --again rdfc     its cells once more\n  noisefloor run my-study.toml --cache /big/cache\n  \
    noisefloor run frames/            somebody else's frames: spp0004.exr …, reference.exr\n  \
    noisefloor run rings --integrator photon-mapping    one scene\n  \
    noisefloor run my-scene.glb                         your own scene"
)]
pub struct Run {
    /// Name of a built-in study or scene, a study file, a glTF file, or a folder of EXR frames with a reference
    /// [default: quick]
    pub study: Option<String>,
    /// Folder for records, images and the report [default: noisefloor-results/STUDY]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Size of rendered and synthetic scenes, in pixels
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// Folder for rendered frames, shared by all studies [default: the user's cache folder]
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Run the cells of this row again although they are finished: a label or a method id; repeatable
    #[arg(long, value_name = "METHOD")]
    pub again: Vec<String>,
    /// Threads for rendering and denoising [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Most memory that images may take, in GiB [default: what is free, at most 64]
    #[arg(long, value_name = "GIB", value_parser = crate::memory::parse_gib)]
    pub max_memory: Option<f64>,
    /// Which photon maps replicates get (scenes only): `fixed`, one pair for all and for the reference, or `fresh`, a
    /// new pair for each and a path-traced reference [default: fixed]
    #[arg(long, value_parser = ["fixed", "fresh"])]
    pub maps: Option<String>,
    #[command(flatten)]
    pub shot: Shot,
    /// Samples per pixel of frames that do not say it themselves (folders only)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: Option<u32>,
    /// No progress and no table: errors only
    #[arg(long, short)]
    pub quiet: bool,
}

/// `noisefloor render`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor render cornell --spp 64 --seed 1 --size 640x480 -o cornell.exr\n  \
    noisefloor render toaster --spp 16 --record albedo,normal,flash --filter point -o toaster.exr\n  \
    noisefloor render outdoor --spp 4096 --parts 8 -o reference.exr     a low-discrepancy reference\n  \
    noisefloor render cornell --spp 64 --statistics third-moment,box-cox:0.5:0.001 -o moments.exr\n  \
    noisefloor render cornell --spp 64 --feature-hit through-specular -o behind-the-mirror.exr\n  \
    noisefloor render outdoor --spp 64 --environment sky.exr -o another-sky.exr\n  \
    noisefloor render rings --spp 64 --integrator photon-mapping -o caustics.exr\n  \
    noisefloor render cornell --spp 64 --orbit 2 --frames 5 -o turn.exr     turn.0000.exr to turn.0004.exr\n  \
    noisefloor render toaster --spp 64 --exposure 1 -o toaster.png          a picture to look at"
)]
pub struct Render {
    /// Scene id, see `noisefloor scenes`; or a glTF file, .gltf or .glb
    pub scene: String,
    /// Samples per pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: u32,
    /// Random seed [default: another one for each number of samples, and for references; it is printed]. Images of one seed
    /// share samples; ranges of one run (--start) need one
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Image size in pixels
    #[arg(long, value_name = "WxH", default_value = "320x240")]
    pub size: Size,
    /// File to write: OpenEXR with all statistics (.exr, a device, a pipe, or - for standard output), or a picture of
    /// the colour (.png)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Exposure of a .png in stops, before the sRGB curve [default: 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = stops)]
    pub exposure: Option<f32>,
    /// Quantities to record beside the colour, by comma; `none` for the colour alone [default: everything that
    /// registered methods can use and the scene can give]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    pub record: Option<Vec<String>>,
    /// Statistics of the colour to record beside mean, variance and halves, by comma: third-moment, least, greatest,
    /// four-parts, position, box-cox:λ:floor [default: none]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', conflicts_with = "parts")]
    pub statistics: Vec<Statistic>,
    /// Longest path, in edges from the eye to a light: 2 is direct light
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub depth: u32,
    /// Light the scene by this OpenEXR image in latitude and longitude instead of its own sky; the first row is
    /// straight up
    #[arg(long, value_name = "FILE")]
    pub environment: Option<PathBuf>,
    /// Film filter: `box` over the pixel, or `point` through its centre
    #[arg(long, default_value = "box", value_parser = ["box", "point"])]
    pub filter: String,
    /// Sampling of the frame: `independent`, or `low-discrepancy` with an own randomisation for each half buffer
    #[arg(long, default_value = "independent", value_parser = ["independent", "low-discrepancy"], conflicts_with = "parts")]
    pub sampling: String,
    /// Where features are taken: at the `first` hit, or `through-specular` surfaces at the first hit behind mirrors and
    /// glass
    #[arg(long, default_value = "first", value_parser = ["first", "through-specular"])]
    pub feature_hit: String,
    /// Index of the first sample: renders a range of a longer run with the same random seed
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with = "parts")]
    pub start: u32,
    /// Render a reference instead: this many independently randomised low-discrepancy parts
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(8..=1024))]
    pub parts: Option<u32>,
    #[command(flatten)]
    pub shot: Shot,
    /// Frames of the sequence to render, from --frame on, each with random numbers of its own; more than one makes
    /// files like STEM.0007.exr
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Random seed of the photon maps; another one gives other maps [default: 0]
    #[arg(long, value_name = "S")]
    pub map_seed: Option<u64>,
    /// Threads [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Most memory that images may take, in GiB [default: what is free, at most 64]
    #[arg(long, value_name = "GIB", value_parser = crate::memory::parse_gib)]
    pub max_memory: Option<f64>,
    /// No progress
    #[arg(long, short)]
    pub quiet: bool,
}

/// `noisefloor denoise`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor denoise frame.exr --method virtual-flash -o out.exr\n  \
    noisefloor denoise frame.exr --method virtual-flash --set guide=color --set steps=1 -o out.exr --json\n  \
    noisefloor denoise frame.exr --method \"guarded(geometric-corrected)\" -o out.exr\n  \
    noisefloor denoise frame.exr --method virtual-flash --diagnostics --probe 120,80 -o out.exr\n  \
    noisefloor denoise frame.exr --method rdfc --exposure 1.5 -o out.png     a picture to look at\n  \
    noisefloor denoise frame.exr --method rdfc -o - > out.exr                messages go to standard error")]
pub struct Denoise {
    /// Noisy frame
    pub frame: PathBuf,
    /// Method id; see `noisefloor methods`
    #[arg(long, short, value_name = "ID")]
    pub method: String,
    /// Override a parameter; repeatable
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// File to write: OpenEXR (.exr, a device, a pipe, or - for standard output), or a picture (.png)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Exposure of a .png in stops, before the sRGB curve [default: 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = stops)]
    pub exposure: Option<f32>,
    /// Also write the method's diagnostic images, as OUTPUT-STEM.NAME.exr
    #[arg(long)]
    pub diagnostics: bool,
    /// Pixel to look at in diagnostics [default: the middle]
    #[arg(long, value_name = "X,Y", requires = "diagnostics")]
    pub probe: Option<Pixel>,
    /// Samples per pixel of a frame that does not say it itself
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub spp: Option<u32>,
    /// Threads [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Most memory that the decoded frame may take, in GiB [default: 4, and 256 times the size of its file where that is
    /// more than half a GiB]
    #[arg(long, value_name = "GIB", value_parser = crate::memory::parse_gib)]
    pub max_memory: Option<f64>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// `noisefloor compare`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor compare out.exr reference.exr\n  \
    noisefloor compare noisy.exr one.exr two.exr reference.exr    several images beside each other\n  \
    noisefloor compare out.exr reference.exr --maps maps          where the error is, as maps/out.error.png\n  \
    noisefloor compare out.exr reference.exr --json")]
pub struct Compare {
    /// Images or frames under test
    #[arg(required = true, value_name = "IMAGE")]
    pub images: Vec<PathBuf>,
    /// Reference; its own noise is taken out where it carries halves or a variance
    pub reference: PathBuf,
    /// Measure this too, beside what is always measured; may be given several times
    #[arg(long = "metric", value_name = "ID", value_parser = noisefloor_metrics::metric)]
    pub metrics: Vec<&'static Metric>,
    /// Write maps of the relative error into this folder, as IMAGE-STEM.error.png: viridis, one range for all images
    #[arg(long, value_name = "DIR")]
    pub maps: Option<PathBuf>,
    /// Relative error at the bright end of the maps [default: the 99th percentile over all images]
    #[arg(long, value_name = "ERROR", requires = "maps", value_parser = positive)]
    pub map_range: Option<f32>,
    /// Print one JSON object instead of text; for several images an array of them
    #[arg(long)]
    pub json: bool,
}

/// `noisefloor convert`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor convert out.exr out.png\n  \
    noisefloor convert out.exr out.png --exposure 2.5    2.5 stops brighter\n  \
    noisefloor convert frame.exr color.exr               the colour of a frame alone\n\n\
    A picture is the colour times 2^STOPS, clamped to 0 … 1, through the sRGB curve, 8 bits; pixels that are not finite \
    are magenta and counted.")]
pub struct Convert {
    /// OpenEXR image or frame
    pub input: PathBuf,
    /// File to write: a picture (.png), or OpenEXR of the colour alone (.exr, or - for standard output)
    pub output: PathBuf,
    /// Exposure of a .png in stops, before the sRGB curve [default: 0]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true, value_parser = stops)]
    pub exposure: Option<f32>,
}

/// `noisefloor report`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor report noisefloor-results/quick\n  \
    noisefloor report noisefloor-results/quick --recompute\n  \
    noisefloor report /mnt/read-only/quick --out quick-report")]
pub struct Report {
    /// Folder of a study that was run
    pub dir: PathBuf,
    /// Folder for summary and report instead of that one, which is then only read
    #[arg(long, value_name = "OTHER")]
    pub out: Option<PathBuf>,
    /// Compute the metrics again from the kept images instead of taking them from the records
    #[arg(long)]
    pub recompute: bool,
    /// Largest size of the images embedded in the page, in MB
    #[arg(long, value_name = "MB", default_value_t = 10.0)]
    pub viewer_budget: f64,
}

/// `noisefloor export`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor export noisefloor-results/quick                  into noisefloor-results/quick/export\n  \
    noisefloor export reports/rdfc-fig06 --out paper/figures    from a recorded study\n\n\
    tables/ID.csv has numbers without rounding, with the ends of their intervals in columns of their own; .json the same with \
    the texts of the page; .tex a booktabs tabular; .md a pipe table. charts/ID.svg, .png and .pdf are the plots of the page."
)]
pub struct Export {
    /// Folder of a study that was run, or a recording
    pub dir: PathBuf,
    /// Folder to write `tables` and `charts` into [default: DIR/export]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// `noisefloor record`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor record noisefloor-results/quick reports/quick\n  \
    noisefloor record reports/quick reports/quick            README and plots again\n  \
    noisefloor report reports/quick --out /tmp/quick         summary and page from a recording\n\n\
    TO gets study.json, context.json, levels.jsonl.gz and results.jsonl.gz, from which `noisefloor report` makes summary and page; images are \
    not kept. In TO/README.md everything between `<!-- noisefloor:table KIND key=value -->` and `<!-- /noisefloor -->` is made \
    anew, and the plots that it shows as `plots/NAME.svg` are written. Kinds: answers, levels, methods, coverage, bounds, \
    slopes, estimates, paper, equal-time, flicker, absent, machine. Keys: metric=ID, show=value|ratio|multiplier, \
    scenes=\"A; B\", spp=\"4; 16\", rows=\"A; B\". A block `noisefloor:panel scenes=\"A; B\" spp=16 show=\"mc; rdfc; reference\" \
    shrink=2` makes panel.png from the images of DIR. Without a README one is begun.")]
pub struct Record {
    /// Folder of a study that was run, or a recording
    pub dir: PathBuf,
    /// Folder of the recording
    pub to: PathBuf,
}

/// `noisefloor methods`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor methods\n  noisefloor methods rdfc      one method with its page\n  \
    noisefloor methods --json\n  noisefloor methods --bibtex > methods.bib"
)]
pub struct List {
    /// One method: everything about it, with its page
    pub id: Option<String>,
    /// Print a JSON array of objects with `id`, or one object for one method
    #[arg(long)]
    pub json: bool,
    /// Print the sources of all methods, or that of one, as BibTeX in UTF-8
    #[arg(long, conflicts_with = "json")]
    pub bibtex: bool,
}

/// `noisefloor check`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  noisefloor check rdfc\n  noisefloor check \"guarded(mc)\" --set guard_level=0.95\n  \
    noisefloor check command --set run=\"my-denoiser {color.pfm} {output.pfm}\"    a program of your own\n  \
    noisefloor check --all --json\n\n\
    A line for each recipe: `pass`; `refused`, all of its frames, as it may; `declared`, not to be kept; `-`, nothing \
    to ask; or `FAIL` with what broke. The frames are small and made on the spot."
)]
pub struct Check {
    /// Method id; see `noisefloor methods`
    #[arg(required_unless_present = "all")]
    pub method: Option<String>,
    /// Override a parameter; repeatable
    #[arg(long = "set", value_name = "NAME=VALUE", conflicts_with = "all")]
    pub set: Vec<String>,
    /// Every registered method at its defaults
    #[arg(long, conflicts_with = "method")]
    pub all: bool,
    /// Print a JSON array of methods, each with its recipes
    #[arg(long)]
    pub json: bool,
}

/// `noisefloor scenes`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  noisefloor scenes\n  noisefloor scenes --json\n  \
    noisefloor scenes --sheet scenes.png\n  \
    noisefloor scenes --sheet scenes.png --size 320x240 --spp 16 --reference-spp 4096")]
pub struct Scenes {
    /// Print a JSON array of objects with `id`
    #[arg(long)]
    pub json: bool,
    /// Render every scene and write a contact sheet: the noisy frame beside its reference
    #[arg(long, value_name = "FILE.png", conflicts_with = "json")]
    pub sheet: Option<PathBuf>,
    /// Size of a picture on the sheet
    #[arg(long, value_name = "WxH", default_value = "160x120", requires = "sheet")]
    pub size: Size,
    /// Samples per pixel of the noisy frames
    #[arg(long, value_name = "N", default_value_t = 64, requires = "sheet", value_parser = clap::value_parser!(u32).range(1..=131072))]
    pub spp: u32,
    /// Samples per pixel of the references, a multiple of 8
    #[arg(long, value_name = "N", default_value_t = 1024, requires = "sheet", value_parser = clap::value_parser!(u32).range(8..=524288))]
    pub reference_spp: u32,
    /// Threads [default: all]
    #[arg(long, value_name = "N", requires = "sheet", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// No progress
    #[arg(long, short)]
    pub quiet: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn arguments_are_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn every_verb_shows_examples() {
        for verb in Args::command().get_subcommands() {
            let help = verb.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(help.contains("noisefloor "), "{} has no example", verb.get_name());
        }
    }
}
