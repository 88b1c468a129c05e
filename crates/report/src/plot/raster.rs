//! PNG and PDF files of a plot, made from its SVG so that all three look the same.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use resvg::tiny_skia::{Color as Paint, Pixmap, Transform};
use svg2pdf::usvg::{Options, Tree};
use svg2pdf::{ConversionOptions, PageOptions};

use super::figure::Color;
use super::style::BACKGROUND;
use crate::error::ReportError;

/// Pixels per inch of a PNG file.
const DPI: f32 = 300.0;
/// Pixels per inch of a parsed SVG: its points become CSS pixels.
const CSS_DPI: f32 = 96.0;

/// Turns the SVG file of the plot `name` into a PDF page of the same size, outlines and all.
pub(crate) fn pdf(svg: &str, name: &str) -> Result<Vec<u8>, ReportError> {
    let page = PageOptions { dpi: CSS_DPI };
    let pdf = svg2pdf::to_pdf(&parse(svg, name)?, ConversionOptions::default(), page);
    Ok(in_order(pdf.map_err(|e| failed(name, &e))?))
}

/// The same page with the entries of its graphics states in order: the converter keeps them in a hash map, so they
/// stand in another order every time. Nothing changes its length, and no offset.
fn in_order(mut pdf: Vec<u8>) -> Vec<u8> {
    const OPEN: &[u8] = b"/ExtGState <<\n";
    let find = |from: usize, what: &[u8]| pdf[from..].windows(what.len()).position(|w| w == what);
    // Page dictionaries follow the compressed drawing.
    let last = (0..pdf.len().saturating_sub(OPEN.len())).rev().find(|&at| pdf[at..].starts_with(OPEN));
    let Some(start) = last.map(|at| at + OPEN.len()) else { return pdf };
    let Some(length) = find(start, b">>") else { return pdf };
    // The bracket stands on a line of its own.
    let end = pdf[start..start + length].iter().rposition(|&b| b == b'\n').map_or(start, |at| start + at + 1);
    let mut lines: Vec<Vec<u8>> =
        pdf[start..end].split_inclusive(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
    lines.sort_by_key(|line| (line.len(), line.clone()));
    pdf.splice(start..end, lines.concat());
    pdf
}

/// Turns the SVG file of the plot `name` into a PNG of 300 dpi.
pub(crate) fn png(svg: &str, name: &str) -> Result<Vec<u8>, ReportError> {
    let tree = parse(svg, name)?;
    let scale = DPI / CSS_DPI;
    let pixels = |size: f32| (size * scale).round().max(1.0) as u32;
    let (width, height) = (pixels(tree.size().width()), pixels(tree.size().height()));
    let mut map = Pixmap::new(width, height).ok_or_else(|| failed(name, &"its size has no picture"))?;
    let Color(r, g, b) = BACKGROUND;
    map.fill(Paint::from_rgba8(r, g, b, 255));
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut map.as_mut());
    // Nothing is translucent on a background that is not.
    let rgb: Vec<u8> = map.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    encode(&rgb, width, height).map_err(|source| ReportError::Png { name: name.to_owned(), source })
}

fn parse(svg: &str, name: &str) -> Result<Tree, ReportError> {
    Tree::from_str(svg, &Options::default()).map_err(|e| failed(name, &e))
}

fn failed(name: &str, message: &dyn std::fmt::Display) -> ReportError {
    ReportError::Plot { name: name.to_owned(), message: message.to_string() }
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
    // Plots are runs of equal pixels.
    let (pixels, _) = rgb.as_chunks::<3>();
    let runs = || pixels.chunk_by(|a, b| a == b);
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for run in runs() {
        *counts.entry(run[0]).or_default() += run.len();
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
    let indices = runs().flat_map(|run| std::iter::repeat_n(table[&run[0]], run.len())).collect();
    (chosen.concat(), indices)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::figure::{Anchor, Figure, Label, Stroke};
    use crate::plot::font::Weight;
    use crate::plot::style::INK;
    use crate::plot::svg::Drawing;

    fn decode(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        (info.width, info.height, data)
    }

    fn sample() -> String {
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
        Drawing::of(&figure, "t").unwrap().file()
    }

    #[test]
    fn a_figure_has_its_size_at_300_dpi_and_its_marks() {
        let (width, height, data) = decode(&png(&sample(), "t").unwrap());
        assert_eq!((width, height), (300, 150));
        let at = |x: usize, y: usize| data[(y * 300 + x) * 3];
        assert!(at(50, 75) < 60, "the line is ink");
        assert_eq!(at(50, 20), 255, "the rest is background");
        let dark = (170..280).flat_map(|x| (50..100).map(move |y| (x, y))).filter(|&(x, y)| at(x, y) < 128);
        assert!(dark.count() > 300, "the text is there");
    }

    #[test]
    fn a_page_has_the_size_of_the_figure_and_no_fonts() {
        let bytes = pdf(&sample(), "t").unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with("%PDF-1.") && text.contains("/MediaBox [0 0 72 36]"), "{text}");
        assert!(!text.contains("/Font"));
        assert_eq!(bytes, pdf(&sample(), "t").unwrap(), "the same bytes again");
    }

    #[test]
    fn graphics_states_stand_in_order() {
        let page =
            |order: &str| format!("%PDF\n/Resources <<\n  /ExtGState <<\n{order}  >>\n>>\n").into_bytes();
        let shuffled = in_order(page("    /gs10 3 0 R\n    /gs1 7 0 R\n    /gs0 6 0 R\n"));
        assert_eq!(shuffled, page("    /gs0 6 0 R\n    /gs1 7 0 R\n    /gs10 3 0 R\n"));
        for other in ["", "/ExtGState <<\n", "/ExtGState <<\n>>\n", "/ExtGState <<"] {
            assert_eq!(in_order(other.into()), other.as_bytes());
        }
    }

    #[test]
    fn what_is_no_svg_is_an_error_with_the_name() {
        assert!(pdf("nonsense", "speed-x").unwrap_err().to_string().contains("speed-x"));
        assert!(png("<svg", "speed-x").is_err());
    }
}
