//! PNG files: plotters' bitmap backend drawn large and averaged down, with text from the embedded font.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use ab_glyph::{Font, Glyph, PxScale, point};
use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind};

use super::figure::{Color, Figure};
use super::font;
use super::style::BACKGROUND;
use super::svg::{anchor_offset, weight_of};
use crate::error::ReportError;

/// Pixels per inch of the file.
const DPI: f64 = 300.0;
/// Drawn this many times larger in each direction, then averaged.
const OVERSAMPLE: usize = 3;

/// Encodes the figure `name` as PNG.
pub(crate) fn png(figure: &Figure, name: &str) -> Result<Vec<u8>, ReportError> {
    let per_point = DPI / 72.0;
    let width = (figure.width * per_point).round() as usize;
    let height = (figure.height * per_point).round() as usize;
    let (big_width, big_height) = (width * OVERSAMPLE, height * OVERSAMPLE);
    let Color(r, g, b) = BACKGROUND;
    let mut big: Vec<u8> = [r, g, b].repeat(big_width * big_height);
    let inner = BitMapBackend::with_buffer(&mut big, (big_width as u32, big_height as u32));
    let area = TextBackend { inner }.into_drawing_area();
    figure
        .draw(&area, per_point * OVERSAMPLE as f64)
        .map_err(|e| ReportError::Plot { name: name.to_owned(), message: e.to_string() })?;
    drop(area);
    let small = average(&big, width, height);
    encode(&small, width as u32, height as u32)
        .map_err(|source| ReportError::Png { name: name.to_owned(), source })
}

/// Means over squares of `OVERSAMPLE`² pixels, interleaved RGB.
fn average(big: &[u8], width: usize, height: usize) -> Vec<u8> {
    let stride = width * OVERSAMPLE * 3;
    let count = (OVERSAMPLE * OVERSAMPLE) as u32;
    let mut small = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        let mut sums = vec![0u32; width * 3];
        for row in big[y * OVERSAMPLE * stride..].chunks_exact(stride).take(OVERSAMPLE) {
            for (pixel, sum) in row.chunks_exact(OVERSAMPLE * 3).zip(sums.chunks_exact_mut(3)) {
                for sub in pixel.chunks_exact(3) {
                    for (s, &v) in sum.iter_mut().zip(sub) {
                        *s += u32::from(v);
                    }
                }
            }
        }
        small.extend(sums.iter().map(|s| ((s + count / 2) / count) as u8));
    }
    small
}

fn encode(rgb: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, width, height);
    let (palette, indices) = palette(rgb);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(palette);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let per_metre = (DPI / 0.0254).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&indices)?;
    writer.finish()?;
    Ok(out)
}

/// The 256 most frequent colours and each pixel's nearest: plots have few colours, and indices make small files.
fn palette(rgb: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for pixel in rgb.chunks_exact(3) {
        *counts.entry([pixel[0], pixel[1], pixel[2]]).or_default() += 1;
    }
    let mut colors: Vec<([u8; 3], usize)> = counts.into_iter().collect();
    colors.sort_by_key(|(color, count)| (Reverse(*count), *color));
    let chosen: Vec<[u8; 3]> = colors.iter().take(256).map(|(color, _)| *color).collect();
    let distance = |a: &[u8; 3], b: &[u8; 3]| -> u32 {
        a.iter().zip(b).map(|(&a, &b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let nearest =
        |color: &[u8; 3]| (0..chosen.len()).min_by_key(|&i| distance(&chosen[i], color)).unwrap_or(0) as u8;
    let table: BTreeMap<[u8; 3], u8> = colors.iter().map(|(color, _)| (*color, nearest(color))).collect();
    let indices = rgb.chunks_exact(3).map(|p| table[&[p[0], p[1], p[2]]]).collect();
    (chosen.concat(), indices)
}

/// Plotters' bitmap backend, with our text layout and with thick lines that have clean corners.
struct TextBackend<'a> {
    inner: BitMapBackend<'a>,
}

type Backend<'a> = BitMapBackend<'a>;
type Failure<'a> = DrawingErrorKind<<Backend<'a> as DrawingBackend>::ErrorType>;

impl<'a> DrawingBackend for TextBackend<'a> {
    type ErrorType = <Backend<'a> as DrawingBackend>::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.inner.get_size()
    }

    fn ensure_prepared(&mut self) -> Result<(), Failure<'a>> {
        self.inner.ensure_prepared()
    }

    fn present(&mut self) -> Result<(), Failure<'a>> {
        self.inner.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Result<(), Failure<'a>> {
        self.inner.draw_pixel(point, color)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Result<(), Failure<'a>> {
        let points: Vec<_> = path.into_iter().collect();
        let half = f64::from(style.stroke_width()) / 2.0;
        let color = style.color();
        for (i, pair) in points.windows(2).enumerate() {
            let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
            let (dx, dy) = (f64::from(x1 - x0), f64::from(y1 - y0));
            let length = dx.hypot(dy);
            if length == 0.0 {
                continue;
            }
            let (nx, ny) = (-dy / length * half, dx / length * half);
            let corner = |x: i32, y: i32, s: f64| {
                ((f64::from(x) + s * nx).round() as i32, (f64::from(y) + s * ny).round() as i32)
            };
            let quad = [corner(x0, y0, 1.0), corner(x1, y1, 1.0), corner(x1, y1, -1.0), corner(x0, y0, -1.0)];
            self.fill_polygon(quad, &color)?;
            if i > 0 && half >= 1.0 {
                self.draw_circle((x0, y0), half.floor() as u32, &color, true)?;
            }
        }
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &T,
        (x, y): BackendCoord,
    ) -> Result<(), Failure<'a>> {
        let weight = weight_of(style);
        let face = font::font(weight);
        let size = style.size();
        // The rasteriser's scale is ascent minus descent, ours is the em.
        let scale =
            PxScale::from((f64::from(face.height_unscaled()) / font::units_per_em(weight) * size) as f32);
        let (glyphs, advance) = font::layout(text, weight);
        let (dx, dy) = anchor_offset(style, advance * size, size);
        let turn = style.transform();
        let color = style.color();
        for placed in glyphs {
            let position = point((dx + placed.x * size) as f32, dy as f32);
            let glyph = Glyph { id: placed.glyph, scale, position };
            let Some(outlined) = face.outline_glyph(glyph) else { continue };
            let corner = outlined.px_bounds().min;
            let mut covered = Vec::new();
            outlined.draw(|gx, gy, coverage| covered.push((gx, gy, coverage)));
            for (gx, gy, coverage) in covered {
                if coverage > 0.0 {
                    let (tx, ty) = turn.transform(corner.x as i32 + gx as i32, corner.y as i32 + gy as i32);
                    self.draw_pixel((x + tx, y + ty), color.mix(f64::from(coverage.min(1.0))))?;
                }
            }
        }
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), Failure<'a>> {
        let width = font::width(text, style.size(), weight_of(style));
        Ok((width.ceil() as u32, (font::CAP_HEIGHT * style.size()).ceil() as u32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::figure::{Anchor, Label, Stroke};
    use crate::plot::font::Weight;
    use crate::plot::style::INK;

    fn decode(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        (info.width, info.height, data)
    }

    #[test]
    fn a_figure_has_its_size_at_300_dpi_and_its_marks() {
        let mut figure = Figure::new(72.0, 36.0, String::new());
        figure.line(vec![(0.0, 18.0), (36.0, 18.0)], Stroke::solid(INK, 2.0));
        figure.label(Label {
            at: (54.0, 18.0),
            text: "■M".into(),
            size: 12.0,
            weight: Weight::Bold,
            color: INK,
            anchor: Anchor::Center,
        });
        let (width, height, data) = decode(&png(&figure, "t").unwrap());
        assert_eq!((width, height), (300, 150));
        let at = |x: usize, y: usize| data[(y * 300 + x) * 3];
        assert!(at(50, 75) < 60, "the line is ink");
        assert_eq!(at(50, 20), 255, "the rest is background");
        let dark = (170..280).flat_map(|x| (50..100).map(move |y| (x, y))).filter(|&(x, y)| at(x, y) < 128);
        assert!(dark.count() > 300, "the text is there");
    }
}
