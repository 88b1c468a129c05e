//! Frames that are drawn from a known law.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_frame::{Frame, Sampling, Statistic};
use noisefloor_questions::PixelClasses;
use noisefloor_study::{Bits, Key, Place, SceneSpec, Study, StudyError, hash_of_frame, key_of};
use noisefloor_synthetic::SyntheticScene;
use serde_json::json;

use crate::cache::Cache;
use crate::error::HarnessError;
use crate::observer::Observer;
use crate::source::frame::{FrameKind, FrameSpec, frame_specs};
use crate::source::opened::Opened;
use crate::source::probe::{PROBE, PROBE_SPP};

pub(super) fn open(
    study: &Study,
    spec: &SceneSpec,
    scene: &SyntheticScene,
    size: Option<(usize, usize)>,
) -> Result<(Opened, SyntheticScene), HarnessError> {
    let scene = match size {
        Some((width, height)) => scene.resized(width, height).map_err(|e| StudyError::Field {
            place: Place::of_study(&study.name, None),
            field: format!("scene `{}`: size", spec.id),
            value: format!("{width}×{height}"),
            allowed: e.to_string(),
        })?,
        None => scene.clone(),
    };
    let description = serde_json::to_value(&scene).unwrap_or_default();
    let (drawn, truth) = synthetic_probes(&scene, &[]);
    let (with_statistics, _) = synthetic_probes(&scene, &study.optional_statistics());
    // Frames of a sequence have random numbers of their own.
    let frame = spec.shot.frame;
    let identity = if frame == 0 { description.clone() } else { json!([description, frame]) };
    let statistics: Vec<String> = study.optional_statistics().iter().map(ToString::to_string).collect();
    let frames = frame_specs(study, spec, &identity, |spp, seed| {
        let mut of = json!({ "synthetic": description, "drawn": drawn, "spp": spp, "seed": seed });
        if !statistics.is_empty() {
            of["statistics"] = json!([statistics, with_statistics]);
        }
        key_of(&of)
    });
    let mut settings = BTreeMap::from([
        ("seed".to_owned(), study.seed.to_string()),
        ("samples".to_owned(), description.to_string()),
    ]);
    if !statistics.is_empty() {
        settings.insert("optional statistics".to_owned(), statistics.join(", "));
    }
    let opened = Opened {
        id: spec.id.clone(),
        title: spec.id.clone(),
        about: format!(
            "synthetic: samples of a known law ({}) around a known mean image",
            scene.law().name()
        ),
        width: scene.width(),
        height: scene.height(),
        sampling: Sampling::Independent,
        settings,
        maps: None,
        frames,
        findings: Vec::new(),
        extra_features: BTreeSet::new(),
        reference_key: key_of(&json!({ "truth": description, "drawn": truth })),
        reference_spp: 0,
        reference_sampling: "exact".into(),
        known_mean: None,
        equal_time_spp: None,
    };
    Ok((opened, scene))
}

/// Draws a frame, or reads it: others can compute what is said of it from the file.
pub(super) fn frame(
    (scene, statistics): (&SyntheticScene, &[Statistic]),
    spec: &FrameSpec,
    cache: &Cache,
    observer: &dyn Observer,
) -> Result<Frame, HarnessError> {
    cache.frame(&spec.key, observer, || {
        let mut frame = scene.render_with(spec.spp, spec.seed, statistics);
        if spec.kind == FrameKind::KnownVariance {
            frame.color.variance = Some(scene.variance(spec.spp));
        }
        Ok(frame)
    })
}

/// The same frame with the variance of its law.
pub(super) fn with_known_variance(frame: &FrameSpec) -> FrameSpec {
    let key = key_of(&json!({ "frame": frame.key, "variance": "known" }));
    FrameSpec { key, kind: FrameKind::KnownVariance, ..frame.clone() }
}

/// Hashes of a tiny frame of a synthetic scene, with these statistics, and of its truth with the classes of its pixels: they
/// change whenever other numbers are drawn.
fn synthetic_probes(scene: &SyntheticScene, statistics: &[Statistic]) -> (Key, Key) {
    let (width, height) = (scene.width().min(PROBE[0]), scene.height().min(PROBE[1]));
    // Never larger than a size that is allowed.
    let small = scene.resized(width, height).unwrap_or_else(|_| scene.clone());
    let mut truth = Bits::of("truth");
    truth.frame(&small.truth().frame);
    PixelClasses::from(small.classes()).add_to(&mut truth);
    (hash_of_frame(&small.render_with(PROBE_SPP, 0, statistics)), truth.finish())
}
