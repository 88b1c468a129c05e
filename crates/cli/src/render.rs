//! `noisefloor render`.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::bail;
use glam::Vec3;
use noisefloor_denoiser::Need;
use noisefloor_frame::{FeatureId, Frame, PixelFilter, Sampling};
use noisefloor_render::{
    FeatureHit, Keep, PhotonMaps, Prepared, Purpose, Quantity, Recorded, RenderRequest, available,
    sequence_seed, usual_seed,
};
use noisefloor_scenes::{EnvironmentMap, Scene, Sky};
use noisefloor_study::{Maps, Shot};
use serde_json::Map;

use crate::args::Render;
use crate::context::{Context, use_threads};
use crate::exit::{Exit, usage};
use crate::out::{note, say};
use crate::output::Output;
use crate::progress::Progress;
use crate::shot::{is_gltf, shot};

pub fn run(context: &Context, args: &Render) -> anyhow::Result<Exit> {
    use_threads(args.threads)?;
    let first = shot(&args.shot, Maps::Fixed)?;
    if args.map_seed.is_some() && first.photons().is_none() {
        return Err(usage("--map-seed needs photon maps: add --integrator photon-mapping or --photons"));
    }
    let output = Output::new(&args.output, args.exposure)?;
    if args.frames > 1 {
        output.need_file("--frames")?;
    }
    let frames = first.frame..first.frame.saturating_add(args.frames);
    let output_of = |frame| match args.frames {
        1 => output.clone(),
        _ => output.beside(numbered(&args.output, frame)),
    };
    let scene = Path::new(&args.scene);
    let (base, read) = find_scene(args)?;
    let inputs = args.environment.iter().chain(&read).map(PathBuf::as_path).chain([scene]);
    for frame in frames.clone() {
        output_of(frame).spare(inputs.clone())?;
    }
    for frame in frames {
        one(context, args, &base, Shot { frame, ..first }, &output_of(frame))?;
    }
    Ok(Exit::Done)
}

/// `STEM.0007.exr` for frame 7.
fn numbered(path: &Path, frame: u32) -> PathBuf {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let end = if extension.is_empty() { String::new() } else { format!(".{extension}") };
    path.with_extension(format!("{frame:04}{end}"))
}

/// Renders and writes one frame.
fn one(context: &Context, args: &Render, base: &Scene, shot: Shot, output: &Output) -> anyhow::Result<()> {
    let mut scene = shot.of(base.clone());
    if let Some(path) = &args.environment {
        scene.sky = Some(Sky::Map(Arc::new(environment(path)?)));
    }
    let mut can = available(&scene);
    let settings = shot.photons();
    if settings.is_some() {
        can.push(Quantity::Caustics);
    }
    let record = match &args.record {
        None => useful(context, &can),
        Some(names) => named(names, &can)?,
    };
    let prepared = Prepared::new(&scene)?;
    let maps = settings
        .map(|s| PhotonMaps::new(&prepared, &s, sequence_seed(args.map_seed.unwrap_or(0), shot.frame)))
        .transpose()?;
    if let Some(maps) = maps.as_ref().filter(|_| !args.quiet) {
        let [caustic, global] = maps.len();
        say!(
            output.messages(),
            "photon maps: {caustic} caustic and {global} global photons in {:.1} s",
            maps.seconds()
        )?;
    }
    let mut request = RenderRequest::new(&prepared, args.size.width, args.size.height, args.spp);
    request.max_memory = crate::memory::allowed(args.max_memory);
    let purpose = match args.parts {
        Some(_) => Purpose::Reference { spp: args.spp },
        None => Purpose::Frame { spp: args.spp },
    };
    request.seed = sequence_seed(args.seed.unwrap_or_else(|| usual_seed(purpose)), shot.frame);
    request.depth = args.depth;
    request.filter = PixelFilter::from_name(&args.filter).unwrap_or(PixelFilter::Box);
    request.record = record;
    request.optional.statistics.clone_from(&args.statistics);
    request.integrator = shot.integrator;
    request.photons = maps.as_ref();
    request.sample_start = args.start;
    if args.feature_hit == FeatureHit::ThroughSpecular.name() {
        request.feature_hit = FeatureHit::ThroughSpecular;
    }
    if args.sampling == "low-discrepancy" {
        request.sampling = Sampling::LowDiscrepancy;
    }

    let pixels = (args.size.width * args.size.height) as u64;
    let progress = Progress::new(pixels * u64::from(args.parts.unwrap_or(1)), args.quiet);
    progress.stage("", format!("{} at {} samples per pixel", scene.id, args.spp));
    let advance = |finished: usize| {
        progress.advance(finished as u64);
        ControlFlow::Continue(())
    };
    let mut extra = BTreeMap::new();
    if let Some(path) = &args.environment {
        let name = path.file_name().unwrap_or(path.as_os_str());
        extra.insert("environment".to_owned(), name.to_string_lossy().into_owned());
    }
    if shot.frame > 0 {
        extra.insert("sequence_frame".to_owned(), shot.frame.to_string());
    }
    let (seconds, written) = match args.parts {
        Some(parts) => {
            request.sampling = Sampling::LowDiscrepancy;
            let mut reference = noisefloor_render::render_reference(&request, parts, &advance)?;
            reference.frame.provenance.extra.extend(extra);
            tell_darkness(&reference.frame);
            (reference.frame.provenance.render_seconds, output.reference(&reference)?)
        }
        None => {
            let mut frame = noisefloor_render::render(&request, &advance)?;
            frame.provenance.extra.extend(extra);
            tell_darkness(&frame);
            (frame.provenance.render_seconds, output.frame(&frame)?)
        }
    };
    progress.finish();
    if !args.quiet {
        let rate = seconds.filter(|s| *s > 0.0).map_or(String::new(), |s| {
            format!(" in {s:.1} s, {:.2} million samples/s", (pixels * u64::from(args.spp)) as f64 / s / 1e6)
        });
        written.tell(format_args!(", seed {}{rate}", request.seed))?;
    }
    Ok(())
}

/// Notices about what makes a picture dark: no light at all, and samples that count as black.
fn tell_darkness(frame: &Frame) {
    if let Some(count) = frame.provenance.extra.get("non_finite_samples") {
        note!("notice: {count} samples are not finite and count as black");
    }
    if frame.color.mean.data().iter().all(|v| *v == 0.0) {
        note!("notice: the picture is black: no light reaches the camera");
    }
}

/// An image as light from infinitely far away.
fn environment(path: &Path) -> anyhow::Result<EnvironmentMap> {
    let image = noisefloor_io::read_image(path)?;
    let plane = |c: usize| image.plane(if image.channels() >= 3 { c } else { 0 });
    let texels = plane(0).iter().zip(plane(1)).zip(plane(2));
    Ok(EnvironmentMap {
        width: image.width(),
        height: image.height(),
        texels: texels.map(|((r, g), b)| Vec3::new(*r, *g, *b)).collect(),
    })
}

/// A built-in scene, or one from a file with all files that were read for it; notices go to standard error.
fn find_scene(args: &Render) -> anyhow::Result<(Scene, Vec<PathBuf>)> {
    let path = Path::new(&args.scene);
    if !is_gltf(path) && !path.is_file() {
        return Ok(((noisefloor_scenes::find(&args.scene)?.build)(), Vec::new()));
    }
    let loaded = noisefloor_gltf::load(path)?;
    for notice in &loaded.notices {
        note!("notice: {notice}");
    }
    Ok((loaded.scene, loaded.files))
}

/// Everything that some registered method needs or uses, as far as the scene can give it.
fn useful(context: &Context, can: &[Quantity]) -> Recorded {
    let mut wanted = BTreeSet::new();
    for factory in context.registry.factories() {
        if let Ok(method) = factory.build(&Map::new()) {
            let card = method.card();
            wanted.extend(card.needs.iter().chain(&card.uses).filter_map(quantity));
        }
    }
    // Cheap, and asked for by nearly every published method.
    wanted.extend([Quantity::Albedo, Quantity::Normal, Quantity::Depth, Quantity::Visibility]);
    Recorded::Exactly(can.iter().filter(|q| wanted.contains(q)).map(|q| (*q, Keep::ALL)).collect())
}

fn quantity(need: &Need) -> Option<Quantity> {
    match need {
        Need::Flash | Need::FlashVariance => Some(Quantity::Flash),
        Need::Feature(id) | Need::FeatureVariance(id) => match id {
            FeatureId::Extra(_) => None,
            known => Quantity::ALL.into_iter().find(|q| q.feature().as_ref() == Some(known)),
        },
        _ => None,
    }
}

fn named(names: &[String], can: &[Quantity]) -> anyhow::Result<Recorded> {
    let list = || can.iter().map(|q| q.name()).collect::<Vec<_>>().join(", ");
    let mut chosen = BTreeMap::new();
    for name in names.iter().map(|n| n.trim()).filter(|n| !matches!(*n, "none" | "color" | "colour")) {
        match Quantity::from_name(name).filter(|q| can.contains(q)) {
            Some(quantity) => drop(chosen.insert(quantity, Keep::ALL)),
            None => bail!("--record {name}: this scene can give {}, and always the colour", list()),
        }
    }
    Ok(Recorded::Exactly(chosen))
}
