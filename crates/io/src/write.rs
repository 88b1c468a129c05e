use std::collections::BTreeMap;
use std::path::Path;

use noisefloor_frame::{Counts, Estimate, Flash, FourParts, Frame, FrameError, Image, Reference, Samples};

use crate::encode::{Plane, Values};
use crate::names::{Layer, Statistic, channel_name, default_channels, parse, title};
use crate::window::Window;
use crate::{Destination, IoError, attributes, encode};

/// Writes a frame as one multi-layer EXR file, 32-bit floats, ZIP-compressed, atomically, or to whatever else the
/// [`Destination`] is.
///
/// [`crate::read_frame`] gives back every number bit for bit. Equal frames give equal files. Of optional statistics the
/// images are written; samples of tapped pixels are not.
///
/// # Errors
/// [`IoError::Write`] if the file cannot be written, [`IoError::Extension`] if it is named like another kind of file,
/// [`IoError::Frame`] if the buffers of the frame do not fit together,
/// [`IoError::Mislabelled`] for an extra feature whose name would be read as something else, [`IoError::Count`] for a
/// sample count of zero, [`IoError::Attribute`] for provenance that cannot be stored.
pub fn write_frame(to: impl Into<Destination>, frame: &Frame) -> Result<(), IoError> {
    write_parts(&to.into(), frame, &[])
}

/// Writes a reference: its frame, and its parts as layers `part0`, `part1`, ….
///
/// # Errors
/// As [`write_frame`]; [`IoError::Frame`] also if a part differs from the frame in size.
pub fn write_reference(to: impl Into<Destination>, reference: &Reference) -> Result<(), IoError> {
    write_parts(&to.into(), &reference.frame, &reference.parts)
}

/// Writes a plain image, such as a denoised result, a diagnostic or a mask, atomically.
///
/// Channels are `Y`, `X Y`, `R G B`, `R G B A` for 1 to 4 planes and `0 1 2 …` above. `attributes` go into the header as
/// text and come back from [`crate::read_attributes`].
///
/// # Errors
/// [`IoError::Write`], [`IoError::Extension`], [`IoError::TooLarge`]; [`IoError::Attribute`] for a name that cannot be stored.
pub fn write_image(
    to: impl Into<Destination>,
    image: &Image,
    attributes: &BTreeMap<String, String>,
) -> Result<(), IoError> {
    plain(&to.into(), image, attributes, None)
}

/// Writes a plain image like [`write_image`], at a place in a picture: that of the frame that it was made from.
///
/// # Errors
/// As [`write_image`].
pub fn write_image_at(
    to: impl Into<Destination>,
    image: &Image,
    attributes: &BTreeMap<String, String>,
    window: &Window,
) -> Result<(), IoError> {
    plain(&to.into(), image, attributes, Some(window))
}

fn plain(
    to: &Destination,
    image: &Image,
    attributes: &BTreeMap<String, String>,
    window: Option<&Window>,
) -> Result<(), IoError> {
    let names = default_channels(image.channels());
    let planes = names
        .into_iter()
        .zip(image.planes())
        .map(|(name, plane)| Plane { name, values: Values::Float(plane) })
        .collect();
    let attributes = attributes::of_text(to.name(), attributes, &[])?;
    encode::write(to, image.width(), image.height(), planes, attributes, window)
}

fn write_parts(to: &Destination, frame: &Frame, parts: &[Image]) -> Result<(), IoError> {
    let path = to.name();
    frame.check().map_err(|cause| IoError::frame(path, cause))?;
    check_counts(path, &frame.samples, frame.width())?;
    let mut planes = Planes { file: path, planes: Vec::new() };
    planes.estimate(&Layer::Color, &frame.color)?;
    for (id, estimate) in &frame.features {
        planes.estimate(&Layer::Feature(id.clone()), estimate)?;
    }
    match &frame.flash {
        Some(Flash::Parts { base, light, covariance }) => {
            planes.estimate(&Layer::FlashBase, base)?;
            planes.estimate(&Layer::FlashLight, light)?;
            if let Some(covariance) = covariance {
                planes.image(&Layer::FlashCovariance, Statistic::Mean, covariance)?;
            }
        }
        Some(Flash::Ready(flash)) => planes.estimate(&Layer::FlashReady, flash)?,
        None => {}
    }
    planes.counts(&frame.samples);
    for (k, part) in parts.iter().enumerate() {
        let what = format!("part{k}");
        let shape: Result<(), FrameError> = part.expect_shape(&what, frame.width(), frame.height(), 3);
        shape.map_err(|cause| IoError::frame(path, cause))?;
        planes.image(&Layer::Part(k), Statistic::Mean, part)?;
    }
    for (statistic, images) in frame.optional.recorded() {
        for (k, image) in images.iter().enumerate() {
            planes.image(&Layer::optional(*statistic, k), Statistic::Mean, image)?;
        }
    }
    let mut attributes = attributes::of_frame(path, &frame.provenance, &frame.samples, frame.sampling)?;
    if let Some(parts) = frame.optional.four_parts() {
        attributes::put_first_dealt(&mut attributes, first_dealt(path, parts, &frame.samples)?);
    }
    encode::write(to, frame.width(), frame.height(), planes.planes, attributes, None)
}

/// The part that the first sample of every pixel went to: from there on they were dealt in turn.
fn first_dealt(file: &Path, parts: FourParts<'_>, samples: &Samples) -> Result<u32, IoError> {
    let first = (0..4).find(|first| FourParts::dealt(*first, samples.total()) == *parts.samples);
    first.ok_or_else(|| {
        let problem = "samples of four parts that were not dealt in turn are not written".into();
        IoError::frame(file, FrameError::Optional { id: "four-parts", problem })
    })
}

/// Collects channels under their names.
struct Planes<'a> {
    file: &'a Path,
    planes: Vec<Plane<'a>>,
}

impl<'a> Planes<'a> {
    fn estimate(&mut self, layer: &Layer, estimate: &'a Estimate) -> Result<(), IoError> {
        self.image(layer, Statistic::Mean, &estimate.mean)?;
        if let Some(variance) = &estimate.variance {
            self.image(layer, Statistic::Variance, variance.mean_variance())?;
        }
        if let Some([a, b]) = &estimate.halves {
            self.image(layer, Statistic::HalfA, a)?;
            self.image(layer, Statistic::HalfB, b)?;
        }
        Ok(())
    }

    fn image(&mut self, layer: &Layer, statistic: Statistic, image: &'a Image) -> Result<(), IoError> {
        let channels = match layer.channels() {
            Some(fixed) => fixed.iter().map(|&name| name.to_owned()).collect(),
            None => default_channels(image.channels()),
        };
        for (channel, plane) in channels.into_iter().zip(image.planes()) {
            let name = channel_name(layer, statistic, &channel);
            self.check_name(layer, statistic, &channel, &name)?;
            self.planes.push(Plane { name, values: Values::Float(plane) });
        }
        Ok(())
    }

    /// A freely named feature must not come back as something else.
    fn check_name(
        &self,
        layer: &Layer,
        statistic: Statistic,
        channel: &str,
        name: &str,
    ) -> Result<(), IoError> {
        let same = (layer.clone(), statistic, channel.to_owned());
        let storable = name.len() <= 255 && !name.contains('\0');
        if storable && parse(name) == Ok(same) {
            return Ok(());
        }
        Err(IoError::Mislabelled {
            file: self.file.to_owned(),
            layer: title(layer, statistic),
            channel: name.to_owned(),
            why: "it would be read as something else, or has NUL or more than 255 bytes; rename the feature"
                .into(),
        })
    }

    fn counts(&mut self, samples: &'a Samples) {
        let mut put = |statistic, counts: &'a [u32]| {
            let name = channel_name(&Layer::Samples, statistic, "Y");
            self.planes.push(Plane { name, values: Values::Count(counts) });
        };
        if let Counts::PerPixel(counts) = samples.total() {
            put(Statistic::Mean, counts);
        }
        // The parity split is what a reader assumes.
        let parity = match samples.total() {
            Counts::Uniform(_) => None,
            Counts::PerPixel(counts) => Some(counts.iter().map(|n| n.div_ceil(2))),
        };
        if let Counts::PerPixel(half) = samples.half_a()
            && parity.is_none_or(|parity| !parity.eq(half.iter().copied()))
        {
            put(Statistic::HalfA, half);
        }
    }
}

/// Refuses counts without a meaning, so that everything written can be read.
pub(crate) fn check_counts(file: &Path, samples: &Samples, width: usize) -> Result<(), IoError> {
    let pixels = match (samples.total(), samples.half_a()) {
        (Counts::PerPixel(counts), _) | (_, Counts::PerPixel(counts)) => counts.len(),
        _ => 1,
    };
    for pixel in 0..pixels {
        let (total, half) = (samples.total().at(pixel), samples.half_a().at(pixel));
        let (layer, value, expected) = if total == 0 {
            ("samples", total, "at least 1 sample")
        } else if half > total {
            ("samples.halfA", half, "at most as many samples as the pixel has")
        } else {
            continue;
        };
        let (x, y) = (pixel % width, pixel / width);
        let (file, layer, value) = (file.to_owned(), layer.to_owned(), value.into());
        return Err(IoError::Count { file, layer, x, y, value, expected });
    }
    Ok(())
}
