//! `noisefloor run`.

mod fit;
mod watch;

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use noisefloor_harness::{StudyRun, memory_estimate, study_of_folder};
use noisefloor_io::{ReadOptions, read_frame, scan_scenes};
use noisefloor_report::ReportFiles;
use noisefloor_study::summary::Summary;
use noisefloor_study::{Maps, MethodRow, Study};

use crate::args::{Run, Size};
use crate::context::{Context, default_cache, use_threads};
use crate::exit::Exit;
use crate::interrupt;
use crate::out::{Out, note, say};
use crate::report::{fail_on_faults, unfinished_or_done};
use crate::run::fit::{Kind, check_options, check_study};
use crate::run::watch::Watcher;
use crate::shot::{is_gltf, shot, shot_command};
use crate::table::{paper_table, summary_table};

pub fn run(context: &Context, args: &Run) -> anyhow::Result<Exit> {
    use_threads(args.threads)?;
    let (study, kind) = find_study(context, args)?;
    let out = args.out.clone().unwrap_or_else(|| default_out(&study, args.size));
    check_study(args, kind, &study, &out)?;
    let cache = args.cache.clone().unwrap_or_else(default_cache);
    let size = args.size.map(|s| (s.width, s.height));
    if let Some(largest) = memory_estimate(&study, &context.registry, size) {
        largest.check(crate::memory::allowed(args.max_memory))?;
    }
    let watcher = Watcher::new(args.quiet);
    let request = StudyRun {
        study: &study,
        registry: &context.registry,
        out_dir: &out,
        cache_dir: &cache,
        size,
        again: &args.again,
        command: command(args),
        simd: noisefloor_kernels::InstructionSet::in_use().name().to_owned(),
        laboratory: noisefloor_harness::Laboratory::default(),
        observer: &watcher,
    };
    interrupt::catch()?;
    let ended = noisefloor_harness::run(&request);
    watcher.finish();
    let summary = ended.map_err(|error| watcher.explain(error, &out))?;
    let files = noisefloor_report::write_report(&out, &noisefloor_questions::document(&summary))?;
    let shown = show(args, &summary, &files);
    fail_on_violations(&summary)?;
    fail_on_faults(&summary)?;
    shown?;
    Ok(unfinished_or_done(&summary))
}

/// Where results go unless somebody says otherwise.
pub(crate) fn default_out(study: &Study, size: Option<Size>) -> PathBuf {
    let size = size.map_or(String::new(), |s| format!("-{}x{}", s.width, s.height));
    Path::new("noisefloor-results").join(format!("{}{size}", study.name))
}

/// The tables, or with `--quiet` what must not be missed.
fn show(args: &Run, summary: &Summary, files: &ReportFiles) -> anyhow::Result<()> {
    if !args.quiet {
        Out::Stdout.text(summary_table(summary))?;
        let paper = paper_table(summary);
        if !paper.is_empty() {
            Out::Stdout.text(format_args!("\n{paper}"))?;
        }
        say!(Out::Stdout, "\nreport: {}", files.index.display())?;
    } else if let Some(first) = summary.findings.first() {
        note!(
            "noisefloor: {} about the inputs; the first: {first}",
            plural(summary.findings.len(), "finding")
        );
    }
    Ok(())
}

fn plural(count: usize, word: &str) -> String {
    format!("{count} {word}{}", if count == 1 { "" } else { "s" })
}

/// The certain half of a proven bound is an invariant: if it broke, the run has failed whatever else it shows.
fn fail_on_violations(summary: &Summary) -> anyhow::Result<()> {
    let violations = noisefloor_questions::violations(summary);
    if violations.is_empty() {
        return Ok(());
    }
    bail!("an enclosure that must always hold was violated:\n  {}", violations.join("\n  "))
}

pub(crate) fn find_study(context: &Context, args: &Run) -> anyhow::Result<(Study, Kind)> {
    let name = args.study.as_deref().unwrap_or("quick");
    let path = Path::new(name);
    let of_scene = is_gltf(path) && path.is_file()
        || noisefloor_scenes::find(name).is_ok() && Study::builtin(name).is_err() && !path.exists();
    let kind = match () {
        () if of_scene => Kind::Scene,
        () if path.is_dir() => Kind::Folder,
        () => Kind::Study,
    };
    // First whether there is such a thing at all.
    let study = if of_scene {
        check_options(args, kind, name)?;
        let fresh = args.maps.as_deref() == Some(Maps::Fresh.name());
        let shot = shot(&args.shot, if fresh { Maps::Fresh } else { Maps::Fixed })?;
        // A renderer can give everything that a method asks for.
        Study::for_scene(name, shot, MethodRow::for_all(&context.registry, |_| true))?
    } else if kind == Kind::Folder {
        check_options(args, kind, name)?;
        folder_rows(context, path, args)
            .and_then(|rows| Ok(study_of_folder(path, args.spp, rows)?))
            .with_context(|| format!("reading the frames in {}", path.display()))?
    } else if path.is_file() {
        Study::from_file(path)?
    } else if name.ends_with(".toml") || name.contains(std::path::MAIN_SEPARATOR) {
        bail!("there is no file or folder {name}")
    } else {
        Study::builtin(name)?
    };
    check_options(args, kind, name)?;
    Ok((study, kind))
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
    if args.maps.as_deref() == Some(Maps::Fresh.name()) {
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

/// Rows for a folder of somebody else's frames: what the first frame has decides which methods run how.
fn folder_rows(context: &Context, folder: &Path, args: &Run) -> anyhow::Result<Vec<MethodRow>> {
    let options = ReadOptions { spp: args.spp, ..ReadOptions::default() };
    let folders = scan_scenes(folder, &options)?;
    let first = folders.iter().find_map(|folder| folder.frames.first());
    // A frame that cannot be read or contradicts itself is told with its reason when its cells come.
    let mut frame = first.and_then(|first| read_frame(&first.path, &options).ok());
    frame.take_if(|frame| frame.sanitize().is_err());
    Ok(MethodRow::for_all(&context.registry, |need| frame.as_ref().is_some_and(|frame| need.is_met(frame))))
}
