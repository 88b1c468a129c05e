//! `noisefloor denoise`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, bail};
use noisefloor_denoiser::{Diagnostics, Input, Output};
use noisefloor_frame::Image;
use noisefloor_io::{ReadOptions, read_frame, write_image};
use serde_json::{Map, Value, json};

use crate::args::Denoise;
use crate::context::{Context, measured_peak_memory, use_threads};

pub fn run(context: &Context, args: &Denoise) -> anyhow::Result<()> {
    use_threads(args.threads)?;
    let overrides = overrides(&args.set)?;
    let method = context.registry.build(&args.method, &overrides)?;
    let mut frame = read_frame(&args.frame, &ReadOptions { spp: args.spp })?;
    // Refuse on what the file gives, before hygiene and before any work.
    Input::new(&frame).check(&method.denoiser.card())?;
    if let Some(probe) = args.probe
        && (probe.x >= frame.width() || probe.y >= frame.height())
    {
        bail!("--probe {},{} lies outside the {}×{} frame", probe.x, probe.y, frame.width(), frame.height());
    }
    let hygiene = frame.sanitize();
    let input = Input::new(&frame);
    let start = Instant::now();
    let output = method.denoiser.denoise(&input)?;
    let seconds = start.elapsed().as_secs_f64();
    let peak = measured_peak_memory();

    write_image(&args.output, &output.image, &attributes(args, &method.params))?;
    let mut written = Vec::new();
    if args.diagnostics {
        let probe = args.probe.map(|p| (p.x, p.y));
        let with = method.denoiser.denoise(&input.with_diagnostics(Diagnostics::On { probe }))?;
        for (name, image) in &with.diagnostics {
            written.push((name.clone(), write_diagnostic(&args.output, name, image)?));
        }
    }

    if args.json {
        let stages: Map<String, Value> =
            output.stages.iter().map(|s| (s.name.clone(), s.seconds.into())).collect();
        let object = json!({
            "method": method.id,
            "params": method.params,
            "output": args.output,
            "seconds": {"denoise": seconds, "stages": stages},
            "threads": rayon::current_num_threads(),
            "peak_memory_bytes": peak,
            "diagnostics": written.iter().map(|(name, path)| json!({"name": name, "path": path})).collect::<Vec<_>>(),
            "figures": output.figures.iter().cloned().collect::<BTreeMap<_, _>>(),
            "input": hygiene,
            "non_finite_output": output.image.count_non_finite(),
        });
        println!("{}", serde_json::to_string_pretty(&object)?);
    } else {
        tell(args, &output, seconds, peak, &written, hygiene.invalid_pixels);
    }
    Ok(())
}

fn tell(
    args: &Denoise,
    output: &Output,
    seconds: f64,
    peak: Option<u64>,
    written: &[(String, PathBuf)],
    invalid: usize,
) {
    println!("{}: {:.1} ms on {} threads", args.method, seconds * 1e3, rayon::current_num_threads());
    for stage in &output.stages {
        println!("  {:24} {:9.1} ms", stage.name, stage.seconds * 1e3);
    }
    if let Some(bytes) = peak {
        println!("  peak memory {:.0} MiB", bytes as f64 / f64::from(1 << 20));
    }
    if invalid > 0 {
        println!("  {invalid} input pixels were not finite and were filled from their neighbours");
    }
    println!("wrote {}", args.output.display());
    for (_, path) in written {
        println!("wrote {}", path.display());
    }
}

/// `name=value` pairs; a value that is no JSON is taken as text.
fn overrides(pairs: &[String]) -> anyhow::Result<Map<String, Value>> {
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

fn write_diagnostic(output: &Path, name: &str, image: &Image) -> anyhow::Result<PathBuf> {
    let stem = output.file_stem().map_or_else(|| "output".into(), |s| s.to_string_lossy().into_owned());
    let safe: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let path = output.with_file_name(format!("{stem}.{safe}.exr"));
    write_image(&path, image, &BTreeMap::from([("diagnostic".to_owned(), name.to_owned())]))?;
    Ok(path)
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
}
