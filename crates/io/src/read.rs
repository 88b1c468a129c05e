use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use noisefloor_frame::{
    self as frame, Counts, Estimate, FeatureId, Fidelity, Finding, Flash, FourParts, Frame, Hygiene, Image,
    Optional, Provenance, Reference, Samples, Sampling, Variance, sorted_findings,
};

use crate::attributes::{self, Facts};
use crate::decode::{Opened, Target};
use crate::layers::{Layers, NEEDED_BY, Planned};
use crate::names::{Layer, Statistic, missing_of_rgb, sort_by_plane, title};
use crate::window::Window;
use crate::{IoError, write};

/// What a caller knows about a file that its header may not say.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// Samples per pixel of files whose header has neither `spp` nor `samplesPerPixel`, and which have no `samples`
    /// layer. Ignored for the others.
    pub spp: Option<u32>,
    /// Most bytes that the values of the layers that are read may take. Unless it is set: [`crate::MAX_DECODED_BYTES`],
    /// and not more than 256 times the size of the file where that is more than 512 MiB. Checked before anything is
    /// allocated.
    pub max_decoded_bytes: Option<u64>,
}

/// What the header of a file says. Nothing is decoded.
#[derive(Debug, Clone, PartialEq)]
pub struct FileInfo {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Where its pixels stand.
    pub window: Window,
    /// Layers, such as `color`, `color.variance`, `albedo`, `part0`, sorted.
    pub layers: Vec<String>,
    /// Mean samples per pixel, if the header says.
    pub spp: Option<f64>,
    /// Kind of sampling: as said, or derived from the sampler's name as [`read_frame`] does.
    pub sampling: Sampling,
    /// Origin.
    pub provenance: Provenance,
    /// Layers and channels that were left out or read under another name, and layers that look like others.
    pub findings: Vec<Finding>,
}

/// A frame as a file has it, with what was found about its layers.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameFile {
    /// The frame; values as they are.
    pub frame: Frame,
    /// Layers and channels that were left out or read under another name, and layers that look like others.
    pub findings: Vec<Finding>,
    /// What the file's compression did to the numbers.
    pub fidelity: Fidelity,
}

/// Reads the header of a file and checks its channel names.
///
/// # Errors
/// As [`read_frame`], as far as the header shows them; a missing `spp` is none.
pub fn read_info(path: impl AsRef<Path>) -> Result<FileInfo, IoError> {
    let opened = Opened::open(path.as_ref())?;
    let layers = Layers::find(&opened, |_, _| true)?;
    let Facts { provenance, spp, sampling, .. } = attributes::facts(&opened.file, &opened.attributes)?;
    let (width, height, window) = (opened.width, opened.height, opened.window);
    let (titles, findings) = (layers.titles(), layers.findings);
    Ok(FileInfo { width, height, window, layers: titles, spp, sampling, provenance, findings })
}

/// What the header of any image says, whatever its channels: what must be known before two files are held against each
/// other.
#[derive(Debug, Clone, PartialEq)]
pub struct FileOrigin {
    /// Where its pixels stand.
    pub window: Window,
    /// Where it came from, as far as the attributes can be understood.
    pub provenance: Provenance,
    /// Mean samples per pixel, if the header says.
    pub spp: Option<f64>,
}

/// Reads of a header what does not depend on the channels. Nothing is decoded.
///
/// # Errors
/// As [`read_frame`] for a file that is unreadable, not EXR, malformed, unsupported or too large.
pub fn read_origin(path: impl AsRef<Path>) -> Result<FileOrigin, IoError> {
    let opened = Opened::open(path.as_ref())?;
    let facts = attributes::facts(&opened.file, &opened.attributes).ok();
    let (provenance, spp) = facts.map(|facts| (facts.provenance, facts.spp)).unwrap_or_default();
    Ok(FileOrigin { window: opened.window, provenance, spp })
}

/// Reads all header attributes that are text or numbers, as text.
///
/// # Errors
/// As [`read_info`].
pub fn read_attributes(path: impl AsRef<Path>) -> Result<BTreeMap<String, String>, IoError> {
    let opened = Opened::open(path.as_ref())?;
    Ok(attributes::unescape(attributes::as_text(&opened.attributes)))
}

/// Reads a frame.
///
/// Channels are found by name, whatever their order and type (half, float, unsigned int). Layers that are no part of
/// the layout become [`FeatureId::Extra`] features under their own name, channels without a layer too; `part…` layers
/// of a reference are skipped. The data window may start anywhere. Only the largest level of mip-mapped files is read.
///
/// Samples per pixel come from the layer `samples`, else from the attribute `spp` (integer, float or text), else from
/// `samplesPerPixel`, else from `options`. If the attribute `sampling` is missing it follows from the sampler's name:
/// `independent…`, `random…` and a missing name mean independent, anything else low discrepancy. A layer of a feature
/// or of the flash that is incomplete or mislabelled does not cost the frame: it is left out. Channels of another
/// usual name are taken for the layer's own (`normal.R` for `normal.X`), channels beyond are left out.
/// [`read_frame_file`] tells. Values are taken as they are: whoever makes numbers from them reads with
/// [`read_checked_frame`].
///
/// # Errors
/// [`IoError`] naming file, layer and channel: unreadable, not EXR, truncated, malformed, unsupported or too large;
/// [`IoError::Memory`] if the decoded values would be;
/// colour, its statistics or sample counts that are incomplete, mislabelled or doubled; two kinds of flash;
/// attributes without meaning; no sample count.
pub fn read_frame(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Frame, IoError> {
    Ok(read_frame_file(path, options)?.frame)
}

/// Reads a frame like [`read_frame`], with what was found about its layers.
///
/// # Errors
/// As [`read_frame`].
pub fn read_frame_file(path: impl AsRef<Path>, options: &ReadOptions) -> Result<FrameFile, IoError> {
    let (reference, findings, fidelity) = read_parts(path.as_ref(), options, false)?;
    Ok(FrameFile { frame: reference.frame, findings, fidelity })
}

/// Reads a frame and checks it, see [`Frame::inspect`]: a method may look at it. The findings are those about its
/// layers and its values.
///
/// # Errors
/// As [`read_frame`]; [`IoError::Frame`] for buffers that contradict each other and for a frame without a valid pixel.
pub fn read_checked_frame(
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Result<(Frame, Hygiene), IoError> {
    let path = path.as_ref();
    let FrameFile { mut frame, mut findings, fidelity } = read_frame_file(path, options)?;
    let mut hygiene = frame.inspect(fidelity).map_err(|cause| IoError::frame(path, cause))?;
    findings.append(&mut hygiene.findings);
    hygiene.findings = sorted_findings(findings);
    Ok((frame, hygiene))
}

/// Reads a reference: a frame, and the parts if the file has them. Any frame is also a reference without parts.
///
/// # Errors
/// As [`read_frame`]; [`IoError::MissingLayer`] also if the parts are not numbered without gaps from `part0`.
pub fn read_reference(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Reference, IoError> {
    Ok(read_parts(path.as_ref(), options, true)?.0)
}

/// Reads a reference and checks it, see [`Reference::inspect`]: errors may be measured against it.
///
/// # Errors
/// As [`read_reference`]; [`IoError::Frame`] for buffers that contradict each other.
pub fn read_checked_reference(
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Result<(Reference, Vec<Finding>), IoError> {
    let path = path.as_ref();
    let (mut reference, mut findings, fidelity) = read_parts(path, options, true)?;
    findings.extend(reference.inspect(fidelity).map_err(|cause| IoError::frame(path, cause))?);
    Ok((reference, sorted_findings(findings)))
}

/// Reads the channels without a layer as an image: those that [`crate::write_image`] writes, in its order. From a
/// frame this takes the colour mean, with the file's alpha as a fourth plane if it has one.
///
/// # Errors
/// As [`read_frame`], for those channels alone.
pub fn read_image(path: impl AsRef<Path>) -> Result<Image, IoError> {
    let opened = Opened::open(path.as_ref())?;
    let names = opened.channels.iter().map(|channel| channel.name.clone());
    let mut bare: Vec<(String, usize)> = names.zip(0..).filter(|(name, _)| !name.contains('.')).collect();
    sort_by_plane(&mut bare);
    if bare.is_empty() {
        return Err(missing(&opened.file, &Layer::Color, Statistic::Mean, "a plain image"));
    }
    let incomplete = missing_of_rgb(bare.iter().map(|(name, _)| name.as_str()));
    if let Some(channel) = incomplete {
        let (file, layer) = (opened.file, title(&Layer::Color, Statistic::Mean));
        let (channel, expected) = (channel.to_owned(), "R, G, B".to_owned());
        return Err(IoError::IncompleteLayer { file, layer, channel, expected });
    }
    decode_planes(opened, &bare.iter().map(|(_, index)| *index).collect::<Vec<_>>())
}

/// Reads the channels `R`, `G` and `B` alone, of an image or a frame.
///
/// # Errors
/// As [`read_frame`], for those channels alone.
pub fn read_color(path: impl AsRef<Path>) -> Result<Image, IoError> {
    let opened = Opened::open(path.as_ref())?;
    let layers =
        Layers::find(&opened, |layer, statistic| (layer, statistic) == (&Layer::Color, Statistic::Mean))?;
    match layers.get(&Layer::Color, Statistic::Mean) {
        Some(channels) => decode_planes(opened, channels),
        None => Err(missing(&opened.file, &Layer::Color, Statistic::Mean, "a colour image")),
    }
}

fn decode_planes(opened: Opened, channels: &[usize]) -> Result<Image, IoError> {
    let (width, height, file) = (opened.width, opened.height, opened.file.clone());
    let mut targets = vec![Target::Skip; opened.channels.len()];
    for (plane, &index) in channels.iter().enumerate() {
        targets[index] = Target::Float { buffer: 0, plane };
    }
    let data = opened.decode(&targets, &[channels.len()], 0)?.floats.swap_remove(0);
    Image::from_vec(width, height, channels.len(), data).map_err(|cause| IoError::frame(&file, cause))
}

fn missing(file: &Path, layer: &Layer, statistic: Statistic, needed_by: &str) -> IoError {
    let (layer, needed_by) = (title(layer, statistic), needed_by.to_owned());
    IoError::MissingLayer { file: file.to_owned(), layer, needed_by }
}

fn read_parts(
    path: &Path,
    options: &ReadOptions,
    with_parts: bool,
) -> Result<(Reference, Vec<Finding>, Fidelity), IoError> {
    let opened = Opened::open(path)?.within(options.max_decoded_bytes);
    let fidelity = if opened.lossy { Fidelity::Lossy } else { Fidelity::Rounded };
    let mut layers = Layers::find(&opened, |layer, _| with_parts || !matches!(layer, Layer::Part(_)))?;
    let facts = attributes::facts(path, &opened.attributes)?;
    // Everything that names alone decide comes before the decoder's work.
    let features = feature_ids(&layers);
    let optionals = optional_statistics(&layers);
    check_layers(path, &layers)?;
    if facts.spp.is_none() && options.spp.is_none() && layers.get(&Layer::Samples, Statistic::Mean).is_none()
    {
        return Err(IoError::MissingSpp { file: path.to_owned() });
    }
    let width = opened.width;
    let findings = std::mem::take(&mut layers.findings);
    let mut planned = layers.decode(opened)?;
    let samples = samples(path, &facts, options, &mut planned)?;
    write::check_counts(path, &samples, width)?;
    let mut frame = Frame::from_color(estimate(path, &mut planned, &Layer::Color)?, samples, facts.sampling);
    frame.provenance = facts.provenance;
    frame.flash = flash(path, &mut planned)?;
    for id in features {
        let estimate = estimate(path, &mut planned, &Layer::Feature(id.clone()))?;
        frame.features.insert(id, estimate);
    }
    frame.optional = optional(path, &mut planned, &optionals, facts.first_dealt, &frame.samples)?;
    let mut parts = Vec::new();
    while let Some(part) = planned.take(&Layer::Part(parts.len()), Statistic::Mean) {
        parts.push(part);
    }
    frame.check().map_err(|cause| IoError::frame(path, cause))?;
    Ok((Reference { frame, parts }, findings, fidelity))
}

fn feature_ids(layers: &Layers) -> BTreeSet<FeatureId> {
    let features = layers.keys().filter_map(|(layer, _)| match layer {
        Layer::Feature(id) => Some(id.clone()),
        _ => None,
    });
    features.collect()
}

/// The optional statistics of which there is every image: [`Layers::find`] left out the others.
fn optional_statistics(layers: &Layers) -> Vec<frame::Statistic> {
    let of = |(layer, _): &(Layer, Statistic)| match layer {
        Layer::Optional(name, 0) => name.parse().ok(),
        _ => None,
    };
    layers.keys().filter_map(of).collect()
}

fn optional(
    file: &Path,
    planned: &mut Planned,
    statistics: &[frame::Statistic],
    first: u32,
    samples: &Samples,
) -> Result<Optional, IoError> {
    let mut recorded = Vec::new();
    for statistic in statistics {
        let images = statistic.row().images.len();
        let images =
            (0..images).filter_map(|k| planned.take(&Layer::optional(*statistic, k), Statistic::Mean));
        recorded.push((*statistic, images.collect()));
    }
    let parts = statistics.contains(&frame::Statistic::FourParts);
    let parts = parts.then(|| FourParts::dealt(first, samples.total()));
    Optional::new(recorded, parts, Vec::new()).map_err(|cause| IoError::frame(file, cause))
}

/// Checks that colour and parts have the layers that give them a meaning.
fn check_layers(file: &Path, layers: &Layers) -> Result<(), IoError> {
    let has = |layer: &Layer, statistic| layers.get(layer, statistic).is_some();
    let mean = Statistic::Mean;
    if !has(&Layer::Color, mean) {
        return Err(missing(file, &Layer::Color, mean, "a frame"));
    }
    // The other layers were left out where something is missing.
    for (one, other) in NEEDED_BY {
        if has(&Layer::Color, one) && !has(&Layer::Color, other) {
            return Err(missing(file, &Layer::Color, other, &format!("`{}`", title(&Layer::Color, one))));
        }
    }
    if has(&Layer::FlashBase, mean) && has(&Layer::FlashReady, mean) {
        let (layer, other) = (title(&Layer::FlashBase, mean), title(&Layer::FlashReady, mean));
        return Err(IoError::ConflictingLayers { file: file.to_owned(), layer, other });
    }
    let count = layers.keys().filter(|(layer, _)| matches!(layer, Layer::Part(_))).count();
    match (0..count).map(Layer::Part).find(|part| !has(part, mean)) {
        Some(gap) => Err(missing(file, &gap, mean, "a reference in parts")),
        None => Ok(()),
    }
}

fn estimate(file: &Path, planned: &mut Planned, layer: &Layer) -> Result<Estimate, IoError> {
    let mean = planned.take(layer, Statistic::Mean);
    let mean = mean.ok_or_else(|| missing(file, layer, Statistic::Mean, "a frame"))?;
    let variance = planned.take(layer, Statistic::Variance).map(Variance::of_mean);
    let halves = planned.take(layer, Statistic::HalfA).zip(planned.take(layer, Statistic::HalfB));
    Ok(Estimate { mean, variance, halves: halves.map(|(a, b)| [a, b]) })
}

fn flash(file: &Path, planned: &mut Planned) -> Result<Option<Flash>, IoError> {
    if planned.has(&Layer::FlashReady) {
        return Ok(Some(Flash::Ready(estimate(file, planned, &Layer::FlashReady)?)));
    }
    if !planned.has(&Layer::FlashBase) {
        return Ok(None);
    }
    let base = estimate(file, planned, &Layer::FlashBase)?;
    let light = estimate(file, planned, &Layer::FlashLight)?;
    let covariance = planned.take(&Layer::FlashCovariance, Statistic::Mean);
    Ok(Some(Flash::Parts { base, light, covariance }))
}

fn samples(
    file: &Path,
    facts: &Facts,
    options: &ReadOptions,
    planned: &mut Planned,
) -> Result<Samples, IoError> {
    let total = planned.take_counts(Statistic::Mean)?;
    let half_a = planned.take_counts(Statistic::HalfA)?;
    let samples = match (total, facts.spp) {
        (Some(counts), _) => Samples::per_pixel(counts),
        (None, Some(spp)) => Samples::uniform(attributes::whole(spp).ok_or_else(|| IoError::Attribute {
            file: file.to_owned(),
            name: "spp".into(),
            value: spp.to_string(),
            expected: "a whole number, unless the layer `samples` counts per pixel",
        })?),
        (None, None) => {
            let spp = options.spp.ok_or_else(|| IoError::MissingSpp { file: file.to_owned() })?;
            Samples::uniform(spp)
        }
    };
    Ok(match (half_a, facts.spp_half_a) {
        (Some(counts), _) => samples.with_half_a(Counts::PerPixel(counts)),
        (None, Some(half)) => samples.with_half_a(Counts::Uniform(half)),
        (None, None) => samples,
    })
}
