//! Compressed lines of JSON.

use std::io::{Read as _, Write as _};
use std::path::Path;

use flate2::{Compression, GzBuilder, read::MultiGzDecoder};
use serde::Serialize;

use crate::error::HarnessError;
use crate::store::write_whole;

/// Most bytes that are unpacked: a file of a few megabytes can hold as many as a disk.
const MOST_BYTES: u64 = 1 << 30;

/// One line per value; equal values give equal bytes.
pub(super) fn write<T: Serialize>(path: &Path, lines: &[T]) -> Result<(), HarnessError> {
    // Without a time and a name in the header.
    let mut packed = GzBuilder::new().write(Vec::new(), Compression::best());
    for line in lines {
        let line = serde_json::to_vec(line).map_err(|e| HarnessError::kept(path, e))?;
        let written = packed.write_all(&line).and_then(|()| packed.write_all(b"\n"));
        written.map_err(HarnessError::io("write", path))?;
    }
    write_whole(path, &packed.finish().map_err(HarnessError::io("write", path))?)
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>, HarnessError> {
    let file = std::fs::File::open(path).map_err(HarnessError::io("read", path))?;
    let mut bytes = Vec::new();
    MultiGzDecoder::new(file)
        .take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(HarnessError::io("unpack", path))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(HarnessError::kept(
            path,
            format!("more than {MOST_BYTES} bytes, the most that are read"),
        ));
    }
    Ok(bytes)
}
