//! Scenes of another program: a folder of frames with a reference.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use noisefloor_frame::{Finding, FindingKind, Reference};
use noisefloor_inputs::{Origin, shared_seed};
use noisefloor_io::{FileInfo, FrameFile, FrameFolder, ReadOptions, read_checked_reference, read_frame_file};
use serde_json::json;

use crate::error::HarnessError;
use crate::source::frame::{FrameKind, FrameSpec};
use crate::source::opened::Opened;
use crate::store::hash_of;
use noisefloor_study::SceneSpec;
use noisefloor_study::{Key, key_of};

/// The files of an imported scene.
pub(super) struct Imported {
    files: BTreeMap<(u32, u32), PathBuf>,
    reference: PathBuf,
    options: ReadOptions,
}

pub(super) fn open(spec: &SceneSpec, path: &Path) -> Result<(Opened, Imported), HarnessError> {
    // A single level in the study file also says what the files themselves do not.
    let options = ReadOptions {
        spp: spec.spp.as_deref().and_then(|levels| <[u32; 1]>::try_from(levels).ok()).map(|[n]| n),
        ..ReadOptions::default()
    };
    let folder = FrameFolder::scan(path, &options)?;
    let wanted = |spp: u32| spec.spp.as_ref().is_none_or(|levels| levels.contains(&spp));
    if let Some(absent) = spec.spp.iter().flatten().find(|n| !folder.frames.iter().any(|f| f.spp == **n)) {
        return Err(HarnessError::Folder {
            path: path.into(),
            reason: format!("no frame of {absent} samples per pixel, which the study asks for"),
        });
    }
    let mut frames = Vec::new();
    let mut files = BTreeMap::new();
    for frame in folder.frames.iter().filter(|frame| wanted(frame.spp)) {
        let replicate = frame.replicate as u32;
        frames.push(FrameSpec {
            kind: FrameKind::Uniform,
            spp: frame.spp,
            replicate,
            seed: frame.info.provenance.seed.unwrap_or(0),
            key: file_key(&frame.path, &frame.info, &options)?,
        });
        files.insert((frame.spp, replicate), frame.path.clone());
    }
    let findings: Vec<Finding> = seeds(&folder)?.into_iter().map(|found| found.within(&spec.id)).collect();
    let info = &folder.reference_info;
    let mut settings = BTreeMap::from([
        ("sampling".to_owned(), folder.frames[0].info.sampling.name().to_owned()), // at least one frame by contract
        ("layers".to_owned(), folder.frames[0].info.layers.join(", ")),
    ]);
    let provenance = &folder.frames[0].info.provenance;
    for (name, value) in [
        ("renderer", &provenance.renderer),
        ("integrator", &provenance.integrator),
        ("sampler", &provenance.sampler),
    ] {
        if let Some(value) = value {
            settings.insert(name.into(), value.clone());
        }
    }
    let scene_name = provenance.scene.clone().unwrap_or_else(|| folder.name());
    let opened = Opened {
        id: spec.id.clone(),
        title: scene_name,
        about: match &provenance.renderer {
            Some(renderer) => format!("imported frames, rendered by {renderer}"),
            None => "imported frames of another program".into(),
        },
        width: info.width,
        height: info.height,
        sampling: folder.frames[0].info.sampling,
        settings,
        maps: None,
        frames,
        findings: findings.into_iter().chain(layer_findings(&spec.id, &folder)).collect(),
        extra_features: layers(&folder),
        reference_key: file_key(&folder.reference, info, &options)?,
        reference_spp: info.spp.map_or(0, |spp| spp.round() as u64),
        reference_sampling: info.sampling.name().to_owned(),
        known_mean: None,
        equal_time_spp: None,
    };
    Ok((opened, Imported { files, reference: folder.reference.clone(), options }))
}

/// Names of all layers that some frame has.
fn layers(folder: &FrameFolder) -> BTreeSet<String> {
    folder.frames.iter().flat_map(|frame| frame.info.layers.iter().cloned()).collect()
}

/// Frames and reference must not be made from the same random numbers.
///
/// # Errors
/// [`HarnessError::SharedSeed`] where the headers prove it; where they only make it likely, the first pair is a finding.
fn seeds(folder: &FrameFolder) -> Result<Vec<Finding>, HarnessError> {
    let files: Vec<(&Path, &FileInfo)> =
        std::iter::once((folder.reference.as_path(), &folder.reference_info))
            .chain(folder.frames.iter().map(|frame| (frame.path.as_path(), &frame.info)))
            .collect();
    fn origin(info: &FileInfo) -> Origin<'_> {
        Origin { provenance: &info.provenance, spp: info.spp }
    }
    let mut likely = Vec::new();
    for (k, (second, info)) in files.iter().enumerate() {
        for (first, other) in &files[..k] {
            let Some(shared) = shared_seed(origin(other), origin(info)) else { continue };
            let (first, second) = (first.to_path_buf(), second.to_path_buf());
            if shared.proven {
                return Err(HarnessError::SharedSeed { first, second, seed: shared.seed });
            }
            likely.push((first, second, shared.seed));
        }
    }
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let rest = match likely.len().saturating_sub(1) {
        0 => String::new(),
        more => format!(", and {more} more pairs"),
    };
    let told = likely.first().map(|(first, second, seed)| {
        let text = format!(
            "name the same scene, renderer, sampler and random seed {seed}{rest}: with many renderers they share samples"
        );
        Finding::new(FindingKind::SharedSeed, format!("{} and {}", name(first), name(second)), text)
    });
    Ok(told.into_iter().collect())
}

/// Hash of a file's bytes, and of what its header is taken to say: another reading of channel names is another frame.
fn file_key(path: &Path, info: &FileInfo, options: &ReadOptions) -> Result<Key, HarnessError> {
    Ok(key_of(&json!({
        "file": hash_of(path)?, "spp": options.spp,
        "read as": [json!(info.layers), json!(info.spp), json!(info.sampling)],
    })))
}

impl Imported {
    /// The frame as its file has it, and the file's name.
    pub(super) fn frame(&self, spec: &FrameSpec) -> Result<(FrameFile, String), HarnessError> {
        let path = &self.files[&(spec.spp, spec.replicate)]; // made from the same list as the specs
        Ok((read_frame_file(path, &self.options)?, file_name(path)))
    }

    pub(super) fn reference(&self) -> Result<(Reference, Vec<Finding>), HarnessError> {
        // The count of the reference only serves to say how long it is; a file without one is usable.
        let options = ReadOptions { spp: self.options.spp.or(Some(1)), ..self.options };
        Ok(read_checked_reference(&self.reference, &options)?)
    }
}

/// What the headers say about the layers of the frames: once each, with the number of files if that is not all of them.
fn layer_findings(scene: &str, folder: &FrameFolder) -> Vec<Finding> {
    let mut counted: Vec<(Finding, usize)> = Vec::new();
    for finding in folder.frames.iter().flat_map(|frame| &frame.info.findings) {
        match counted.iter_mut().find(|(known, _)| known == finding) {
            Some((_, count)) => *count += 1,
            None => counted.push((finding.clone(), 1)),
        }
    }
    let all = folder.frames.len();
    let told = |(mut finding, count): (Finding, usize)| {
        if count < all {
            finding.text.push_str(&format!(" (in {count} of {all} frames)"));
        }
        finding.within(scene)
    };
    counted.into_iter().map(told).collect()
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
