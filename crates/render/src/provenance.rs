//! Where a rendered frame says it comes from.

use std::collections::BTreeMap;

use noisefloor_frame::{Provenance, Sampling};

use crate::camera::Eye;
use crate::request::REVISION;
use crate::shot::Totals;
use crate::{FeatureHit, Integrator, RenderRequest};

/// Of a frame that took so many seconds.
pub fn provenance(
    request: &RenderRequest<'_>,
    sampling: Sampling,
    seconds: f64,
    counts: &Totals,
) -> Provenance {
    let eye = Eye::new(&request.scene.camera, request.width, request.height, request.filter);
    let mut extra = BTreeMap::new();
    let [non_finite, rays] = counts.read();
    extra.insert("rays".into(), rays.to_string());
    if non_finite > 0 {
        extra.insert("non_finite_samples".into(), non_finite.to_string());
    }
    if request.sample_start > 0 {
        extra.insert("sample_start".into(), request.sample_start.to_string());
    }
    if request.feature_hit != FeatureHit::First {
        extra.insert("feature_hit".into(), request.feature_hit.name().into());
    }
    if let Some(maps) = request.photons {
        let s = maps.settings();
        extra.insert("photon_map_seed".into(), maps.seed().to_string());
        extra.insert("photon_paths".into(), format!("{} global, {} caustic", s.paths, s.caustic_paths));
        extra.insert(
            "photon_radii".into(),
            format!("{} global, {} px caustic, at most {}", s.radius, s.caustic_pixels, s.caustic_radius),
        );
    }
    if request.scene.shutter > 0.0 && !request.scene.bodies.is_empty() {
        extra.insert("shutter".into(), request.scene.shutter.to_string());
    }
    let integrator = match request.integrator {
        Integrator::PathTracing => "path",
        Integrator::PhotonMapping => "photon-mapping",
    };
    Provenance {
        scene: Some(request.scene.id().into()),
        renderer: Some(format!("noisefloor {} (revision {REVISION})", env!("CARGO_PKG_VERSION"))),
        integrator: Some(format!("{integrator} depth={}", request.depth)),
        light: Some(request.integrator),
        photon_maps: None,
        rounds: None,
        sampler: Some(crate::sampler::name(sampling).into()),
        seed: Some(request.seed),
        filter: Some(request.filter),
        camera: Some(eye.provenance(&request.scene.camera)),
        render_seconds: Some(seconds),
        render_threads: u32::try_from(rayon::current_num_threads()).ok(),
        extra,
    }
}
