//! Single pictures as 8-bit PNG: radiance through the display's curve, and error maps on a colour scale.

use noisefloor_frame::Image;
use noisefloor_metrics::tone_map;

use crate::error::ReportError;

/// Colour of pixels that are not finite: no exposure and no scale makes it.
pub const NON_FINITE_COLOR: [u8; 3] = [255, 0, 255];

/// Viridis (van der Walt and Smith) at equal steps: lightness grows evenly, and people with a colour vision deficiency
/// see the same order. The page's scripts have the same colours.
const VIRIDIS: [[u8; 3]; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x24, 0x75],
    [0x41, 0x44, 0x87],
    [0x35, 0x5f, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x22, 0xa8, 0x84],
    [0x44, 0xbf, 0x70],
    [0x7a, 0xd1, 0x51],
    [0xbd, 0xdf, 0x26],
    [0xfd, 0xe7, 0x25],
];

/// A PNG file and what it cannot show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// The file.
    pub png: Vec<u8>,
    /// Pixels with a value that is NaN or infinite, drawn in [`NON_FINITE_COLOR`].
    pub non_finite_pixels: usize,
    /// Finite pixels with a value that is brighter than white at this exposure, or above the scale.
    pub clipped_pixels: usize,
}

/// An image as a display shows it: times 2^`stops`, clamped to 0 … 1, sRGB curve, 8 bits.
///
/// One channel is grey, two are red and green, of more the first three count. The exposure is written into the file as
/// text.
///
/// # Errors
/// [`ReportError::Png`] if the encoder refuses.
pub fn picture(image: &Image, stops: f32) -> Result<Picture, ReportError> {
    let shown = tone_map(image, stops);
    let factor = stops.exp2();
    let channels = image.channels().min(3);
    let color = |p: usize| {
        let level = |c: usize| (shown.plane(c)[p] * 255.0).round() as u8;
        match channels {
            1 => [level(0); 3],
            2 => [level(0), level(1), 0],
            _ => [0, 1, 2].map(level),
        }
    };
    let clipped = |p: usize| (0..channels).any(|c| image.plane(c)[p] * factor > 1.0);
    let note = format!("exposure {stops:+} stops, sRGB curve, clamped to 0 ... 1");
    paint(image, channels, &note, color, clipped)
}

/// A map of non-negative values in viridis from 0 to `top`, of the first channel. The range is written into the file as
/// text.
///
/// # Errors
/// [`ReportError::Png`] if the encoder refuses.
pub fn error_picture(map: &Image, top: f32) -> Result<Picture, ReportError> {
    let color = |p: usize| {
        let place = if top > 0.0 { (map.plane(0)[p] / top).clamp(0.0, 1.0) } else { 0.0 };
        viridis(place)
    };
    let note = format!("viridis from 0 to {top}");
    paint(map, 1, &note, color, |p| map.plane(0)[p] > top)
}

fn viridis(place: f32) -> [u8; 3] {
    let steps = (VIRIDIS.len() - 1) as f32;
    let below = ((place * steps) as usize).min(VIRIDIS.len() - 2);
    let share = place * steps - below as f32;
    std::array::from_fn(|c| {
        let (low, high) = (f32::from(VIRIDIS[below][c]), f32::from(VIRIDIS[below + 1][c]));
        (low + share * (high - low)).round() as u8
    })
}

/// Draws every pixel that is finite in its first `channels` channels.
fn paint(
    image: &Image,
    channels: usize,
    note: &str,
    color: impl Fn(usize) -> [u8; 3],
    clipped: impl Fn(usize) -> bool,
) -> Result<Picture, ReportError> {
    let mut rgb = Vec::with_capacity(3 * image.pixels());
    let (mut non_finite_pixels, mut clipped_pixels) = (0, 0);
    for p in 0..image.pixels() {
        if (0..channels).all(|c| image.plane(c)[p].is_finite()) {
            clipped_pixels += usize::from(clipped(p));
            rgb.extend(color(p));
        } else {
            non_finite_pixels += 1;
            rgb.extend(NON_FINITE_COLOR);
        }
    }
    let png = encode_rgb(&rgb, image.width(), image.height(), Some(note))
        .map_err(|source| ReportError::Png { name: "picture".into(), source })?;
    Ok(Picture { png, non_finite_pixels, clipped_pixels })
}

/// Interleaved RGB as a PNG file that says its colour space.
pub(crate) fn encode_rgb(
    rgb: &[u8],
    width: usize,
    height: usize,
    note: Option<&str>,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    if let Some(note) = note {
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        encoder.add_text_chunk("Comment".to_owned(), note.to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode(picture: &Picture) -> (Vec<u8>, String) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(&picture.png)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        let note = reader.info().uncompressed_latin1_text[0].text.clone();
        (data, note)
    }

    #[test]
    fn a_picture_has_the_display_values_of_its_radiance() {
        let image = Image::from_vec(3, 1, 3, vec![0.0, 0.5, 1.0, 0.25, 0.5, 4.0, -1.0, 0.5, 0.0]).unwrap();
        let shown = picture(&image, 0.0).unwrap();
        let (data, note) = decode(&shown);
        // The sRGB curve takes 0.5 to 187.5 of 255 and 0.25 to 137.0.
        assert_eq!(data, [0, 137, 0, 188, 188, 188, 255, 255, 0]);
        assert!(note.contains("+0 stops") && note.contains("sRGB"), "{note}");
        assert_eq!((shown.non_finite_pixels, shown.clipped_pixels), (0, 1));
        let brighter = picture(&image, 1.0).unwrap();
        assert_eq!(decode(&brighter).0[..3], [0, 188, 0]);
        assert_eq!(brighter.clipped_pixels, 1, "a value that becomes 1 is white, not clipped");
    }

    #[test]
    fn pixels_that_are_not_finite_are_seen_and_counted() {
        let image = Image::from_vec(2, 2, 1, vec![f32::NAN, 0.5, f32::INFINITY, 1.0]).unwrap();
        let shown = picture(&image, 0.0).unwrap();
        assert_eq!(shown.non_finite_pixels, 2);
        assert_eq!(decode(&shown).0, [[255, 0, 255], [188; 3], [255, 0, 255], [255; 3]].concat());
    }

    #[test]
    fn two_channels_are_red_and_green_and_a_fourth_is_left_out() {
        let two = Image::from_vec(1, 1, 2, vec![1.0, 0.0]).unwrap();
        assert_eq!(decode(&picture(&two, 0.0).unwrap()).0, [255, 0, 0]);
        let four = Image::from_vec(1, 1, 4, vec![0.0, 1.0, 0.0, f32::NAN]).unwrap();
        assert_eq!(decode(&picture(&four, 0.0).unwrap()).0, [0, 255, 0]);
    }

    #[test]
    fn an_error_map_runs_through_the_scale_and_says_its_range() {
        let map = Image::from_vec(5, 1, 1, vec![0.0, 1.0, 2.0, 3.0, f32::NAN]).unwrap();
        let shown = error_picture(&map, 2.0).unwrap();
        let (data, note) = decode(&shown);
        assert_eq!(data[..12], [VIRIDIS[0], VIRIDIS[5], VIRIDIS[10], VIRIDIS[10]].concat());
        assert_eq!((shown.non_finite_pixels, shown.clipped_pixels), (1, 1));
        assert_eq!(note, "viridis from 0 to 2");
        let flat = error_picture(&Image::filled(1, 1, 1, 0.0), 0.0).unwrap();
        assert_eq!(decode(&flat).0, VIRIDIS[0]);
    }
}
