//! An SVG backend for plotters whose text is glyph outlines: it looks the same wherever it is opened.

mod backend;
mod drawing;

use std::fmt::Write as _;

use plotters::prelude::IntoDrawingArea;

use self::backend::SvgBackend;
pub(crate) use self::drawing::{Drawing, GlyphKey, escape, glyph_definitions};
use self::drawing::{SCALE, units};
use super::figure::Figure;
use crate::error::ReportError;

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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::figure::{Anchor, Label};
    use crate::plot::font::Weight;
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
