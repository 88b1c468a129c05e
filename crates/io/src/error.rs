use std::io;
use std::path::{Path, PathBuf};

use noisefloor_frame::FrameError;
use thiserror::Error;

use crate::Window;

/// What can go wrong with a file or a folder. Every message starts with its path.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IoError {
    /// The file or folder cannot be opened or read.
    #[error("{file}: cannot read: {cause}")]
    Read {
        /// File or folder.
        file: PathBuf,
        /// What the operating system says.
        cause: io::Error,
    },
    /// The file cannot be written: missing or unwritable folder, full disk. Nothing was left behind, and a
    /// file that was there before is unchanged.
    #[error("{file}: cannot write: {cause}")]
    Write {
        /// The file that was to be written.
        file: PathBuf,
        /// What the operating system says.
        cause: io::Error,
    },
    /// An output whose name belongs to another kind of file.
    #[error("{file}: an OpenEXR image is written, so its name must end in {expected}")]
    Extension {
        /// The file that was to be written.
        file: PathBuf,
        /// How its name may end.
        expected: &'static str,
    },
    /// The first four bytes are not those of OpenEXR.
    #[error("{file}: not an OpenEXR file")]
    NotExr {
        /// File.
        file: PathBuf,
    },
    /// A portable float map was expected.
    #[error("{file}: not a portable float map: {what}")]
    NotPfm {
        /// File.
        file: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// The file ends before its contents do.
    #[error("{file}: the file is truncated: {what}")]
    Truncated {
        /// File.
        file: PathBuf,
        /// What is missing.
        what: String,
    },
    /// The file contradicts itself or its compressed data are damaged.
    #[error("{file}: malformed OpenEXR: {what}")]
    Malformed {
        /// File.
        file: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// A valid file of a kind that holds no frame: deep data, several parts, an unknown compression.
    #[error("{file}: unsupported OpenEXR: {what}")]
    Unsupported {
        /// File.
        file: PathBuf,
        /// What is not supported.
        what: String,
    },
    /// The header claims more pixels than are allowed, or more than a file of its size can hold.
    #[error("{file}: claims {width}×{height} pixels with {channels} channels; {limit}")]
    TooLarge {
        /// File.
        file: PathBuf,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Channels.
        channels: usize,
        /// The limit that is exceeded.
        limit: String,
    },
    /// What is to be read takes more memory once decoded than is allowed.
    #[error(
        "{file}: {width}×{height} pixels take {bytes} bytes once decoded; allowed for a file of {file_bytes} bytes are \
         {allowed} (to read it all the same: `denoise --max-memory`, or `max_decoded_bytes` of the library)"
    )]
    Memory {
        /// File.
        file: PathBuf,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Bytes of the values that were to be decoded.
        bytes: u64,
        /// The most that is allowed.
        allowed: u64,
        /// Size of the file.
        file_bytes: u64,
    },
    /// A layer that must be there is not.
    #[error("{file}: no layer `{layer}`, which {needed_by} needs")]
    MissingLayer {
        /// File.
        file: PathBuf,
        /// The layer, such as `color` (channels R, G, B without a dot) or `albedo.halfB`.
        layer: String,
        /// What asks for it.
        needed_by: String,
    },
    /// A layer lacks one of its channels.
    #[error("{file}: layer `{layer}` has no channel `{channel}` (its channels are {expected})")]
    IncompleteLayer {
        /// File.
        file: PathBuf,
        /// Layer.
        layer: String,
        /// The missing channel.
        channel: String,
        /// All channels of such a layer.
        expected: String,
    },
    /// A layer has a channel that does not belong to it, such as `normal.R`.
    #[error("{file}: layer `{layer}` has a channel `{channel}`, but its channels are {expected}")]
    UnexpectedChannel {
        /// File.
        file: PathBuf,
        /// Layer.
        layer: String,
        /// The channel found.
        channel: String,
        /// All channels of such a layer.
        expected: String,
    },
    /// A channel name that means nothing here, or a feature whose name would be read as something else.
    #[error("{file}: channel `{channel}` of layer `{layer}` is mislabelled: {why}")]
    Mislabelled {
        /// File.
        file: PathBuf,
        /// Layer; empty if the name has none.
        layer: String,
        /// Channel name, as in the file.
        channel: String,
        /// Why the name cannot be used.
        why: String,
    },
    /// Two channels with one meaning.
    #[error("{file}: channel `{channel}` of layer `{layer}` is there twice")]
    DuplicateChannel {
        /// File.
        file: PathBuf,
        /// Layer.
        layer: String,
        /// Channel.
        channel: String,
    },
    /// Two layers that exclude each other.
    #[error("{file}: layers `{layer}` and `{other}` exclude each other")]
    ConflictingLayers {
        /// File.
        file: PathBuf,
        /// One.
        layer: String,
        /// The other.
        other: String,
    },
    /// A channel has fewer samples than the image has pixels.
    #[error("{file}: channel `{channel}` is subsampled {x}×{y}; only full-resolution channels are read")]
    Subsampled {
        /// File.
        file: PathBuf,
        /// Full channel name.
        channel: String,
        /// Horizontal step.
        x: usize,
        /// Vertical step.
        y: usize,
    },
    /// A header attribute has a value that cannot be used.
    #[error("{file}: header attribute `{name}` is `{value}`, expected {expected}")]
    Attribute {
        /// File.
        file: PathBuf,
        /// Attribute.
        name: String,
        /// Its value as text.
        value: String,
        /// Allowed values.
        expected: &'static str,
    },
    /// Neither the header nor the caller says how many samples per pixel were taken.
    #[error(
        "{file}: the header does not say how many samples per pixel were taken; give it with --spp, with `spp` in the \
         study file, or as header attribute `spp`"
    )]
    MissingSpp {
        /// File.
        file: PathBuf,
    },
    /// A per-pixel sample count that is none.
    #[error("{file}: layer `{layer}`, channel `Y` holds {value} at pixel ({x}, {y}), expected {expected}")]
    Count {
        /// File.
        file: PathBuf,
        /// `samples` or `samples.halfA`.
        layer: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// The value.
        value: f64,
        /// Allowed values.
        expected: &'static str,
    },
    /// The parts of the frame do not fit together.
    #[error("{file}: {cause}")]
    Frame {
        /// File.
        file: PathBuf,
        /// What does not fit.
        cause: Box<FrameError>,
    },
    /// A folder without any frame (a reference alone is none).
    #[error("{folder}: no frames (*.exr) here{}", if *.children { " nor in its direct sub-folders" } else { "" })]
    NoFrames {
        /// Folder.
        folder: PathBuf,
        /// Whether sub-folders were looked at too.
        children: bool,
    },
    /// A folder of frames without a reference.
    #[error(
        "{folder}: no reference: one of its {files} files must have `reference`, `ref` or `gt` in its name"
    )]
    NoReference {
        /// Folder.
        folder: PathBuf,
        /// EXR files found.
        files: usize,
    },
    /// A folder of frames with more than one reference.
    #[error("{folder}: `{first}` and `{second}` are both named as the reference")]
    ManyReferences {
        /// Folder.
        folder: PathBuf,
        /// One file name.
        first: String,
        /// Another.
        second: String,
    },
    /// Two files that are to be held against each other differ in size.
    #[error("{file}: is {width}×{height}, but {other} is {expected_width}×{expected_height}")]
    SizeMismatch {
        /// File.
        file: PathBuf,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// The file that it is held against.
        other: PathBuf,
        /// Columns of that.
        expected_width: usize,
        /// Rows of that.
        expected_height: usize,
    },
    /// Two files of equal size whose pixels stand at different places of the picture.
    #[error(
        "{file} has {}, but {other} has {}: their pixels are not the same places of the picture", windows[0], windows[1]
    )]
    WindowMismatch {
        /// File.
        file: PathBuf,
        /// The file that it is held against.
        other: PathBuf,
        /// The windows of the one and of the other.
        windows: Box<[Window; 2]>,
    },
}

impl IoError {
    pub(crate) fn read(file: &Path, cause: io::Error) -> Self {
        Self::Read { file: file.to_owned(), cause }
    }

    pub(crate) fn write(file: &Path, cause: io::Error) -> Self {
        Self::Write { file: file.to_owned(), cause }
    }

    pub(crate) fn malformed(file: &Path, what: impl Into<String>) -> Self {
        Self::Malformed { file: file.to_owned(), what: what.into() }
    }

    pub(crate) fn unsupported(file: &Path, what: impl Into<String>) -> Self {
        Self::Unsupported { file: file.to_owned(), what: what.into() }
    }

    pub(crate) fn frame(file: &Path, cause: FrameError) -> Self {
        Self::Frame { file: file.to_owned(), cause: Box::new(cause) }
    }
}
