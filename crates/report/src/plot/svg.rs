//! An SVG backend for plotters whose text is glyph outlines: it looks the same wherever it is opened.

mod backend;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use plotters::prelude::IntoDrawingArea;

use self::backend::SvgBackend;
use super::figure::{Color, Figure};
use super::font::{self, Weight};
use super::style::BACKGROUND;
use crate::error::ReportError;

/// Backend units per point.
const SCALE: f64 = 20.0;

/// A glyph in use: weight and index.
pub(crate) type GlyphKey = (Weight, u16);

/// A drawn figure before it becomes a file or a part of a page.
#[derive(Debug, Default)]
pub(crate) struct Drawing {
    body: String,
    /// Glyphs that the body refers to.
    pub glyphs: BTreeSet<GlyphKey>,
    width: f64,
    height: f64,
    title: String,
}

impl Drawing {
    /// Draws the figure `name`.
    pub(crate) fn of(figure: &Figure, name: &str) -> Result<Self, ReportError> {
        let mut drawing = Self {
            width: figure.width,
            height: figure.height,
            title: figure.title.clone(),
            ..Self::default()
        };
        let size = (units(figure.width) as u32, units(figure.height) as u32);
        let backend = SvgBackend::new(&mut drawing, size);
        let area = backend.into_drawing_area();
        figure
            .draw(&area, SCALE)
            .map_err(|e| ReportError::Plot { name: name.to_owned(), message: e.to_string() })?;
        drop(area);
        if !figure.spots.is_empty() {
            drawing.body.push_str(r#"<g class="spots" fill="none" pointer-events="all">"#);
            for spot in &figure.spots {
                let (x, y, r) = (units(spot.at.0), units(spot.at.1), units(5.0));
                let text = escape(&spot.text);
                let _ = write!(
                    drawing.body,
                    r#"<circle cx="{x}" cy="{y}" r="{r}"><title>{text}</title></circle>"#
                );
            }
            drawing.body.push_str("</g>\n");
        }
        Ok(drawing)
    }

    /// A file of its own, with its glyphs.
    pub(crate) fn file(&self) -> String {
        let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        let _ = writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{}pt" height="{}pt" viewBox="0 0 {} {}" role="img" aria-label="{}" stroke-linejoin="round">"#,
            self.width,
            self.height,
            units(self.width),
            units(self.height),
            escape(&self.title)
        );
        let _ = writeln!(out, "<title>{}</title>", escape(&self.title));
        let _ = writeln!(out, r#"<rect width="100%" height="100%" fill="{}"/>"#, hex(BACKGROUND));
        out.push_str(&glyph_definitions(&self.glyphs));
        out.push_str(&self.body);
        out.push_str("</svg>\n");
        out
    }

    /// A symbol to be used by its id.
    pub(crate) fn symbol(&self, id: &str) -> String {
        let (width, height) = (units(self.width), units(self.height));
        format!(r#"<symbol id="{id}" viewBox="0 0 {width} {height}">{}</symbol>"#, self.body)
    }

    /// Part of a page that has the glyph definitions elsewhere.
    pub(crate) fn inline(&self) -> String {
        format!(
            r#"<svg class="plot" viewBox="0 0 {} {}" style="--w:{}" role="img" aria-label="{}" stroke-linejoin="round">{}</svg>"#,
            units(self.width),
            units(self.height),
            self.width,
            escape(&self.title),
            self.body
        )
    }
}

/// `<defs>` with the outlines of these glyphs.
pub(crate) fn glyph_definitions(glyphs: &BTreeSet<GlyphKey>) -> String {
    let mut out = String::from("<defs>");
    for &(weight, index) in glyphs {
        let path = font::outline_path(ab_glyph::GlyphId(index), weight);
        let _ = write!(out, r#"<path id="{}" d="{path}"/>"#, glyph_id((weight, index)));
    }
    out.push_str("</defs>\n");
    out
}

fn glyph_id((weight, index): GlyphKey) -> String {
    match weight {
        Weight::Normal => format!("g{index}"),
        Weight::Bold => format!("b{index}"),
    }
}

fn units(points: f64) -> i64 {
    (points * SCALE).round() as i64
}

/// `#rrggbb`.
pub(crate) fn hex(Color(r, g, b): Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text for XML content and attribute values; characters that XML forbids become U+FFFD.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::figure::{Anchor, Label};
    use crate::plot::style::INK;

    #[test]
    fn text_becomes_outlines_and_stays_searchable() {
        let mut figure = Figure::new(100.0, 50.0, "a <b>".into());
        let text = "x < \"64\"".to_owned();
        figure.label(Label {
            at: (50.0, 25.0),
            text,
            size: 8.0,
            weight: Weight::Normal,
            color: INK,
            anchor: Anchor::Center,
        });
        let svg = Drawing::of(&figure, "t").unwrap().file();
        assert!(svg.contains(r#"data-text="x &lt; &quot;64&quot;""#), "{svg}");
        assert!(svg.contains("aria-label=\"a &lt;b&gt;\""));
        assert!(!svg.contains("<text"), "no text needs a font of the system");
        assert_eq!(svg.matches("<use ").count(), 6, "one outline per visible character");
        assert_eq!(svg.matches("<path id=").count(), 5, "a quote occurs twice, once defined");
    }

    #[test]
    fn strokes_of_one_look_share_an_element() {
        let mut figure = Figure::new(10.0, 10.0, String::new());
        for y in 0..5 {
            let stroke = super::super::figure::Stroke::solid(INK, 0.5);
            figure.line(vec![(0.0, f64::from(y)), (10.0, f64::from(y))], stroke);
        }
        let svg = Drawing::of(&figure, "t").unwrap().file();
        assert_eq!(svg.matches("<path d=").count(), 1);
    }
}
