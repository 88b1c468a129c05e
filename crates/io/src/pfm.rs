//! Portable float maps: what many small programs read and write. One or three channels of 32-bit floats, rows from the
//! bottom up, no names, no compression.

use std::io;
use std::path::Path;

use noisefloor_frame::Image;

use crate::limits::MAX_DECODED_BYTES;
use crate::{Destination, IoError};

/// Writes an image of one or three planes as a portable float map, little-endian, atomically.
///
/// # Errors
/// [`IoError::Write`]; also for an image of another number of planes, which the format has no place for.
pub fn write_pfm(path: impl AsRef<Path>, image: &Image) -> Result<(), IoError> {
    let (width, height) = (image.width(), image.height());
    let kind = match image.channels() {
        1 => "Pf",
        3 => "PF",
        other => {
            let cause =
                io::Error::other(format!("a portable float map has 1 or 3 channels, this image {other}"));
            return Err(IoError::Write { file: path.as_ref().into(), cause });
        }
    };
    Destination::from(path.as_ref()).write(|out| {
        write!(out, "{kind}\n{width} {height}\n-1.0\n")?;
        for y in (0..height).rev() {
            for x in 0..width {
                for plane in image.planes() {
                    out.write_all(&plane[y * width + x].to_le_bytes())?;
                }
            }
        }
        Ok(())
    })
}

/// Reads a portable float map of either byte order.
///
/// # Errors
/// [`IoError::Read`], and [`IoError::NotPfm`] for what is not one or ends early.
pub fn read_pfm(path: impl AsRef<Path>) -> Result<Image, IoError> {
    let file = path.as_ref();
    let read = |cause| IoError::Read { file: file.into(), cause };
    let not = |what: &str| IoError::NotPfm { file: file.into(), what: what.into() };
    // A file of text and floats is no larger than what it decodes to.
    let size = std::fs::metadata(file).map_err(read)?.len();
    if size > MAX_DECODED_BYTES {
        return Err(not("it is larger than any image that is read"));
    }
    let bytes = std::fs::read(file).map_err(read)?;
    let (header, values) = header(&bytes).ok_or_else(|| not("no header of three lines"))?;
    let [kind, size, scale] = header;
    let channels = match kind {
        "Pf" => 1,
        "PF" => 3,
        _ => return Err(not("it does not begin with PF or Pf")),
    };
    let mut size = size.split_ascii_whitespace().map(str::parse::<usize>);
    let (Some(Ok(width)), Some(Ok(height)), None) = (size.next(), size.next(), size.next()) else {
        return Err(not("its second line is not width and height"));
    };
    let little = match scale.parse::<f64>() {
        Ok(scale) if scale != 0.0 && scale.is_finite() => scale < 0.0,
        _ => return Err(not("its third line is not a scale")),
    };
    let expected = width.checked_mul(height).and_then(|n| n.checked_mul(4 * channels));
    if width == 0 || height == 0 || expected != Some(values.len()) {
        return Err(not(&format!(
            "{width}×{height} pixels of {channels} channels and {} bytes",
            values.len()
        )));
    }
    let value = |c: usize, x: usize, y: usize| {
        let at = 4 * (((height - 1 - y) * width + x) * channels + c);
        let bytes = [values[at], values[at + 1], values[at + 2], values[at + 3]];
        if little { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) }
    };
    Ok(Image::from_fn(width, height, channels, value))
}

/// The three lines of the header and what follows it.
fn header(bytes: &[u8]) -> Option<([&str; 3], &[u8])> {
    let mut rest = bytes;
    let mut line = || {
        let end = rest.iter().take(100).position(|&b| b == b'\n')?;
        let (line, after) = (std::str::from_utf8(&rest[..end]).ok()?, &rest[end + 1..]);
        rest = after;
        Some(line.trim())
    };
    let lines = [line()?, line()?, line()?];
    Some((lines, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_come_back_bit_for_bit_and_rows_begin_at_the_bottom() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("image.pfm");
        for channels in [1, 3] {
            let image = Image::from_fn(3, 2, channels, |c, x, y| (c + 10 * x + 100 * y) as f32 - 0.1);
            write_pfm(&path, &image).unwrap();
            assert_eq!(read_pfm(&path).unwrap(), image);
        }
        let bytes = std::fs::read(&path).unwrap();
        assert!(bytes.starts_with(b"PF\n3 2\n-1.0\n"));
        assert_eq!(bytes[12..16], (100.0f32 - 0.1).to_le_bytes());
        let mut big: Vec<u8> = b"Pf\n1 1\n1.0\n".to_vec();
        big.extend(2.5f32.to_be_bytes());
        std::fs::write(&path, &big).unwrap();
        assert_eq!(read_pfm(&path).unwrap().data(), [2.5]);
    }

    #[test]
    fn other_files_are_refused_with_their_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("image.pfm");
        for bytes in [
            &b""[..],
            b"P6\n1 1\n255\nabc",
            b"Pf\n1 1\n-1.0\nabc",
            b"Pf\n1 1\n-1.0\nabcde",
            b"Pf\n1\n-1.0\nabcd",
            b"Pf\n0 1\n-1.0\n",
            b"Pf\n1 1\n0\nabcd",
            b"PF\n99999999999 99999999999\n-1\nabcd",
        ] {
            std::fs::write(&path, bytes).unwrap();
            let error = read_pfm(&path).unwrap_err();
            assert!(matches!(error, IoError::NotPfm { .. }), "{error}");
            assert!(error.to_string().contains("image.pfm"), "{error}");
        }
        let error = write_pfm(&path, &Image::new(2, 2, 2)).unwrap_err();
        assert!(matches!(error, IoError::Write { .. }), "{error}");
    }
}
