#![doc = include_str!("../README.md")]

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
