//! Which options of `run` fit which kind of study: one that would be ignored is refused.

use std::path::Path;

use noisefloor_io::same_file;
use noisefloor_study::{SceneSource, Study};

use crate::args::Run;
use crate::exit::usage;

/// What the word after `run` names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A built-in study or a study file: it says itself what it renders, how and with how many samples.
    Study,
    /// A scene that is rendered here at levels of our choice.
    Scene,
    /// Frames that another program rendered.
    Folder,
}

/// Refuses options that this kind of study has no use for.
///
/// # Errors
/// Names the option, what it is for, and what was given instead.
pub fn check_options(args: &Run, kind: Kind, name: &str) -> anyhow::Result<()> {
    let of_scene = "is for a scene: `noisefloor run SCENE`, see `noisefloor scenes`";
    let shot = &args.shot;
    let options = [
        ("--maps", args.maps.is_some(), kind == Kind::Scene, of_scene),
        ("--frame", shot.frame.is_some(), kind == Kind::Scene, of_scene),
        ("--orbit", shot.orbit.is_some(), kind == Kind::Scene, of_scene),
        ("--integrator", shot.integrator.is_some(), kind == Kind::Scene, of_scene),
        ("--photons", shot.photons.is_some(), kind == Kind::Scene, of_scene),
        ("--caustic-photons", shot.caustic_photons.is_some(), kind == Kind::Scene, of_scene),
        ("--photon-radius", shot.photon_radius.is_some(), kind == Kind::Scene, of_scene),
        ("--size", args.size.is_some(), kind != Kind::Folder, "is for scenes that are rendered here"),
        (
            "--spp",
            args.spp.is_some(),
            kind == Kind::Folder,
            "is for a folder of frames that do not say their samples per pixel themselves",
        ),
    ];
    for (option, given, fits, purpose) in options {
        if given && !fits {
            let what = match kind {
                Kind::Study => "is a study, which says such things in its file",
                Kind::Scene => "is a scene, which is rendered at 4, 16 and 64 samples per pixel",
                Kind::Folder => "is a folder of frames, which are as they are",
            };
            return Err(usage(format!("{option} {purpose}; `{name}` {what}")));
        }
    }
    Ok(())
}

/// Refuses options that this very study has no use for, and an output folder that is one of its inputs.
///
/// # Errors
/// Says why.
pub fn check_study(args: &Run, kind: Kind, study: &Study, out: &Path) -> anyhow::Result<()> {
    let folders = study.scenes.iter().filter_map(|scene| match &scene.source {
        SceneSource::Folder(folder) => Some(folder.as_path()),
        _ => None,
    });
    if args.size.is_some() && folders.clone().count() == study.scenes.len() {
        return Err(usage(format!(
            "--size is for scenes that are rendered here; all scenes of `{}` are folders of frames, which are as they are",
            study.name
        )));
    }
    if let (Some(spp), Kind::Folder) = (args.spp, kind)
        && study.scenes.iter().all(|scene| scene.spp.is_none())
    {
        return Err(usage(format!(
            "--spp {spp} is for frames that do not say their samples per pixel; all frames of `{}` do",
            study.name
        )));
    }
    let given = args.study.as_deref().map(Path::new).filter(|_| kind == Kind::Folder);
    if let Some(folder) = folders.chain(given).find(|folder| same_file(folder, out)) {
        return Err(usage(format!(
            "--out {} is the folder of the frames {}: results go into a folder of their own",
            out.display(),
            folder.display()
        )));
    }
    Ok(())
}
