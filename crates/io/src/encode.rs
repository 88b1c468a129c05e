//! Planes and attributes to the bytes of a single-part, ZIP-compressed EXR file.

use std::io::Cursor;

use exr::block::UncompressedBlock;
use exr::block::writer::ChunksWriter as _;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, Compression, LineOrder, SampleType, Text};
use exr::meta::header::{Header, LayerAttributes};
use exr::meta::{BlockDescription, Headers};
use exr::prelude::SmallVec;

use crate::attributes::{Attributes, LONG_NAMES};
use crate::decode::MAX_PIXELS;
use crate::window::Window;
use crate::{Destination, IoError};

/// The values of a channel, row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Values<'a> {
    Float(&'a [f32]),
    Count(&'a [u32]),
}

/// A named channel.
#[derive(Debug, Clone)]
pub(crate) struct Plane<'a> {
    pub(crate) name: String,
    pub(crate) values: Values<'a>,
}

/// Writes the file atomically. Equal input gives equal bytes.
pub(crate) fn write(
    to: &Destination,
    width: usize,
    height: usize,
    planes: Vec<Plane<'_>>,
    attributes: Attributes,
    window: Option<&Window>,
) -> Result<(), IoError> {
    let file = to.name();
    if let Some(named) = to.file()?
        && named.extension().is_some_and(|extension| !extension.eq_ignore_ascii_case("exr"))
    {
        return Err(IoError::Extension { file: file.to_owned(), expected: ".exr" });
    }
    if width.checked_mul(height).is_none_or(|pixels| pixels > MAX_PIXELS) {
        let limit = format!("at most {MAX_PIXELS} pixels are written");
        return Err(IoError::TooLarge {
            file: file.to_owned(),
            width,
            height,
            channels: planes.len(),
            limit,
        });
    }
    let bytes = encode(width, height, planes, attributes, window)
        .map_err(|error| IoError::unsupported(file, format!("the encoder refuses: {error}")))?;
    to.write(|out| out.write_all(&bytes))
}

fn encode(
    width: usize,
    height: usize,
    mut planes: Vec<Plane<'_>>,
    mut attributes: Attributes,
    window: Option<&Window>,
) -> exr::error::Result<Vec<u8>> {
    planes.sort_by(|a, b| a.name.cmp(&b.name)); // bytewise, as the format demands
    if planes.iter().any(|plane| plane.name.len() > 31) {
        attributes.insert(LONG_NAMES.into(), exr::meta::attribute::AttributeValue::I32(1));
    }
    let name = |text: &str| Text::from_slice_unchecked(text.as_bytes());
    let describe = |plane: &Plane<'_>| {
        let kind = match plane.values {
            Values::Float(_) => SampleType::F32,
            Values::Count(_) => SampleType::U32,
        };
        ChannelDescription::new(name(&plane.name), kind, false)
    };
    let own = LayerAttributes {
        layer_position: window.map_or(Vec2(0, 0), Window::data_position),
        other: attributes.into_iter().map(|(key, value)| (name(&key), value)).collect(),
        ..LayerAttributes::default()
    };
    let channels: SmallVec<_> = planes.iter().map(describe).collect();
    let mut header = Header::new(Text::default(), (width, height), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(own);
    if let Some(window) = window {
        header.shared_attributes.display_window = window.display_bounds();
    }
    let headers: Headers = std::iter::once(header).collect();
    let raw_bytes = 4 * width * height * planes.len();

    let mut bytes = Vec::new();
    exr::block::write(Cursor::new(&mut bytes), headers, true, |meta, chunks| {
        let channels = &meta.headers[0].channels;
        let blocks = meta.collect_ordered_blocks(|index| {
            UncompressedBlock::from_lines(channels, index, |line| {
                let at = line.location;
                let start = at.position.y() * width + at.position.x();
                let range = start..start + at.sample_count;
                match planes[at.channel].values {
                    Values::Float(all) => copy(&all[range], line.value, |v| v.to_ne_bytes()),
                    Values::Count(all) => copy(&all[range], line.value, |v| v.to_ne_bytes()),
                }
            })
        });
        // A thread pool costs more than it saves on small images.
        if raw_bytes >= 1 << 22
            && let Some(mut pool) = chunks.parallel_blocks_compressor(&meta)
        {
            for (index, block) in blocks {
                pool.add_block_to_compression_queue(index, block)?;
            }
        } else {
            let mut compressor = chunks.sequential_blocks_compressor(&meta);
            for (index, block) in blocks {
                compressor.compress_block(index, block)?;
            }
        }
        Ok(())
    })?;
    sort_attributes(&mut bytes);
    Ok(bytes)
}

fn copy<T: Copy>(values: &[T], out: &mut [u8], bytes: impl Fn(T) -> [u8; 4]) {
    for (out, &value) in out.as_chunks_mut().0.iter_mut().zip(values) {
        *out = bytes(value);
    }
}

/// Brings the attributes of a single-part file into alphabetical order. The encoder leaves them in the order of a
/// randomised hash table, which would make every file unique. Attributes keep their total length, so nothing else
/// in the file moves.
fn sort_attributes(file: &mut [u8]) {
    const MAGIC_AND_VERSION: usize = 8;
    let mut found: Vec<&[u8]> = Vec::new();
    let mut at = MAGIC_AND_VERSION;
    // `name NUL type NUL length value`, and a NUL where the next name would begin.
    while file[at] != 0 {
        let text_end = |from: usize| from + file[from..].iter().take_while(|&&byte| byte != 0).count() + 1;
        let length_at = text_end(text_end(at));
        let mut length = [0; 4];
        length.copy_from_slice(&file[length_at..length_at + 4]);
        let end = length_at + 4 + u32::from_le_bytes(length) as usize;
        found.push(&file[at..end]);
        at = end;
    }
    found.sort();
    let sorted = found.concat();
    file[MAGIC_AND_VERSION..at].copy_from_slice(&sorted);
}
