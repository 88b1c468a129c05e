//! An SVG backend for plotters whose text is glyph outlines: it looks the same wherever it is opened.

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::fmt::Write as _;

use plotters::prelude::{DrawingBackend, IntoDrawingArea};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind, FontStyle, FontTransform,
};

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
        let backend = SvgBackend { drawing: &mut drawing, size, run: None };
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

fn paint(color: BackendColor) -> String {
    let (r, g, b) = color.rgb;
    hex(Color(r, g, b))
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

/// Consecutive strokes of one look, joined into one path element.
struct Run {
    attributes: String,
    data: String,
}

struct SvgBackend<'a> {
    drawing: &'a mut Drawing,
    size: (u32, u32),
    run: Option<Run>,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl SvgBackend<'_> {
    fn flush(&mut self) {
        if let Some(run) = self.run.take() {
            let _ = writeln!(self.drawing.body, r#"<path d="{}"{}/>"#, run.data, run.attributes);
        }
    }

    fn stroke(&mut self, points: &[BackendCoord], closed: bool, style: &impl BackendStyle) {
        let color = style.color();
        if color.alpha == 0.0 || points.len() < 2 {
            return;
        }
        let attributes = format!(
            r#" fill="none" stroke="{}" stroke-width="{}"{}"#,
            paint(color),
            style.stroke_width(),
            opacity("stroke-opacity", color.alpha)
        );
        let data = path_data(points, closed);
        match &mut self.run {
            Some(run) if run.attributes == attributes => run.data.push_str(&data),
            _ => {
                self.flush();
                self.run = Some(Run { attributes, data });
            }
        }
    }

    fn element(&mut self, element: &str) {
        self.flush();
        self.drawing.body.push_str(element);
        self.drawing.body.push('\n');
    }
}

fn opacity(name: &str, alpha: f64) -> String {
    if alpha >= 1.0 { String::new() } else { format!(r#" {name}="{alpha:.3}""#) }
}

fn path_data(points: &[BackendCoord], closed: bool) -> String {
    let mut data = String::new();
    let mut last = (0, 0);
    for (i, &(x, y)) in points.iter().enumerate() {
        let _ = match i {
            0 => write!(data, "M{x} {y}"),
            1 => write!(data, "l{} {}", x - last.0, y - last.1),
            _ => write!(data, " {} {}", x - last.0, y - last.1),
        };
        last = (x, y);
    }
    if closed {
        data.push('z');
    }
    data.replace(" -", "-")
}

impl DrawingBackend for SvgBackend<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        self.flush();
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.stroke(&[from, to], false, style);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<_> = path.into_iter().collect();
        self.stroke(&points, false, style);
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (x0, y0): BackendCoord,
        (x1, y1): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        if fill {
            return self.fill_polygon(corners, style);
        }
        self.stroke(&corners, true, style);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let color = style.color();
        let look = if fill {
            format!(r#"fill="{}"{}"#, paint(color), opacity("fill-opacity", color.alpha))
        } else {
            format!(r#"fill="none" stroke="{}" stroke-width="{}""#, paint(color), style.stroke_width())
        };
        self.element(&format!(r#"<circle cx="{x}" cy="{y}" r="{radius}" {look}/>"#));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vert: I,
        style: &S,
    ) -> Drawn {
        let color = style.color();
        let points: Vec<_> = vert.into_iter().collect();
        if color.alpha > 0.0 {
            let look = format!(r#"fill="{}"{}"#, paint(color), opacity("fill-opacity", color.alpha));
            self.element(&format!(r#"<path d="{}" {look}/>"#, path_data(&points, true)));
        }
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, (x, y): BackendCoord) -> Drawn {
        let weight = weight_of(style);
        let (glyphs, advance) = font::layout(text, weight);
        let size = style.size();
        let em = font::units_per_em(weight);
        let (dx, dy) = anchor_offset(style, advance * size, size);
        let turn = match style.transform() {
            FontTransform::None => "",
            FontTransform::Rotate90 => "rotate(90)",
            FontTransform::Rotate180 => "rotate(180)",
            FontTransform::Rotate270 => "rotate(-90)",
        };
        let mut element = format!(
            r#"<g data-text="{}" fill="{}" transform="translate({x} {y}){turn}translate({:.0} {:.0})scale({:.5})">"#,
            escape(text),
            paint(style.color()),
            dx,
            dy,
            size / em
        );
        for placed in glyphs {
            if font::outline_path(placed.glyph, weight).is_empty() {
                continue;
            }
            let key = (weight, placed.glyph.0);
            let offset = (placed.x * em).round();
            let _ = write!(element, r##"<use href="#{}" x="{offset}"/>"##, glyph_id(key));
            self.drawing.glyphs.insert(key);
        }
        element.push_str("</g>");
        self.element(&element);
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let width = font::width(text, style.size(), weight_of(style));
        Ok((width.ceil() as u32, (font::CAP_HEIGHT * style.size()).ceil() as u32))
    }
}

/// Weight that a plotters style asks for.
pub(crate) fn weight_of<T: BackendTextStyle>(style: &T) -> Weight {
    match style.style() {
        FontStyle::Bold => Weight::Bold,
        FontStyle::Normal | FontStyle::Oblique | FontStyle::Italic => Weight::Normal,
    }
}

/// Offset of the text's baseline start from its anchor, before rotation, y downwards.
pub(crate) fn anchor_offset<T: BackendTextStyle>(style: &T, width: f64, size: f64) -> (f64, f64) {
    let anchor = style.anchor();
    let dx = match anchor.h_pos {
        HPos::Left => 0.0,
        HPos::Center => -0.5 * width,
        HPos::Right => -width,
    };
    let dy = match anchor.v_pos {
        VPos::Top => font::CAP_HEIGHT * size,
        VPos::Center => 0.5 * font::CAP_HEIGHT * size,
        VPos::Bottom => 0.0,
    };
    (dx, dy)
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
