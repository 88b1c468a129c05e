//! `noisefloor scenes`.

use std::io::ErrorKind;
use std::path::Path;
use std::time::Instant;

use noisefloor_frame::Image;
use noisefloor_io::{Destination, IoError};
use noisefloor_metrics::tone_map;
use noisefloor_render::{
    Integrator, PhotonMaps, PhotonSettings, Prepared, Recorded, RenderRequest, Silent, render,
    render_reference,
};
use noisefloor_report::{SheetEntry, contact_sheet};
use serde_json::{Value, json};

use crate::args::Scenes;
use crate::context::use_threads;
use crate::exit::{Exit, usage};
use crate::out::{Out, say};
use crate::progress::Progress;

/// Pairs beside each other on a contact sheet.
const COLUMNS: usize = 3;

pub fn run(args: &Scenes) -> anyhow::Result<Exit> {
    if let Some(path) = &args.sheet {
        return sheet(args, path);
    }
    let mut list = Vec::new();
    for entry in noisefloor_scenes::builtin() {
        let scene = (entry.build)();
        let models = serde_json::to_value(scene.models())?;
        let records: Vec<&str> =
            noisefloor_render::available(&scene).into_iter().map(noisefloor_render::Quantity::name).collect();
        if args.json {
            list.push(json!({
                "id": entry.id, "title": scene.title, "about": entry.about, "models": models,
                "primitives": scene.primitives(), "records": records, "photon_mapped": entry.photon_mapped,
            }));
            continue;
        }
        let on: Vec<&str> = models
            .as_object()
            .into_iter()
            .flatten()
            .filter(|(_, on)| **on == Value::Bool(true))
            .map(|(name, _)| name.as_str())
            .collect();
        say!(Out::Stdout, "{}\n  {}\n  models: {}", entry.id, entry.about, on.join(", ").replace('_', " "))?;
        if entry.photon_mapped {
            say!(Out::Stdout, "  photon mapped in its source: --integrator photon-mapping")?;
        }
        say!(
            Out::Stdout,
            "  records: colour, {}\n  primitives: {}\n",
            records.join(", "),
            scene.primitives()
        )?;
    }
    if args.json {
        say!(Out::Stdout, "{}", serde_json::to_string_pretty(&list)?)?;
    }
    Ok(Exit::Done)
}

/// Renders every scene and writes the contact sheet.
fn sheet(args: &Scenes, path: &Path) -> anyhow::Result<Exit> {
    use_threads(args.threads)?;
    let to = sheet_destination(path)?;
    let out = if to == Destination::Stdout { Out::Stderr } else { Out::Stdout };
    let scenes = noisefloor_scenes::builtin();
    let progress = Progress::new(scenes.len() as u64, args.quiet);
    let mut entries = Vec::new();
    for entry in scenes {
        progress.stage("", entry.id.to_owned());
        let prepared = Prepared::new(&(entry.build)())?;
        let maps = entry.photon_mapped.then(|| PhotonMaps::new(&prepared, &PhotonSettings::default(), 0));
        let maps = maps.transpose()?;
        let noisy = RenderRequest {
            record: Recorded::color_only(),
            photons: maps.as_ref(),
            integrator: match maps {
                Some(_) => Integrator::PhotonMapping,
                None => Integrator::PathTracing,
            },
            max_memory: crate::memory::allowed(None),
            ..RenderRequest::new(&prepared, args.size.width, args.size.height, args.spp)
        };
        let start = Instant::now();
        let frame = render(&noisy, &Silent)?;
        let seconds = start.elapsed().as_secs_f64();
        // Another random seed: a frame and its reference share no samples.
        let reference = RenderRequest { spp: args.reference_spp, seed: 1, ..noisy.clone() };
        let reference = render_reference(&reference, 8, &Silent)?;
        let shown = |image: &Image| tone_map(image, 0.0);
        entries.push(SheetEntry {
            title: format!(
                "{}: {} spp beside {}{}",
                entry.id,
                args.spp,
                args.reference_spp,
                if entry.photon_mapped { ", photon maps" } else { "" }
            ),
            images: [shown(&frame.color.mean), shown(reference.mean())],
        });
        let rate = frame.pixels() as f64 * f64::from(args.spp) / seconds.max(1e-9) / 1e6;
        if !args.quiet {
            progress.suspend(|| say!(out, "{:16} {rate:6.2} million samples/s", entry.id))?;
        }
        progress.advance(1);
    }
    progress.finish();
    let png = contact_sheet(&entries, COLUMNS)?;
    match to.write(|out| out.write_all(&png)) {
        // Whoever reads standard output has seen enough.
        Err(IoError::Write { cause, .. })
            if to == Destination::Stdout && cause.kind() == ErrorKind::BrokenPipe => {}
        other => other?,
    }
    say!(out, "wrote {to}")?;
    Ok(Exit::Done)
}

/// A PNG file, or whatever else is no regular file; refused before any work otherwise.
fn sheet_destination(path: &Path) -> anyhow::Result<Destination> {
    let to = Destination::from_argument(path);
    if let Some(file) = to.file()?
        && ![path, &file].iter().all(|name| name.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")))
    {
        return Err(usage(format!("--sheet {}: the name must end in .png, or be -", path.display())));
    }
    to.check()?;
    Ok(to)
}
