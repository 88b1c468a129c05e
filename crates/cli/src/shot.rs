//! The options of `render` and `run` that choose a moment of a scene and how its light is carried.

use std::path::Path;

use anyhow::bail;
use noisefloor_harness::{Maps, Shot};
use noisefloor_render::{Integrator, PhotonSettings};

use crate::args;

/// From the command line.
pub fn shot(args: &args::Shot, maps: Maps) -> anyhow::Result<Shot> {
    let integrator = Integrator::from_name(&args.integrator).unwrap_or_default();
    let usual = PhotonSettings::default();
    let wanted = args.photons.is_some() || integrator == Integrator::PhotonMapping;
    let changed = args.photon_radius != 1.0 && args.photon_radius != 0.0;
    if !wanted && (changed || maps == Maps::Fresh) {
        bail!("--photon-radius and --maps need photon maps: add --integrator photon-mapping or --photons");
    }
    let paths = args.photons.unwrap_or(usual.paths);
    let most = 1 << 26;
    let photons = PhotonSettings {
        paths,
        caustic_paths: args.caustic_photons.unwrap_or(paths.saturating_mul(5).min(most)),
        ..usual
    };
    Ok(Shot {
        frame: args.frame,
        orbit_degrees: args.orbit,
        integrator,
        photons: wanted.then(|| photons.scaled(args.photon_radius)),
        maps,
    })
}

/// The same as a person would type it again.
pub fn shot_command(args: &args::Shot) -> String {
    let mut text = String::new();
    if args.frame > 0 {
        text.push_str(&format!(" --frame {}", args.frame));
    }
    if args.orbit != 0.0 {
        text.push_str(&format!(" --orbit {}", args.orbit));
    }
    if args.integrator == Integrator::PhotonMapping.name() {
        text.push_str(&format!(" --integrator {}", args.integrator));
    }
    for (name, value) in [("photons", args.photons), ("caustic-photons", args.caustic_photons)] {
        if let Some(value) = value {
            text.push_str(&format!(" --{name} {value}"));
        }
    }
    // 0 only where nobody asked: `run` without a verb.
    if args.photon_radius != 1.0 && args.photon_radius != 0.0 {
        text.push_str(&format!(" --photon-radius {}", args.photon_radius));
    }
    text
}

/// Whether a path is named like a glTF file.
pub fn is_gltf(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf") || e.eq_ignore_ascii_case("glb"))
}
