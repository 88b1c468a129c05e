//! A study's folder: records, images, and what an analysis needs to work from them alone.

mod kept;
mod layout;
mod lock;
mod records;
mod superseded;
mod sweep;
mod write;

pub(crate) use kept::{FolderImages, damaged, hash_of, whole};
pub(crate) use layout::Layout;
pub(crate) use lock::Lock;
pub(crate) use records::Records;
pub(crate) use superseded::Superseded;
pub(crate) use sweep::sweep;
pub(crate) use write::{append_lines, read_json, write_json, write_json_lines, write_whole};
