//! `noisefloor run`.

use std::path::Path;

use anyhow::{Context as _, bail};
use indicatif::ProgressBar;
use noisefloor_harness::record::{Outcome, Record};
use noisefloor_harness::summary::Summary;
use noisefloor_harness::{HarnessError, Maps, MethodRow, Observer, Shot, Stage, Study, StudyRun, Workload};

use crate::args::Run;
use crate::context::{Context, default_cache, use_threads};
use crate::progress::bar;
use crate::shot::{is_gltf, shot, shot_command};
use crate::table::{paper_table, summary_table};

pub fn run(context: &Context, args: &Run) -> anyhow::Result<()> {
    use_threads(args.threads)?;
    let study = find_study(args)?;
    let out = args.out.clone().unwrap_or_else(|| {
        let size = args.size.map_or(String::new(), |s| format!("-{}x{}", s.width, s.height));
        Path::new("noisefloor-results").join(format!("{}{size}", study.name))
    });
    let cache = args.cache.clone().unwrap_or_else(default_cache);
    let watcher = Watcher::new(args.quiet);
    let request = StudyRun {
        study: &study,
        registry: &context.registry,
        out_dir: &out,
        cache_dir: &cache,
        size: args.size.map(|s| (s.width, s.height)),
        command: command(args),
        simd: noisefloor_kernels::Level::best().name().to_owned(),
        observer: &watcher,
    };
    let ended = noisefloor_harness::run(&request);
    watcher.bar.finish_and_clear();
    let summary = ended.map_err(|error| explain(error, &out))?;
    let files = noisefloor_report::write_report(&out, &summary)?;
    if !args.quiet {
        print!("{}", summary_table(&summary));
        let paper = paper_table(&summary);
        if !paper.is_empty() {
            print!("\n{paper}");
        }
        println!("\nreport: {}", files.index.display());
    } else if let Some(first) = summary.findings.first() {
        eprintln!(
            "noisefloor: {} about the inputs; the first: {first}",
            plural(summary.findings.len(), "finding")
        );
    }
    fail_on_violations(&summary)
}

fn plural(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

/// The certain half of a proven bound is an invariant: if it broke, the run has failed whatever else it shows.
fn fail_on_violations(summary: &Summary) -> anyhow::Result<()> {
    let violations = noisefloor_harness::violations(summary);
    if violations.is_empty() {
        return Ok(());
    }
    bail!("an enclosure that must always hold was violated:\n  {}", violations.join("\n  "))
}

fn explain(error: HarnessError, out: &Path) -> anyhow::Error {
    anyhow::Error::new(error).context(format!(
        "the run stopped; finished cells are kept in {} and a new run continues there",
        out.display()
    ))
}

fn find_study(args: &Run) -> anyhow::Result<Study> {
    let name = args.study.as_deref().unwrap_or("quick");
    let path = Path::new(name);
    let maps = if args.maps == Maps::Fresh.name() { Maps::Fresh } else { Maps::Fixed };
    let shot = shot(&args.shot, maps)?;
    let of_scene = is_gltf(path) && path.is_file()
        || noisefloor_scenes::find(name).is_ok() && Study::builtin(name).is_err() && !path.exists();
    if shot != Shot::default() && !of_scene {
        bail!(
            "--frame, --orbit, --integrator, --photons and --maps are for a scene; `{name}` is none: a study file says them itself"
        );
    }
    let study = if of_scene {
        Study::for_scene(name, shot, scene_rows())?
    } else if path.is_dir() {
        Study::for_folder(path, args.spp, folder_rows())
            .with_context(|| format!("reading the frames in {}", path.display()))?
    } else if path.is_file() {
        Study::from_file(path)?
    } else if name.ends_with(".toml") || name.contains(std::path::MAIN_SEPARATOR) {
        bail!("there is no file or folder {name}")
    } else {
        Study::builtin(name)?
    };
    Ok(study)
}

/// The command line as a person would type it again.
fn command(args: &Run) -> String {
    let mut text = String::from("noisefloor run");
    // A path of this machine says nothing to a reader elsewhere: its last part does.
    let last = |p: &Path| p.file_name().unwrap_or(p.as_os_str()).to_string_lossy().into_owned();
    let study = args.study.as_deref().unwrap_or("quick");
    text.push(' ');
    text.push_str(&last(Path::new(study)));
    if let Some(size) = args.size {
        text.push_str(&format!(" --size {}x{}", size.width, size.height));
    }
    text.push_str(&shot_command(&args.shot));
    if args.maps == Maps::Fresh.name() {
        text.push_str(" --maps fresh");
    }
    if let Some(threads) = args.threads {
        text.push_str(&format!(" --threads {threads}"));
    }
    if let Some(spp) = args.spp {
        text.push_str(&format!(" --spp {spp}"));
    }
    text
}

/// Draws one bar over everything: rendered samples and finished cells, in one unit.
struct Watcher {
    bar: ProgressBar,
    quiet: bool,
}

/// A cell counts as this many camera samples in the bar: about what it costs on small images.
const SAMPLES_PER_CELL: u64 = 300_000;

impl Watcher {
    fn new(quiet: bool) -> Self {
        Self { bar: bar(0, quiet), quiet }
    }
}

impl Observer for Watcher {
    fn planned(&self, work: &Workload) {
        self.bar.set_length(work.samples + work.cells * SAMPLES_PER_CELL);
        self.bar.reset();
        if work.kept > 0 && !self.quiet {
            self.bar.println(format!("continuing: {} cells are finished already", work.kept));
        }
    }

    fn stage(&self, stage: &Stage) {
        let text = match stage {
            Stage::Reference { scene, part, parts } => {
                format!("{scene}: reference, part {} of {parts}", part + 1)
            }
            Stage::Frame { scene, spp, replicate } => {
                format!("{scene}: {spp} samples per pixel, replicate {replicate}")
            }
            Stage::Denoise { scene, spp, label, .. } => format!("{scene}: {label} at {spp}"),
            Stage::Analysis => "analysis".to_owned(),
            _ => String::new(),
        };
        self.bar.set_message(text);
    }

    fn rendered(&self, samples: u64) {
        self.bar.inc(samples);
    }

    fn cell(&self, _: &Record, _: &Outcome) {
        self.bar.inc(SAMPLES_PER_CELL);
    }

    fn warning(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| eprintln!("warning: {text}"));
        }
    }
}

/// Rows for a scene that is rendered here.
fn scene_rows() -> Vec<MethodRow> {
    [
        "mc",
        "virtual-flash",
        "rdfc",
        "geometric-corrected",
        "guarded(virtual-flash)",
        "guarded(geometric-corrected)",
    ]
    .map(MethodRow::new)
    .into()
}

/// Rows for a folder of somebody else's frames: no flash image, no material ids.
fn folder_rows() -> Vec<MethodRow> {
    let row = |id: &str| MethodRow::new(id);
    let color = |id: &str, label: &str| row(id).set("guide", "color").label(label);
    let none = |id: &str, label: &str| row(id).set("guide", "none").label(label);
    let no_ids = |id: &str, label: &str| row(id).set("material_ids", false).label(label);
    vec![
        row("mc"),
        row("virtual-flash"),
        color("virtual-flash", "virtual-flash guide=color"),
        color("guarded(virtual-flash)", "guarded(virtual-flash) guide=color"),
        none("virtual-flash", "virtual-flash guide=none"),
        none("guarded(virtual-flash)", "guarded(virtual-flash) guide=none"),
        row("rdfc"),
        no_ids("geometric-corrected", "geometric-corrected ids=off"),
        no_ids("guarded(geometric-corrected)", "guarded(geometric-corrected) ids=off"),
    ]
}
