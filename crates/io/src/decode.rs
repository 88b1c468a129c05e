//! The only module that lets the EXR decoder loose on a file.
//!
//! Files are hostile until proven otherwise: sizes are checked against limits and against the length of the file
//! before anything is allocated, every pixel must be covered exactly once, and a panic of the decoder becomes a
//! typed error.

use std::cell::Cell;
use std::collections::HashSet;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock, TileCoordinates};
use exr::block::lines::LineRef;
use exr::block::reader::{ChunksReader as _, Reader};
use exr::math::Vec2;
use exr::meta::attribute::{Compression, SampleType};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::f16;

use crate::attributes::{Attributes, decode_text};
use crate::window::Window;
use crate::{IoError, limits};

/// Most pixels that a file may claim.
pub(crate) const MAX_PIXELS: usize = 1 << 28;

/// Most bytes of pixels, before compression, that a file may claim.
const MAX_BYTES: u128 = 1 << 33;

/// A channel as the header describes it.
#[derive(Debug, Clone)]
pub(crate) struct Channel {
    pub(crate) name: String,
    kind: SampleType,
}

/// A file whose header was read and found sound.
pub(crate) struct Opened {
    pub(crate) file: PathBuf,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) window: Window,
    /// In file order.
    pub(crate) channels: Vec<Channel>,
    pub(crate) attributes: Attributes,
    /// Whether the compression changes numbers by more than rounding them.
    pub(crate) lossy: bool,
    file_bytes: u64,
    raw_bytes: u64,
    limit: Option<u64>,
    reader: Reader<Watched>,
    ended: Rc<Cell<bool>>,
}

/// Where the values of a channel go.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Target {
    /// Nowhere.
    Skip,
    /// Into a plane of a float buffer.
    Float { buffer: usize, plane: usize },
    /// Into a buffer of whole numbers.
    Count { buffer: usize },
}

/// Decoded values, in the order in which buffers were asked for.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) floats: Vec<Vec<f32>>,
    pub(crate) counts: Vec<Vec<u32>>,
    /// The first value of each count buffer that is no whole number in the range of `u32`: pixel and value.
    pub(crate) no_count: Vec<Option<(usize, f64)>>,
}

impl Opened {
    pub(crate) fn open(file: &Path) -> Result<Self, IoError> {
        let opened = File::open(file).map_err(|cause| IoError::read(file, cause))?;
        let bytes = opened.metadata().map_err(|cause| IoError::read(file, cause))?.len();
        let ended = Rc::new(Cell::new(false));
        let mut watched = Watched { inner: BufReader::new(opened), ended: Rc::clone(&ended) };
        check_magic(file, &mut watched)?;
        // Read the header leniently first, only to name the channel or size that is at fault.
        let meta = guard(file, &ended, || MetaData::read_from_buffered(&mut watched, false))?;
        sound_header(file, &meta, bytes)?;
        watched.seek(SeekFrom::Start(0)).map_err(|cause| IoError::read(file, cause))?;
        let reader = guard(file, &ended, || exr::block::read(watched, false))?;
        // The same bytes as above, unless somebody is writing to the file.
        let header = sound_header(file, reader.meta_data(), bytes)?;
        let attributes = guard(file, &ended, || {
            let named = header.all_named_attributes();
            Ok(named.map(|(name, value)| (decode_text(name), value)).collect())
        })?;
        let describe = |channel: &exr::meta::attribute::ChannelDescription| Channel {
            name: decode_text(channel.name.as_slice()),
            kind: channel.sample_type,
        };
        let lossy = matches!(
            header.compression,
            Compression::B44 | Compression::B44A | Compression::DWAA(_) | Compression::DWAB(_)
        );
        Ok(Self {
            file: file.to_owned(),
            lossy,
            width: header.layer_size.width(),
            height: header.layer_size.height(),
            window: Window::of(header),
            channels: header.channels.list.iter().map(describe).collect(),
            attributes,
            file_bytes: bytes,
            // Below 2^33 by `sound_header`.
            raw_bytes: (header.layer_size.area() * header.channels.bytes_per_pixel) as u64,
            limit: None,
            reader,
            ended,
        })
    }

    /// Sets the most bytes that decoded values may take, instead of what [`crate::ReadOptions`] says by default.
    pub(crate) fn within(self, limit: Option<u64>) -> Self {
        Self { limit, ..self }
    }

    /// Refuses to allocate, or to decompress, far more than a file of this size is likely to hold.
    fn check_decoded(&self, planes: usize) -> Result<(), IoError> {
        let decoded = 4 * (self.width * self.height) as u64 * planes as u64;
        let likely = limits::likely_bytes(self.file_bytes);
        let (bytes, allowed) = match self.limit {
            Some(limit) => (decoded, limit),
            None if self.raw_bytes > likely => (self.raw_bytes, likely),
            None => (decoded, likely.min(limits::MAX_DECODED_BYTES)),
        };
        if bytes <= allowed {
            return Ok(());
        }
        let (file, width, height) = (self.file.clone(), self.width, self.height);
        Err(IoError::Memory { file, width, height, bytes, allowed, file_bytes: self.file_bytes })
    }

    /// Decodes the channels that have a target, one target per channel. `float_planes` holds the number of planes of
    /// each float buffer.
    pub(crate) fn decode(
        self,
        targets: &[Target],
        float_planes: &[usize],
        count_buffers: usize,
    ) -> Result<Buffers, IoError> {
        self.check_decoded(float_planes.iter().sum::<usize>() + count_buffers)?;
        let Self { file, width, height, channels, reader, ended, .. } = self;
        let largest_level = |_: &MetaData, tile: TileCoordinates, _| tile.is_largest_resolution_level();
        // This reads the table of block positions, so that a file that lacks it ends here, before allocation.
        let mut chunks = guard(&file, &ended, || reader.filter_chunks(false, largest_level))?;
        let meta = chunks.meta_data().clone();
        let header = &meta.headers[0]; // `sound_header` saw one
        let mut out = Buffers { no_count: vec![None; count_buffers], ..Buffers::default() };
        for &planes in float_planes {
            out.floats.push(zeros(&file, width * height * planes)?);
        }
        for _ in 0..count_buffers {
            out.counts.push(zeros(&file, width * height)?);
        }
        let mut covered = Coverage::default();
        // One block after the other on this thread: the decoder's own thread pool would end the process if a
        // damaged block made it panic.
        while let Some(chunk) = guard(&file, &ended, || chunks.next().transpose())? {
            check_claims(&file, header, &chunk)?;
            let block = guard(&file, &ended, || UncompressedBlock::decompress_chunk(chunk, &meta, true))?;
            covered.add(&file, &block, width, height)?;
            for line in block.lines(&header.channels) {
                let index = line.location.channel;
                out.store(&line, channels[index].kind, targets[index], width, height);
            }
        }
        if covered.pixels != width * height {
            let what =
                format!("{} of {} pixels are missing", width * height - covered.pixels, width * height);
            return Err(IoError::malformed(&file, what));
        }
        Ok(out)
    }
}

impl Buffers {
    fn store(&mut self, line: &LineRef<'_>, kind: SampleType, target: Target, width: usize, height: usize) {
        let start = line.location.position.y() * width + line.location.position.x();
        let range = start..start + line.location.sample_count;
        match target {
            Target::Skip => {}
            Target::Float { buffer, plane } => {
                let row = &mut self.floats[buffer][plane * width * height..][range];
                match kind {
                    SampleType::F32 => convert(line.value, row, f32::from_ne_bytes),
                    SampleType::F16 => convert(line.value, row, |b| f16::from_ne_bytes(b).to_f32()),
                    SampleType::U32 => convert(line.value, row, |b| u32::from_ne_bytes(b) as f32),
                }
            }
            Target::Count { buffer } => {
                let row = &mut self.counts[buffer][range];
                let (mut pixel, mut wrong) = (start, None);
                let mut count = |value: f64| {
                    let whole = crate::attributes::whole(value);
                    if whole.is_none() {
                        wrong.get_or_insert((pixel, value));
                    }
                    pixel += 1;
                    whole.unwrap_or(0)
                };
                match kind {
                    SampleType::U32 => convert(line.value, row, u32::from_ne_bytes),
                    SampleType::F32 => convert(line.value, row, |b| count(f32::from_ne_bytes(b).into())),
                    SampleType::F16 => convert(line.value, row, |b| count(f16::from_ne_bytes(b).to_f64())),
                }
                self.no_count[buffer] = self.no_count[buffer].or(wrong);
            }
        }
    }
}

fn convert<const N: usize, T>(bytes: &[u8], out: &mut [T], mut value: impl FnMut([u8; N]) -> T) {
    for (out, bytes) in out.iter_mut().zip(bytes.as_chunks::<N>().0) {
        *out = value(*bytes);
    }
}

/// Which blocks were seen: a damaged table of positions can point to one block twice and to another never.
#[derive(Default)]
struct Coverage {
    blocks: HashSet<(usize, usize)>,
    pixels: usize,
}

impl Coverage {
    fn add(
        &mut self,
        file: &Path,
        block: &UncompressedBlock,
        width: usize,
        height: usize,
    ) -> Result<(), IoError> {
        let (at, size) = (block.index.pixel_position, block.index.pixel_size);
        let inside = at.x() + size.x() <= width && at.y() + size.y() <= height;
        if !inside || block.index.level != Vec2(0, 0) || !self.blocks.insert((at.x(), at.y())) {
            let what = format!("the block at ({}, {}) is misplaced or there twice", at.x(), at.y());
            return Err(IoError::malformed(file, what));
        }
        self.pixels += size.area();
        Ok(())
    }
}

fn check_magic(file: &Path, reader: &mut Watched) -> Result<(), IoError> {
    let mut magic = [0; 4];
    let read = reader.read_exact(&mut magic).and_then(|()| reader.seek(SeekFrom::Start(0)));
    match read {
        Ok(_) if magic == exr::meta::magic_number::BYTES => Ok(()),
        Err(cause) if cause.kind() != io::ErrorKind::UnexpectedEof => Err(IoError::read(file, cause)),
        _ => Err(IoError::NotExr { file: file.to_owned() }),
    }
}

/// The only header of the file, if all that it says can be believed.
fn sound_header<'m>(file: &Path, meta: &'m MetaData, file_bytes: u64) -> Result<&'m Header, IoError> {
    let [header] = meta.headers.as_slice() else {
        let parts = meta.headers.len();
        let what = format!("{parts} parts; a frame is one part with its layers in the channel names");
        return Err(IoError::unsupported(file, what));
    };
    if meta.requirements.has_deep_data || header.deep {
        return Err(IoError::unsupported(file, "deep data"));
    }
    check_channels(file, header)?;
    check_sizes(file, header, file_bytes)?;
    Ok(header)
}

fn check_channels(file: &Path, header: &Header) -> Result<(), IoError> {
    let mut seen = HashSet::new();
    for channel in &header.channels.list {
        let name = decode_text(channel.name.as_slice());
        let Vec2(x, y) = channel.sampling;
        if (x, y) != (1, 1) {
            return Err(IoError::Subsampled { file: file.to_owned(), channel: name, x, y });
        }
        if !seen.insert(channel.name.as_slice()) {
            let layer = name.rsplit_once('.').map_or("", |(layer, _)| layer).to_owned();
            return Err(IoError::DuplicateChannel { file: file.to_owned(), layer, channel: name });
        }
    }
    Ok(())
}

fn check_sizes(file: &Path, header: &Header, file_bytes: u64) -> Result<(), IoError> {
    let Vec2(width, height) = header.layer_size;
    let channels = header.channels.list.len();
    let too_large =
        |limit: String| IoError::TooLarge { file: file.to_owned(), width, height, channels, limit };
    let Some(pixels) = width.checked_mul(height).filter(|&pixels| pixels <= MAX_PIXELS) else {
        return Err(too_large(format!("at most {MAX_PIXELS} pixels are read")));
    };
    if pixels == 0 || channels == 0 {
        return Err(IoError::malformed(file, "no pixels or no channels"));
    }
    let raw = pixels as u128 * header.channels.bytes_per_pixel as u128;
    // How far a compressed byte can unfold. Deflate stays below 1032 and run lengths below that; the lossy
    // DWA stacks both.
    let unfold = match header.compression {
        Compression::DWAA(_) | Compression::DWAB(_) => 1 << 16,
        _ => 2048,
    };
    if raw > MAX_BYTES {
        return Err(too_large(format!("at most {MAX_BYTES} bytes are read")));
    }
    if raw > u128::from(file_bytes) * unfold {
        return Err(too_large(format!("a file of {file_bytes} bytes cannot hold that")));
    }
    if let BlockDescription::Tiles(tiles) = header.blocks {
        let Vec2(columns, rows) = tiles.tile_size;
        let tile = columns as u128 * rows as u128 * header.channels.bytes_per_pixel as u128;
        if tile > 4 * raw + (1 << 26) {
            return Err(too_large(format!("its tiles of {columns}×{rows} are larger still")));
        }
    }
    Ok(())
}

/// DWA blocks begin with the sizes of their sections, which the decoder allocates unseen: 1 TB would end the process.
fn check_claims(file: &Path, header: &Header, chunk: &Chunk) -> Result<(), IoError> {
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let bytes = match &chunk.compressed_block {
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        _ => return Ok(()), // deep data, which the decoder refuses
    };
    let pixels = guard(file, &Cell::new(false), || {
        header.get_absolute_block_pixel_coordinates(header.get_block_data_indices(&chunk.compressed_block)?)
    })?;
    let raw = pixels.size.area() * header.channels.bytes_per_pixel;
    if bytes.len() == raw {
        return Ok(()); // stored as it is, because it would not shrink
    }
    // A version, nine sizes, and the kind of entropy coding, of 8 bytes each. Blocks of 8×8 values count in full at
    // the edges, hence the factor.
    let limit = 64 * (raw as u64 + 64);
    let mut sizes = bytes.as_chunks::<8>().0.iter().skip(1).take(9).map(|size| u64::from_le_bytes(*size));
    match sizes.find(|&size| size > limit) {
        Some(size) => Err(IoError::malformed(file, format!("a compressed block claims {size} bytes"))),
        None => Ok(()),
    }
}

fn zeros<T: Clone + Default>(file: &Path, values: usize) -> Result<Vec<T>, IoError> {
    // Sizes are plausible at this point, but the machine may still not have the memory.
    let probe = Vec::<T>::new().try_reserve_exact(values);
    probe.map_err(|_| IoError::read(file, io::Error::from(io::ErrorKind::OutOfMemory)))?;
    // Zeroed by the system page by page as they are used, so that pages that no block fills cost nothing.
    Ok(vec![T::default(); values])
}

/// Calls the decoder and turns its errors into ours.
///
/// The decoder has asserts and unchecked arithmetic that damaged input can reach, so a panic is caught
/// and becomes [`IoError::Malformed`]. Everything it could leave half-done is dropped by the caller.
fn guard<T>(
    file: &Path,
    ended: &Cell<bool>,
    call: impl FnOnce() -> exr::error::Result<T>,
) -> Result<T, IoError> {
    use exr::error::Error;
    match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(Error::Io(cause))) if cause.kind() == io::ErrorKind::InvalidInput => {
            // What the system says to a position beyond all files.
            Err(IoError::malformed(file, "a block position is impossible"))
        }
        Ok(Err(Error::Io(cause))) => Err(IoError::read(file, cause)),
        Ok(Err(Error::NotSupported(what))) => Err(IoError::unsupported(file, what)),
        Ok(Err(error)) if ended.get() => {
            Err(IoError::Truncated { file: file.to_owned(), what: error.to_string() })
        }
        Ok(Err(error)) => Err(IoError::malformed(file, error.to_string())),
        Err(panic) => {
            let said = panic.downcast_ref::<String>().cloned();
            let said = said.or_else(|| panic.downcast_ref::<&str>().map(|said| (*said).to_owned()));
            let what = said.unwrap_or_else(|| "no reason given".to_owned());
            Err(IoError::malformed(file, format!("the decoder gave up: {what}")))
        }
    }
}

/// Notes when somebody wanted more bytes than there are.
struct Watched {
    inner: BufReader<File>,
    ended: Rc<Cell<bool>>,
}

impl Read for Watched {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(out)?;
        if count == 0 && !out.is_empty() {
            self.ended.set(true);
        }
        Ok(count)
    }
}

impl Seek for Watched {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.inner.seek(position)
    }
}
