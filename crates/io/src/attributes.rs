//! Header attributes: provenance, sample counts and kind of sampling.

use std::collections::BTreeMap;
use std::path::Path;

use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::standard_names;
use noisefloor_frame::{
    Camera, Counts, Integrator, Maps, PixelFilter, Provenance, RoundsTaken, Samples, Sampling,
};

use crate::IoError;

/// Attributes by name.
pub(crate) type Attributes = BTreeMap<String, AttributeValue>;

/// Names with a meaning here. Anything else is kept as an extra.
const OURS: [&str; 17] = [
    "scene",
    "renderer",
    "integrator",
    "sampler",
    "seed",
    "spp",
    "samplesPerPixel",
    "sppHalfA",
    "sampling",
    "filter",
    "cameraToWorld",
    "verticalFov",
    "renderSeconds",
    "renderThreads",
    PHOTON_MAPS,
    ROUNDS,
    FIRST_DEALT,
];

/// Which photon maps carried the light.
const PHOTON_MAPS: &str = "photon_maps";
/// In how many rounds samples were placed.
const ROUNDS: &str = "adaptive_rounds";

/// Which of four parts the first sample of every pixel went to.
const FIRST_DEALT: &str = "first_of_four_parts";

/// Other programs refuse channel names above 31 bytes unless the file says that it has long names, which the writer
/// derives from *attribute* names alone: this attribute has a long name.
pub(crate) const LONG_NAMES: &str = "hasChannelNamesLongerThan31Bytes";

/// Marks an extra whose own name would be read as something else.
const ESCAPE: &str = "extra.";

/// What a header says about a frame.
#[derive(Debug, Clone)]
pub(crate) struct Facts {
    pub(crate) provenance: Provenance,
    /// Mean samples per pixel, at least 1.
    pub(crate) spp: Option<f64>,
    pub(crate) spp_half_a: Option<u32>,
    pub(crate) sampling: Sampling,
    /// Which of four parts the first sample of every pixel went to, 0 to 3.
    pub(crate) first_dealt: u32,
}

/// Says which of four parts the first sample of every pixel went to, where it is not the first.
pub(crate) fn put_first_dealt(attributes: &mut Attributes, part: u32) {
    if part != 0 {
        attributes.insert(FIRST_DEALT.to_owned(), text(&part.to_string()));
    }
}

/// Everything that goes into the header of a frame.
pub(crate) fn of_frame(
    file: &Path,
    provenance: &Provenance,
    samples: &Samples,
    sampling: Sampling,
) -> Result<Attributes, IoError> {
    let mut out = of_text(file, &provenance.extra, &OURS)?;
    let mut put = |name: &str, value: Option<AttributeValue>| {
        if let Some(value) = value {
            out.insert(name.to_owned(), value);
        }
    };
    for (name, value) in [
        ("scene", &provenance.scene),
        ("renderer", &provenance.renderer),
        ("integrator", &provenance.integrator),
        ("sampler", &provenance.sampler),
    ] {
        put(name, value.as_deref().map(text));
    }
    put("seed", provenance.seed.map(integer));
    put("filter", provenance.filter.map(|filter| text(filter.name())));
    put(PHOTON_MAPS, provenance.photon_maps.map(|maps| text(maps.name())));
    put(ROUNDS, provenance.rounds.map(|rounds| text(&rounds.count.to_string())));
    // Not how long rendering took, nor on how many threads: equal frames are equal files.
    if let Some(camera) = &provenance.camera {
        check_camera(file, camera)?;
        let mut matrix = [0.0; 16];
        matrix.copy_from_slice(camera.camera_to_world.as_flattened());
        put("cameraToWorld", Some(AttributeValue::Matrix4x4(matrix)));
        put("verticalFov", Some(AttributeValue::F32(camera.vertical_fov_degrees)));
    }
    put("sampling", Some(text(sampling.name())));
    match samples.total() {
        Counts::Uniform(n) => put("spp", Some(integer((*n).into()))),
        counts @ Counts::PerPixel(_) => put("spp", Some(AttributeValue::F64(counts.mean()))),
    }
    if let Counts::Uniform(half) = samples.half_a()
        && parity_half(samples) != Some(*half)
    {
        put("sppHalfA", Some(integer((*half).into())));
    }
    Ok(out)
}

/// ⌈n/2⌉ of a uniform count: what a reader assumes if nothing is said.
fn parity_half(samples: &Samples) -> Option<u32> {
    match samples.total() {
        Counts::Uniform(n) => Some(n.div_ceil(2)),
        Counts::PerPixel(_) => None,
    }
}

/// Text attributes by name. Escapes names that the format gives a type of its own, and those in `reserved`, which would
/// be read as something else.
pub(crate) fn of_text(
    file: &Path,
    texts: &BTreeMap<String, String>,
    reserved: &[&str],
) -> Result<Attributes, IoError> {
    let mut out = Attributes::new();
    for (name, value) in texts {
        let standard = standard_names::ALL.contains(&name.as_bytes()) || name == LONG_NAMES;
        let escaped = standard || reserved.contains(&name.as_str()) || name.starts_with(ESCAPE);
        let on_disk = if escaped { format!("{ESCAPE}{name}") } else { name.clone() };
        if name.is_empty() || on_disk.len() > 255 || name.contains('\0') {
            return Err(bad(file, &on_disk, value, "a name of 1 to 249 bytes without NUL"));
        }
        out.insert(on_disk, text(value));
    }
    Ok(out)
}

/// All attributes that are text or a number, as text; without those that describe the file's own structure.
pub(crate) fn as_text(attributes: &Attributes) -> BTreeMap<String, String> {
    const STRUCTURE: [&str; 8] = [
        "name",
        "version",
        "chunkCount",
        "maxSamplesPerPixel",
        "pixelAspectRatio",
        "screenWindowWidth",
        "dwaCompressionLevel",
        LONG_NAMES,
    ];
    let described = attributes.iter().filter(|(name, _)| !STRUCTURE.contains(&name.as_str()));
    described
        .filter_map(|(name, value)| {
            let value = match value {
                AttributeValue::Text(text) => decode_text(text.as_slice()),
                AttributeValue::I32(value) => value.to_string(),
                AttributeValue::F32(value) => value.to_string(),
                AttributeValue::F64(value) => value.to_string(),
                _ => return None,
            };
            Some((name.clone(), value))
        })
        .collect()
}

/// Removes the escape of [`of_text`].
pub(crate) fn unescape(extras: BTreeMap<String, String>) -> BTreeMap<String, String> {
    let plain = |name: String| name.strip_prefix(ESCAPE).map(str::to_owned).unwrap_or(name);
    extras.into_iter().map(|(name, value)| (plain(name), value)).collect()
}

/// Reads what a header says. Only what decides statistics (`spp`, `sppHalfA`, `sampling`) and the camera can fail;
/// other values that do not parse are kept as extras.
pub(crate) fn facts(file: &Path, attributes: &Attributes) -> Result<Facts, IoError> {
    let mut left = as_text(attributes);
    let mut provenance = Provenance::default();
    for (name, field) in [
        ("scene", &mut provenance.scene),
        ("renderer", &mut provenance.renderer),
        ("integrator", &mut provenance.integrator),
        ("sampler", &mut provenance.sampler),
    ] {
        *field = left.remove(name);
    }
    provenance.light = provenance.integrator.as_deref().and_then(light);
    provenance.photon_maps = left.get(PHOTON_MAPS).and_then(|name| Maps::from_name(name));
    if provenance.photon_maps.is_some() {
        left.remove(PHOTON_MAPS);
    }
    // How long the decisions took is no part of the frame, like other times.
    provenance.rounds = take(&mut left, ROUNDS).map(|count| RoundsTaken { count, density_seconds: None });
    provenance.seed = take(&mut left, "seed");
    provenance.render_seconds = take(&mut left, "renderSeconds");
    provenance.render_threads = take(&mut left, "renderThreads");
    provenance.filter = left.get("filter").and_then(|name| PixelFilter::from_name(name));
    if provenance.filter.is_some() {
        left.remove("filter");
    }
    if let Some(AttributeValue::Matrix4x4(matrix)) = attributes.get("cameraToWorld")
        && let Some(vertical_fov_degrees) = take(&mut left, "verticalFov")
    {
        let camera_to_world = std::array::from_fn(|row| std::array::from_fn(|k| matrix[4 * row + k]));
        let camera = Camera { camera_to_world, vertical_fov_degrees };
        check_camera(file, &camera)?;
        provenance.camera = Some(camera);
    }
    let spp = match left.remove("spp") {
        Some(value) => Some(parse_spp(file, "spp", &value)?),
        None => left.remove("samplesPerPixel").map(|v| parse_spp(file, "samplesPerPixel", &v)).transpose()?,
    };
    let spp_half_a = match left.remove("sppHalfA") {
        Some(value) => {
            let count = value.trim().parse().ok().and_then(whole);
            Some(count.ok_or_else(|| bad(file, "sppHalfA", &value, "a whole number of samples"))?)
        }
        None => None,
    };
    let sampling = match left.remove("sampling") {
        Some(name) => [Sampling::Independent, Sampling::LowDiscrepancy]
            .into_iter()
            .find(|sampling| sampling.name() == name)
            .ok_or_else(|| bad(file, "sampling", &name, "`independent` or `low-discrepancy`"))?,
        None => sampling_of(provenance.sampler.as_deref()),
    };
    let first_dealt = take(&mut left, FIRST_DEALT).filter(|part| *part < 4).unwrap_or(0);
    provenance.extra = unescape(left);
    Ok(Facts { provenance, spp, spp_half_a, sampling, first_dealt })
}

/// The way of carrying light by the first word of its description.
fn light(integrator: &str) -> Option<Integrator> {
    match integrator.split_whitespace().next()? {
        "path" => Some(Integrator::PathTracing),
        name => Integrator::from_name(name),
    }
}

/// The kind of sampling by the sampler's name: independent if its first word is `independent` or `random`, or if
/// no sampler is named; low discrepancy for everything else (stratified, Sobol, multi-jittered, …).
fn sampling_of(sampler: Option<&str>) -> Sampling {
    let Some(sampler) = sampler else { return Sampling::Independent };
    let first = sampler.split(|c: char| !c.is_alphanumeric()).find(|word| !word.is_empty());
    match first.map(str::to_lowercase).as_deref() {
        None | Some("independent" | "random") => Sampling::Independent,
        Some(_) => Sampling::LowDiscrepancy,
    }
}

/// A count as a whole number, if it is one.
pub(crate) fn whole(count: f64) -> Option<u32> {
    let fits = count.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&count);
    fits.then_some(count as u32)
}

fn parse_spp(file: &Path, name: &str, value: &str) -> Result<f64, IoError> {
    let allowed = 1.0..=f64::from(u32::MAX);
    let count = value.trim().parse().ok().filter(|count| allowed.contains(count));
    count.ok_or_else(|| bad(file, name, value, "a number of samples from 1 to 4294967295"))
}

fn check_camera(file: &Path, camera: &Camera) -> Result<(), IoError> {
    if let Some(value) = camera.camera_to_world.as_flattened().iter().find(|v| !v.is_finite()) {
        return Err(bad(file, "cameraToWorld", &value.to_string(), "finite numbers"));
    }
    let fov = camera.vertical_fov_degrees;
    if !(fov > 0.0 && fov < 180.0) {
        return Err(bad(file, "verticalFov", &fov.to_string(), "degrees between 0 and 180"));
    }
    Ok(())
}

/// Removes and parses an attribute; one that does not parse stays.
fn take<T: std::str::FromStr>(left: &mut BTreeMap<String, String>, name: &str) -> Option<T> {
    let parsed = left.get(name)?.trim().parse().ok()?;
    left.remove(name);
    Some(parsed)
}

fn bad(file: &Path, name: &str, value: &str, expected: &'static str) -> IoError {
    IoError::Attribute { file: file.to_owned(), name: name.to_owned(), value: value.to_owned(), expected }
}

fn text(value: &str) -> AttributeValue {
    AttributeValue::Text(Text::from_slice_unchecked(value.as_bytes()))
}

/// An `int` attribute, or text where it does not fit: the format has no 64-bit integers.
fn integer(value: u64) -> AttributeValue {
    i32::try_from(value).map_or_else(|_| text(&value.to_string()), AttributeValue::I32)
}

/// UTF-8, or Latin-1 from programs that write that.
pub(crate) fn decode_text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}
