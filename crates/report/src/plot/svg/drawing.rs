//! A drawn figure, and what becomes of it.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::plot::font::{self, Weight};
use crate::plot::palette::{BACKGROUND, hex};

/// Backend units per point.
pub(super) const SCALE: f64 = 20.0;

/// A glyph in use: weight and index.
pub(crate) type GlyphKey = (Weight, u16);

/// A drawn figure before it becomes a file or a part of a page.
#[derive(Debug, Default)]
pub(crate) struct Drawing {
    pub(super) body: String,
    /// Glyphs that the body refers to.
    pub glyphs: BTreeSet<GlyphKey>,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) title: String,
}

impl Drawing {
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

pub(super) fn glyph_id((weight, index): GlyphKey) -> String {
    match weight {
        Weight::Normal => format!("g{index}"),
        Weight::Bold => format!("b{index}"),
    }
}

pub(super) fn units(points: f64) -> i64 {
    (points * SCALE).round() as i64
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
