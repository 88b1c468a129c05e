//! What URIs stand for: embedded data, or files beside the scene.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use crate::GltfError;

/// The most bytes that a file's buffers and images may have together, as they lie in files.
pub const MOST_BYTES: u64 = 1 << 32;

/// Reads buffers and images, and stops where they would fill the machine's memory: a short file can name a long one
/// a thousand times.
pub struct Fetcher<'a> {
    folder: &'a Path,
    left: u64,
}

impl<'a> Fetcher<'a> {
    /// For URIs relative to this folder.
    pub fn new(folder: &'a Path) -> Self {
        Self { folder, left: MOST_BYTES }
    }

    /// The bytes that a URI stands for: embedded, or of a regular file. `what`: the part of the file that names it.
    pub fn fetch(&mut self, uri: &str, what: &str) -> Result<Vec<u8>, GltfError> {
        let bytes = match uri.strip_prefix("data:") {
            Some(data) => embedded(data, what)?,
            None => {
                let path = locate(uri, self.folder, what)?;
                let size = size_of_file(&path)?;
                if size > self.left {
                    return Err(too_much(what));
                }
                read_file(&path)?
            }
        };
        self.left = self.left.checked_sub(bytes.len() as u64).ok_or_else(|| too_much(what))?;
        Ok(bytes)
    }
}

/// The file that a relative URI names; an error for the network and for names that are no text.
fn locate(uri: &str, folder: &Path, what: &str) -> Result<PathBuf, GltfError> {
    if uri.contains("://") {
        return Err(GltfError::data(what, "is on the network, but only files are read"));
    }
    let named = file_of(uri, folder);
    named.ok_or_else(|| GltfError::data(what, format!("`{uri}` does not escape UTF-8 text")))
}

/// The file that a URI names; none for embedded data, for the network and for names that are no text. A file whose
/// name has escapes that were not meant as such is found, too, if the other does not exist.
pub fn file_of(uri: &str, folder: &Path) -> Option<PathBuf> {
    if uri.starts_with("data:") || uri.contains("://") {
        return None;
    }
    let (decoded, literal) = (String::from_utf8(unescape(uri).into_owned()).ok()?, folder.join(uri));
    let decoded = folder.join(decoded);
    Some(if !decoded.exists() && literal.is_file() { literal } else { decoded })
}

fn too_much(what: &str) -> GltfError {
    GltfError::data(what, format!("with it, buffers and images have more than {MOST_BYTES} bytes"))
}

/// Everything behind `data:`.
fn embedded(data: &str, what: &str) -> Result<Vec<u8>, GltfError> {
    let wrong = |problem: String| GltfError::data(what, problem);
    let (kind, data) = data.split_once(',').ok_or_else(|| wrong("has a data URI without a comma".into()))?;
    let bytes = unescape(data);
    if !kind.ends_with(";base64") {
        return Ok(bytes.into_owned());
    }
    let engine = GeneralPurpose::new(
        &STANDARD,
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
    );
    engine.decode(bytes.as_ref()).map_err(|e| wrong(format!("has a data URI that is not base64: {e}")))
}

/// Bytes with every `%` and two hexadecimal digits replaced by their byte. A `%` before anything else stands for
/// itself: many programs write it so.
fn unescape(uri: &str) -> Cow<'_, [u8]> {
    let bytes = uri.as_bytes();
    if !bytes.contains(&b'%') {
        return Cow::Borrowed(bytes);
    }
    let digit = |at: usize| bytes.get(at).and_then(|b| char::from(*b).to_digit(16));
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        match (bytes[at], digit(at + 1), digit(at + 2)) {
            (b'%', Some(high), Some(low)) => {
                out.push((16 * high + low) as u8);
                at += 3;
            }
            (byte, ..) => {
                out.push(byte);
                at += 1;
            }
        }
    }
    Cow::Owned(out)
}

fn io_error(path: &Path) -> impl Fn(std::io::Error) -> GltfError + '_ {
    |source| GltfError::Io { path: path.to_owned(), source }
}

fn size_of_file(path: &Path) -> Result<u64, GltfError> {
    let found = std::fs::metadata(path).map_err(io_error(path))?;
    if !found.is_file() {
        return Err(io_error(path)(std::io::Error::other("not a regular file")));
    }
    Ok(found.len())
}

/// A regular file, whole; a device or a pipe may never end.
pub fn read_file(path: &Path) -> Result<Vec<u8>, GltfError> {
    let size = size_of_file(path)?;
    if size > MOST_BYTES {
        let problem = format!("{size} bytes, allowed are {MOST_BYTES}");
        return Err(io_error(path)(std::io::Error::other(problem)));
    }
    std::fs::read(path).map_err(io_error(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_escape_is_decoded_and_a_bare_percent_sign_stands_for_itself() {
        for (uri, name) in [
            ("tex%20%C3%A9%231.png", "tex é#1.png"),
            ("100%.png", "100%.png"),
            ("a%2g%2", "a%2g%2"),
            ("%25%3f%3F", "%??"),
        ] {
            assert_eq!(unescape(uri).as_ref(), name.as_bytes(), "{uri}");
        }
    }

    #[test]
    fn data_uris_are_read_with_and_without_base64_padding_and_escapes() {
        for data in
            [";base64,AAEC/w==", ";base64,AAEC/w", ";base64,AAEC%2Fw%3D%3D", "text/plain,%00%01%02%FF"]
        {
            assert_eq!(embedded(data, "buffer 0").unwrap(), [0, 1, 2, 255], "{data}");
        }
        for bad in ["", "x;base64", ";base64,!!", ";base64,A"] {
            let told = embedded(bad, "buffer 7").expect_err(bad).to_string();
            assert!(told.contains("buffer 7"), "{told}");
        }
    }
}
