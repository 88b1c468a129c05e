//! The embedded font: DejaVu Sans, laid out here so that SVG and PNG place text alike.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};

/// Weight of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Weight {
    Normal,
    Bold,
}

/// A glyph and the horizontal position of its origin, in ems from the start of the text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    pub glyph: GlyphId,
    pub x: f64,
}

static NORMAL: LazyLock<FontRef<'static>> = LazyLock::new(|| load(dejavu::sans::regular()));
static BOLD: LazyLock<FontRef<'static>> = LazyLock::new(|| load(dejavu::sans::bold()));

fn load(bytes: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(bytes).expect("the embedded font file is a valid font")
}

/// The font of a weight.
pub(crate) fn font(weight: Weight) -> &'static FontRef<'static> {
    match weight {
        Weight::Normal => &NORMAL,
        Weight::Bold => &BOLD,
    }
}

/// Font units per em; glyph outlines are in these units, y upwards.
pub(crate) fn units_per_em(weight: Weight) -> f64 {
    // DejaVu states 2048; the fallback only keeps the division defined.
    f64::from(font(weight).units_per_em().unwrap_or(2048.0))
}

/// Height of a capital letter in ems: texts are centred on half of it.
pub(crate) const CAP_HEIGHT: f64 = 0.729;

/// Glyphs from left to right with kerning, and the advance of the whole text, in ems.
pub(crate) fn layout(text: &str, weight: Weight) -> (Vec<Placed>, f64) {
    let face = font(weight);
    let em = units_per_em(weight);
    let mut x = 0.0;
    let mut previous = None;
    let mut placed = Vec::new();
    for c in text.chars() {
        let glyph = face.glyph_id(c);
        if let Some(previous) = previous {
            x += f64::from(face.kern_unscaled(previous, glyph)) / em;
        }
        placed.push(Placed { glyph, x });
        x += f64::from(face.h_advance_unscaled(glyph)) / em;
        previous = Some(glyph);
    }
    (placed, x)
}

/// Width of a text of this size, in the unit of the size.
pub(crate) fn width(text: &str, size: f64, weight: Weight) -> f64 {
    layout(text, weight).1 * size
}

/// Outline of a glyph as SVG path data in font units, y downwards; empty for blanks.
pub(crate) fn outline_path(glyph: GlyphId, weight: Weight) -> String {
    let Some(outline) = font(weight).outline(glyph) else {
        return String::new();
    };
    let mut path = PathWriter::default();
    for curve in &outline.curves {
        match *curve {
            OutlineCurve::Line(a, b) => path.segment('l', a, &[b]),
            OutlineCurve::Quad(a, b, c) => path.segment('q', a, &[b, c]),
            OutlineCurve::Cubic(a, b, c, d) => path.segment('c', a, &[b, c, d]),
        }
    }
    path.finish()
}

/// Writes relative path commands with integer coordinates.
#[derive(Default)]
struct PathWriter {
    data: String,
    at: Option<(i32, i32)>,
    command: char,
}

impl PathWriter {
    fn segment(&mut self, command: char, from: ab_glyph::Point, to: &[ab_glyph::Point]) {
        let round = |p: ab_glyph::Point| (p.x.round() as i32, (-p.y).round() as i32);
        let from = round(from);
        if self.at != Some(from) {
            if self.at.is_some() {
                self.data.push('z');
            }
            self.data.push_str(&format!("M{} {}", from.0, from.1));
            self.command = 'M';
        }
        if self.command != command {
            self.data.push(command);
            self.command = command;
        } else {
            self.data.push(' ');
        }
        let relative: Vec<String> = to
            .iter()
            .map(|&p| {
                let (x, y) = round(p);
                format!("{} {}", x - from.0, y - from.1)
            })
            .collect();
        self.data.push_str(&relative.join(" "));
        self.at = to.last().map(|&p| round(p));
    }

    fn finish(mut self) -> String {
        if self.at.is_some() {
            self.data.push('z');
        }
        self.data.replace(" -", "-")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_that_plots_use_has_a_glyph() {
        for weight in [Weight::Normal, Weight::Bold] {
            for c in "aZ09 .,−×±%µ⁰¹²³⁴⁵⁶⁷⁸⁹⁻αε∝≤≥√∞–—·…()[]/<>".chars()
            {
                assert_ne!(font(weight).glyph_id(c).0, 0, "{c:?} in {weight:?}");
            }
        }
    }

    #[test]
    fn width_grows_with_text_and_size() {
        let narrow = width("spp", 8.0, Weight::Normal);
        assert!(narrow > 8.0 && narrow < 24.0, "three letters of 8 pt are {narrow} pt");
        assert!((width("spp", 16.0, Weight::Normal) - 2.0 * narrow).abs() < 1e-9);
        assert!(width("spp spp", 8.0, Weight::Normal) > 2.0 * narrow);
    }

    #[test]
    fn outlines_are_closed_paths_and_blanks_are_empty() {
        let path = outline_path(font(Weight::Normal).glyph_id('o'), Weight::Normal);
        assert!(path.starts_with('M') && path.ends_with('z'), "{path}");
        assert_eq!(path.matches('M').count(), 2, "an o has an inner and an outer contour");
        assert_eq!(outline_path(font(Weight::Normal).glyph_id(' '), Weight::Normal), "");
    }
}
