//! Frames, references and images to and from multi-layer OpenEXR.
//!
//! One single-part file per frame, 32-bit floats, ZIP-compressed, with layers in the channel names so that other
//! programs show them: `R G B`, `variance.R…` (variance *of the mean*), `halfA.R…`, `halfB.R…`, then per feature
//! `albedo.R…`, `albedo.variance.R…`, `albedo.halfA.R…`, `albedo.halfB.R…` and likewise `normal.X…`, `depth.Z`,
//! `visibility.Y`, `caustics.Y`, `brdf.R…`, `direct.R…`, `motion.X/Y`, `material.Y`; the virtual flash as
//! `flashBase.R…`, `flashLight.R…` and `flashCov.R…`, or ready-made as `flash.R…`; sample counts that differ from pixel
//! to pixel as `samples.Y` and `samples.halfA.Y` (unsigned int); the parts of a reference as `part0.R…`.
//!
//! Header attributes: `scene`, `renderer`, `integrator`, `sampler` (text), `seed` (int, or text above 2³¹−1), `spp` (int, or
//! the mean as double), `sppHalfA` where it is not ⌈spp/2⌉, `sampling` (`independent` or `low-discrepancy`), `filter` (`box`
//! or `point`), `cameraToWorld` (m44f: row by row for column vectors, last row 0 0 0 1), `verticalFov` (degrees), and
//! anything else as text under its own name. `renderSeconds` and `renderThreads` are read and not written: what a clock
//! said is no part of a frame, and equal frames are equal files.
//!
//! Numbers round-trip bit for bit. Writes are atomic. Frames that numbers are made from are read with
//! [`read_checked_frame`]. Files may come from strangers: whatever is in them, reading
//! ends in a frame or in an [`IoError`] that names file, layer and channel.

mod aliases;
mod alignment;
mod arrange;
mod atomic;
mod attributes;
mod decode;
mod destination;
mod encode;
mod error;
mod folder;
mod layers;
mod limits;
mod names;
mod pfm;
mod read;
mod replace;
mod window;
mod write;

pub use atomic::write_atomically;
pub use destination::{Destination, same_file};
pub use error::IoError;
pub use folder::{FolderFrame, FrameFolder, scan_scenes};
pub use limits::MAX_DECODED_BYTES;
pub use pfm::{read_pfm, write_pfm};
pub use read::{
    FileInfo, FileOrigin, FrameFile, ReadOptions, read_attributes, read_checked_frame,
    read_checked_reference, read_color, read_frame, read_frame_file, read_image, read_info, read_origin,
    read_reference,
};
pub use window::{Area, Window};
pub use write::{write_frame, write_image, write_image_at, write_reference};
