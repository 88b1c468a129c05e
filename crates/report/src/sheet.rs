//! A contact sheet: named pairs of images in a grid, as one PNG.

use ab_glyph::{Font, Glyph, PxScale, point};
use noisefloor_frame::Image;

use crate::error::ReportError;
use crate::picture::encode_rgb;
use crate::plot::font::{self, Weight};

/// A pair of pictures with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetEntry {
    /// Written above the pair.
    pub title: String,
    /// Images of equal size, left and right, as they are shown: values in [0, 1] with the display's curve applied; one
    /// channel is grey.
    pub images: [Image; 2],
}

/// Pixels between pictures and around them.
const GAP: usize = 8;
/// Height of the line above a pair, and size of its letters.
const LINE: usize = 22;
const LETTERS: f64 = 13.0;

/// Lays out the pairs in `columns` columns, row by row, each below its title, and encodes them as an 8-bit RGB PNG. All
/// images should have the size of the first; larger ones are cut, smaller ones leave white.
///
/// # Errors
/// [`ReportError::Png`] if there is nothing to show or encoding fails.
pub fn contact_sheet(entries: &[SheetEntry], columns: usize) -> Result<Vec<u8>, ReportError> {
    let (width, height) = entries.first().map_or((0, 0), |e| (e.images[0].width(), e.images[0].height()));
    let columns = columns.clamp(1, entries.len().max(1));
    let (cell_width, cell_height) = (2 * width + 2 * GAP, height + LINE + GAP);
    let mut sheet = Sheet::new(columns * cell_width + GAP, entries.len().div_ceil(columns) * cell_height);
    for (index, entry) in entries.iter().enumerate() {
        let (x, y) = (GAP + index % columns * cell_width, index / columns * cell_height);
        sheet.text(&entry.title, x, y + LINE / 2);
        for (side, image) in entry.images.iter().enumerate() {
            // The two of a pair stand close together.
            sheet.image(image, x + side * (width + GAP / 4), y + LINE, (width, height));
        }
    }
    encode_rgb(&sheet.rgb, sheet.width, sheet.height, None)
        .map_err(|source| ReportError::Png { name: "contact sheet".into(), source })
}

/// Lays out rows of named pictures, as they are shown, and encodes them as an 8-bit RGB PNG. Columns are as wide as the
/// widest picture, rows as high as the highest.
pub(crate) fn panel(rows: &[Vec<(String, Image)>]) -> Result<Vec<u8>, ReportError> {
    let all = || rows.iter().flatten().map(|(_, image)| image);
    let width = all().map(Image::width).max().unwrap_or(0);
    let height = all().map(Image::height).max().unwrap_or(0);
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let (cell_width, cell_height) = (width + GAP / 2, height + LINE);
    let mut sheet = Sheet::new(columns * cell_width, rows.len() * cell_height);
    for (k, (title, image), row) in
        rows.iter().enumerate().flat_map(|(row, of)| of.iter().enumerate().map(move |(k, e)| (k, e, row)))
    {
        sheet.text(title, k * cell_width + 2, row * cell_height + LINE / 2);
        sheet.image(image, k * cell_width, row * cell_height + LINE, (width, height));
    }
    encode_rgb(&sheet.rgb, sheet.width, sheet.height, None)
        .map_err(|source| ReportError::Png { name: "panel".into(), source })
}

/// White paper, interleaved RGB.
struct Sheet {
    width: usize,
    height: usize,
    rgb: Vec<u8>,
}

impl Sheet {
    fn new(width: usize, height: usize) -> Self {
        Self { width, height, rgb: vec![255; 3 * width * height] }
    }

    fn image(&mut self, image: &Image, x0: usize, y0: usize, (width, height): (usize, usize)) {
        for y in 0..image.height().min(height) {
            for x in 0..image.width().min(width) {
                for c in 0..3 {
                    // A grey image has one channel for all three.
                    let value = image.plane(c.min(image.channels() - 1))[y * image.width() + x];
                    // The cast saturates, and turns NaN into black.
                    self.rgb[3 * ((y0 + y) * self.width + x0 + x) + c] = (value * 255.0).round() as u8;
                }
            }
        }
    }

    /// Black text from `x` on, its capitals centred on `y`; what does not fit is cut.
    fn text(&mut self, text: &str, x: usize, y: usize) {
        let face = font::font(Weight::Bold);
        let scale = f64::from(face.height_unscaled()) / font::units_per_em(Weight::Bold) * LETTERS;
        let base = y as f64 + 0.5 * font::CAP_HEIGHT * LETTERS;
        for placed in font::layout(text, Weight::Bold).0 {
            let position = point((x as f64 + placed.x * LETTERS) as f32, base as f32);
            let glyph = Glyph { id: placed.glyph, scale: PxScale::from(scale as f32), position };
            let Some(outline) = face.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            outline.draw(|gx, gy, coverage| {
                let at = |corner: f32, offset: u32| usize::try_from(corner as i64 + i64::from(offset));
                let (Ok(px), Ok(py)) = (at(corner.x, gx), at(corner.y, gy)) else { return };
                if px < self.width && py < self.height {
                    for value in &mut self.rgb[3 * (py * self.width + px)..][..3] {
                        *value = (f32::from(*value) * (1.0 - coverage.clamp(0.0, 1.0))).round() as u8;
                    }
                }
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(title: &str, left: f32, right: f32) -> SheetEntry {
        let image = |v| Image::from_vec(20, 10, 3, vec![v; 600]).unwrap();
        SheetEntry { title: title.into(), images: [image(left), image(right)] }
    }

    #[test]
    fn pairs_stand_below_their_titles() {
        let entries = [entry("abc", 0.0, 1.0), entry("", 0.5, 0.0), entry("c", 0.0, 0.0)];
        let bytes = contact_sheet(&entries, 2).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        let (width, height) = (info.width as usize, info.height as usize);
        assert_eq!((width, height), (2 * (40 + 2 * GAP) + GAP, 2 * (10 + LINE + GAP)));
        let at = |x: usize, y: usize| data[3 * (y * width + x)];
        assert_eq!(at(GAP + 3, LINE + 3), 0, "left of the first");
        assert_eq!(at(GAP + 20 + GAP / 4 + 3, LINE + 3), 255, "right of the first");
        assert_eq!(at(GAP + 40 + 2 * GAP + 3, LINE + 3), 128, "left of the second");
        let ink = |x: usize| (0..LINE).any(|y| (x..x + 20).any(|x| at(x, y) < 128));
        assert!(ink(GAP) && !ink(GAP + 40 + 2 * GAP), "a title over the first, none over the second");
    }

    #[test]
    fn nothing_to_show_is_an_error() {
        assert!(contact_sheet(&[], 3).is_err());
    }
}
