//! PNG images to linear colours.

use std::io::Cursor;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use png::{ColorType, Decoder, Transformations};

/// The most pixels an image may have.
const MOST_PIXELS: usize = 1 << 25;

/// Linear colours of an image.
#[derive(Debug, Clone)]
pub struct Decoded {
    pub width: usize,
    pub height: usize,
    pub pixels: Arc<[Vec3]>,
}

impl Decoded {
    /// The colour of all pixels, if it is the same.
    pub fn uniform(&self) -> Option<Vec3> {
        let first = *self.pixels.first()?;
        self.pixels.iter().all(|p| *p == first).then_some(first)
    }

    /// The mean colour.
    pub fn mean(&self) -> Vec3 {
        let sum = self.pixels.iter().fold(DVec3::ZERO, |sum, p| sum + p.as_dvec3());
        (sum / self.pixels.len().max(1) as f64).as_vec3()
    }
}

/// Whether the bytes begin as a PNG file does.
pub fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x89PNG\r\n\x1a\n")
}

pub fn decode(bytes: &[u8]) -> Result<Decoded, String> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    if width == 0 || height == 0 || width.saturating_mul(height) > MOST_PIXELS {
        return Err(format!("{width}x{height} pixels, allowed are 1 to {MOST_PIXELS} in all"));
    }
    let size = reader.output_buffer_size().ok_or("too large")?;
    let mut buffer = vec![0; size];
    let frame = reader.next_frame(&mut buffer).map_err(|e| e.to_string())?;
    let channels = frame.color_type.samples();
    let gray = matches!(frame.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let linear: Vec<f32> = (0..=255u8).map(linear).collect();
    let value = |p: &[u8], c: usize| linear[usize::from(p[if gray { 0 } else { c }])];
    let pixels = buffer[..width * height * channels]
        .chunks_exact(channels)
        .map(|p| Vec3::new(value(p, 0), value(p, 1), value(p, 2)))
        .collect();
    Ok(Decoded { width, height, pixels })
}

/// The sRGB transfer function.
fn linear(byte: u8) -> f32 {
    let v = f32::from(byte) / 255.0;
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}
