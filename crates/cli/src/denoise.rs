//! `noisefloor denoise`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use noisefloor_denoiser::{Diagnostic, Diagnostics, Input};
use noisefloor_io::{ReadOptions, read_info, read_origin, same_file, write_image_at};
use serde_json::{Map, Value, json};

use crate::args::Denoise;
use crate::context::{Context, measured_peak_memory, use_threads};
use crate::exit::{Exit, usage};
use crate::input::{self, Checked};
use crate::out::{Out, note, say};
use crate::output::Output;

pub fn run(context: &Context, args: &Denoise) -> anyhow::Result<Exit> {
    use_threads(args.threads)?;
    let output = Output::new(&args.output, args.exposure)?;
    output.spare([args.frame.as_path()])?;
    if args.diagnostics {
        output.need_file("--diagnostics")?;
        spare_from_diagnostics(&args.output, &args.frame)?;
    }
    if let Some(spp) = args.spp {
        check_spp(&args.frame, spp)?;
    }
    let overrides = overrides(&args.set)?;
    let method = context.registry.build(&args.method, &overrides)?;
    let max_decoded_bytes = args.max_memory.map(|gib| crate::memory::allowed(Some(gib)));
    let options = ReadOptions { spp: args.spp, max_decoded_bytes };
    let Checked { frame, hygiene, findings } = input::read(&args.frame, &options, &method.denoiser.card())?;
    if let Some(probe) = args.probe
        && (probe.x >= frame.width() || probe.y >= frame.height())
    {
        bail!("--probe {},{} lies outside the {}×{} frame", probe.x, probe.y, frame.width(), frame.height());
    }
    let given = Input::new(&frame);
    let start = Instant::now();
    let mut made = method.denoiser.denoise(&given)?;
    let wall = start.elapsed().as_secs_f64();
    // A program outside says what it computed; the rest is around it.
    let own = made.seconds.filter(|own| *own <= wall);
    let seconds = own.unwrap_or(wall);
    let peak = measured_peak_memory();
    let non_finite_output = made.image.count_non_finite();
    input::as_read(&method.id, &mut made.image, &hygiene);

    let window = read_origin(&args.frame)?.window;
    let main = output.image(&made.image, &attributes(args, &method.params), &window)?;
    let mut written = Vec::new();
    if args.diagnostics {
        let probe = args.probe.map(|p| (p.x, p.y));
        let with = method.denoiser.denoise(&given.with_diagnostics(Diagnostics::On { probe }))?;
        let titles: Vec<&str> = with.diagnostics.iter().map(|d| d.name.as_str()).collect();
        let paths = diagnostic_paths(&args.output, &titles);
        for (Diagnostic { name, image, .. }, path) in with.diagnostics.iter().zip(paths) {
            let named = BTreeMap::from([("diagnostic".to_owned(), name.clone())]);
            write_image_at(&path, image, &named, &window)?;
            written.push((name.clone(), path));
        }
    }

    let out = output.messages();
    if args.json {
        let stages: Map<String, Value> =
            made.stages.iter().map(|s| (s.name.clone(), s.seconds.into())).collect();
        let mut object = json!({
            "method": method.id,
            "params": method.params,
            "output": output.path(),
            "seconds": {"denoise": seconds, "stages": stages},
            "threads": rayon::current_num_threads(),
            "peak_memory_bytes": peak,
            "diagnostics": written.iter().map(|(name, path)| json!({"name": name, "path": path})).collect::<Vec<_>>(),
            "figures": made.figures.iter().map(|f| (f.name.as_str(), f.value)).collect::<BTreeMap<_, _>>(),
            "input": hygiene,
            "findings": findings,
            "non_finite_output": non_finite_output,
        });
        if let Some(own) = own {
            object["seconds"]["around"] = (wall - own).into();
        }
        if !made.log.is_empty() {
            object["log"] = made.log.clone().into();
        }
        if let Some(picture) = main.describe() {
            object["picture"] = picture;
        }
        say!(out, "{}", serde_json::to_string_pretty(&object)?)?;
    } else {
        for finding in &findings {
            note!("warning: {finding}");
        }
        tell(out, args, &made, seconds, peak)?;
        main.tell("")?;
        for (_, path) in written {
            say!(out, "wrote {}", path.display())?;
        }
    }
    Ok(Exit::Done)
}

fn tell(
    out: Out,
    args: &Denoise,
    made: &noisefloor_denoiser::Output,
    seconds: f64,
    peak: Option<u64>,
) -> anyhow::Result<()> {
    say!(out, "{}: {:.1} ms on {} threads", args.method, seconds * 1e3, rayon::current_num_threads())?;
    for stage in &made.stages {
        say!(out, "  {:24} {:9.1} ms", stage.name, stage.seconds * 1e3)?;
    }
    if let Some(bytes) = peak {
        say!(out, "  peak memory {:.0} MiB", bytes as f64 / f64::from(1 << 20))?;
    }
    Ok(())
}

/// Refuses a sample count for a frame that says another one itself.
fn check_spp(frame: &Path, given: u32) -> anyhow::Result<()> {
    let info = read_info(frame)?;
    let says = match info.spp {
        _ if info.layers.iter().any(|layer| layer == "samples") => "it for every pixel".to_owned(),
        Some(own) if own != f64::from(given) => own.to_string(),
        _ => return Ok(()),
    };
    Err(usage(format!(
        "--spp {given} is for a frame that does not say its samples per pixel; {} says {says}",
        frame.display()
    )))
}

/// `name=value` pairs; a value that is no JSON is taken as text.
pub fn overrides(pairs: &[String]) -> anyhow::Result<Map<String, Value>> {
    let mut map = Map::new();
    for pair in pairs {
        let (name, value) =
            pair.split_once('=').with_context(|| format!("--set {pair}: expected NAME=VALUE"))?;
        let value = serde_json::from_str(value).unwrap_or_else(|_| Value::String(value.to_owned()));
        map.insert(name.trim().to_owned(), value);
    }
    Ok(map)
}

fn attributes(args: &Denoise, params: &Value) -> BTreeMap<String, String> {
    BTreeMap::from([
        ("method".to_owned(), args.method.clone()),
        ("methodParams".to_owned(), params.to_string()),
        ("input".to_owned(), args.frame.display().to_string()),
    ])
}

/// `STEM.NAME.exr` beside the output for every diagnostic, each a file of its own.
fn diagnostic_paths(output: &Path, names: &[&str]) -> Vec<PathBuf> {
    let mut taken = BTreeSet::new();
    let mut paths = Vec::new();
    for name in names {
        let safe: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let mut unique = safe.clone();
        let mut count = 1;
        while !taken.insert(unique.clone()) {
            count += 1;
            unique = format!("{safe}-{count}");
        }
        paths.push(output.with_file_name(format!("{}.{unique}.exr", stem(output))));
    }
    paths
}

fn stem(output: &Path) -> String {
    output.file_stem().map_or_else(|| "output".into(), |s| s.to_string_lossy().into_owned())
}

/// Refuses an input that a diagnostic could write over. Their names are known only when the work is done, so whatever
/// is named like one counts.
fn spare_from_diagnostics(output: &Path, input: &Path) -> anyhow::Result<()> {
    let folder = match output.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let (start, end) = (format!("{}.", stem(output)), ".exr");
    for entry in std::fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        let inside = name.strip_prefix(&start).and_then(|rest| rest.strip_suffix(end));
        if inside.is_some_and(|inside| !inside.is_empty()) && same_file(&entry.path(), input) {
            return Err(usage(format!(
                "--diagnostics writes files named {start}NAME.exr, and the input {} may be one of them: choose another \
                 output",
                input.display()
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn set_takes_numbers_words_and_flags() {
        let map = overrides(&["a=1.5".into(), "b=color".into(), "c=true".into()]).unwrap();
        assert_eq!(Value::Object(map), json!({"a": 1.5, "b": "color", "c": true}));
        assert!(overrides(&["nothing".into()]).unwrap_err().to_string().contains("NAME=VALUE"));
    }

    #[test]
    fn diagnostics_have_files_of_their_own() {
        let paths = diagnostic_paths(Path::new("a/out.exr"), &["σ²", "µ²", "step 1"]);
        let names = ["out.--.exr", "out.---2.exr", "out.step-1.exr"];
        assert_eq!(paths, names.map(|name| Path::new("a").join(name)));
    }
}
