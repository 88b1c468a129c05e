//! What plotters draws, as elements of an SVG.

use std::convert::Infallible;
use std::fmt::Write as _;

use plotters::prelude::DrawingBackend;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind, FontStyle, FontTransform,
};

use super::drawing::{Drawing, escape, glyph_id};
use crate::plot::figure::Color;
use crate::plot::font::{self, Weight};
use crate::plot::palette::hex;

fn paint(color: BackendColor) -> String {
    let (r, g, b) = color.rgb;
    hex(Color(r, g, b))
}

/// Consecutive strokes of one look, joined into one path element.
struct Run {
    attributes: String,
    data: String,
}

/// Draws into a [`Drawing`].
pub(super) struct SvgBackend<'a> {
    drawing: &'a mut Drawing,
    size: (u32, u32),
    run: Option<Run>,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl<'a> SvgBackend<'a> {
    pub(super) fn new(drawing: &'a mut Drawing, size: (u32, u32)) -> Self {
        Self { drawing, size, run: None }
    }

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
fn weight_of<T: BackendTextStyle>(style: &T) -> Weight {
    match style.style() {
        FontStyle::Bold => Weight::Bold,
        FontStyle::Normal | FontStyle::Oblique | FontStyle::Italic => Weight::Normal,
    }
}

/// Offset of the text's baseline start from its anchor, before rotation, y downwards.
fn anchor_offset<T: BackendTextStyle>(style: &T, width: f64, size: f64) -> (f64, f64) {
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
