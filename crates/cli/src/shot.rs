//! The options of `render` and `run` that choose a moment of a scene and how its light is carried.

use std::path::Path;

use noisefloor_render::{Integrator, PhotonSettings};
use noisefloor_study::{Maps, Shot};

use crate::args;
use crate::exit::usage;

/// From the command line.
pub fn shot(args: &args::Shot, maps: Maps) -> anyhow::Result<Shot> {
    let integrator = args.integrator.as_deref().and_then(Integrator::from_name).unwrap_or_default();
    let usual = PhotonSettings::default();
    let wanted = args.photons.is_some() || integrator == Integrator::PhotonMapping;
    if !wanted && (args.photon_radius.is_some() || maps == Maps::Fresh) {
        return Err(usage(
            "--photon-radius and --maps need photon maps: add --integrator photon-mapping or --photons",
        ));
    }
    let paths = args.photons.unwrap_or(usual.paths);
    let most = 1 << 26;
    let photons = PhotonSettings {
        paths,
        caustic_paths: args.caustic_photons.unwrap_or(paths.saturating_mul(5).min(most)),
        ..usual
    };
    Ok(Shot {
        frame: args.frame.unwrap_or(0),
        orbit_degrees: args.orbit.unwrap_or(0.0),
        integrator,
        photons: wanted.then(|| photons.scaled(args.photon_radius.unwrap_or(1.0))),
        maps,
    })
}

/// The same as a person would type it again.
pub fn shot_command(args: &args::Shot) -> String {
    let mut text = String::new();
    if let Some(frame) = args.frame {
        text.push_str(&format!(" --frame {frame}"));
    }
    if let Some(orbit) = args.orbit {
        text.push_str(&format!(" --orbit {orbit}"));
    }
    if let Some(integrator) = &args.integrator {
        text.push_str(&format!(" --integrator {integrator}"));
    }
    for (name, value) in [("photons", args.photons), ("caustic-photons", args.caustic_photons)] {
        if let Some(value) = value {
            text.push_str(&format!(" --{name} {value}"));
        }
    }
    if let Some(radius) = args.photon_radius {
        text.push_str(&format!(" --photon-radius {radius}"));
    }
    text
}

/// Whether a path is named like a glTF file.
pub fn is_gltf(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf") || e.eq_ignore_ascii_case("glb"))
}
