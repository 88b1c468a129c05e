//! A figure as a list of shapes in points (1/72 inch), drawn onto any plotters backend.

use plotters::coord::Shift;
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::prelude::{DrawingArea, DrawingBackend, FontDesc, FontStyle, RGBColor, ShapeStyle, TextStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontFamily, FontTransform};

use super::font::Weight;

/// An sRGB colour. The page maps the palette's colours to its dark theme by value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Color(pub u8, pub u8, pub u8);

/// Position in points from the top left corner.
pub(crate) type Point = (f64, f64);

/// On and off lengths of a dash pattern in points; empty means solid.
pub(crate) type Dash = &'static [f64];

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub color: Color,
    /// Points.
    pub width: f64,
    pub dash: Dash,
}

impl Stroke {
    pub(crate) const fn solid(color: Color, width: f64) -> Self {
        Self { color, width, dash: &[] }
    }
}

/// Which point of a text the given position is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// Left end, middle height.
    Left,
    /// Right end, middle height.
    Right,
    /// Middle of both.
    Center,
    /// Middle, top of the capitals.
    Below,
    /// Middle of both; the text runs upwards.
    Upwards,
}

/// A text with its position.
#[derive(Debug, Clone)]
pub(crate) struct Label {
    pub at: Point,
    pub text: String,
    pub size: f64,
    pub weight: Weight,
    pub color: Color,
    pub anchor: Anchor,
}

#[derive(Debug, Clone)]
enum Item {
    Line(Vec<Point>, Stroke),
    Area(Vec<Point>, Color, f64),
    Disc(Point, f64, Color),
    Label(Label),
}

/// An invisible spot that names what is under the pointer.
#[derive(Debug, Clone)]
pub(crate) struct Spot {
    pub at: Point,
    pub text: String,
}

/// A finished drawing of fixed size.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    /// Points.
    pub width: f64,
    /// Points.
    pub height: f64,
    /// Read by assistive technology.
    pub title: String,
    pub spots: Vec<Spot>,
    items: Vec<Item>,
}

impl Figure {
    pub(crate) fn new(width: f64, height: f64, title: String) -> Self {
        Self { width, height, title, spots: Vec::new(), items: Vec::new() }
    }

    pub(crate) fn line(&mut self, points: Vec<Point>, stroke: Stroke) {
        if points.len() >= 2 {
            self.items.push(Item::Line(points, stroke));
        }
    }

    pub(crate) fn area(&mut self, points: Vec<Point>, color: Color, alpha: f64) {
        if points.len() >= 3 {
            self.items.push(Item::Area(points, color, alpha));
        }
    }

    pub(crate) fn rect(&mut self, (x0, y0): Point, (x1, y1): Point, color: Color, alpha: f64) {
        self.area(vec![(x0, y0), (x1, y0), (x1, y1), (x0, y1)], color, alpha);
    }

    pub(crate) fn disc(&mut self, center: Point, radius: f64, color: Color) {
        self.items.push(Item::Disc(center, radius, color));
    }

    pub(crate) fn label(&mut self, label: Label) {
        if !label.text.is_empty() {
            self.items.push(Item::Label(label));
        }
    }

    /// Draws another figure into this one, its top left corner at `by`.
    pub(crate) fn place(&mut self, other: &Self, by: Point) {
        let moved = |p: &Point| (p.0 + by.0, p.1 + by.1);
        self.items.extend(other.items.iter().map(|item| match item {
            Item::Line(points, stroke) => Item::Line(points.iter().map(moved).collect(), *stroke),
            Item::Area(points, color, alpha) => {
                Item::Area(points.iter().map(moved).collect(), *color, *alpha)
            }
            Item::Disc(center, radius, color) => Item::Disc(moved(center), *radius, *color),
            Item::Label(label) => Item::Label(Label { at: moved(&label.at), ..label.clone() }),
        }));
        self.spots.extend(other.spots.iter().map(|s| Spot { at: moved(&s.at), text: s.text.clone() }));
    }

    pub(crate) fn spot(&mut self, at: Point, text: String) {
        self.spots.push(Spot { at, text });
    }

    /// Draws everything with `scale` backend units per point.
    pub(crate) fn draw<DB: DrawingBackend>(
        &self,
        area: &DrawingArea<DB, Shift>,
        scale: f64,
    ) -> Result<(), plotters::drawing::DrawingAreaErrorKind<DB::ErrorType>> {
        let unit = |p: &Point| ((p.0 * scale).round() as i32, (p.1 * scale).round() as i32);
        for item in &self.items {
            match item {
                Item::Line(points, stroke) => {
                    let width = (stroke.width * scale).round().max(1.0) as u32;
                    let style = shape(stroke.color, 1.0, false, width);
                    for piece in dashes(points, stroke.dash) {
                        area.draw(&PathElement::new(piece.iter().map(unit).collect::<Vec<_>>(), style))?;
                    }
                }
                Item::Area(points, color, alpha) => {
                    let corners: Vec<_> = points.iter().map(unit).collect();
                    area.draw(&Polygon::new(corners, shape(*color, *alpha, true, 1)))?;
                }
                Item::Disc(center, radius, color) => {
                    let radius = (radius * scale).round().max(1.0) as i32;
                    area.draw(&Circle::new(unit(center), radius, shape(*color, 1.0, true, 1)))?;
                }
                Item::Label(label) => area.draw(&Text::new(
                    label.text.as_str(),
                    unit(&label.at),
                    text_style(label, label.size * scale),
                ))?,
            }
        }
        area.present()
    }
}

fn shape(color: Color, alpha: f64, filled: bool, stroke_width: u32) -> ShapeStyle {
    ShapeStyle { color: RGBColor(color.0, color.1, color.2).mix(alpha), filled, stroke_width }
}

fn text_style(label: &Label, size: f64) -> TextStyle<'static> {
    let style = match label.weight {
        Weight::Normal => FontStyle::Normal,
        Weight::Bold => FontStyle::Bold,
    };
    let mut font = FontDesc::new(FontFamily::Name("DejaVu Sans"), size, style);
    let (h, v) = match label.anchor {
        Anchor::Left => (HPos::Left, VPos::Center),
        Anchor::Right => (HPos::Right, VPos::Center),
        Anchor::Center | Anchor::Upwards => (HPos::Center, VPos::Center),
        Anchor::Below => (HPos::Center, VPos::Top),
    };
    if label.anchor == Anchor::Upwards {
        font = font.transform(FontTransform::Rotate270);
    }
    let color = RGBColor(label.color.0, label.color.1, label.color.2).to_backend_color();
    TextStyle { font, color, pos: Pos::new(h, v) }
}

/// Cuts a polyline into its visible pieces.
fn dashes(points: &[Point], pattern: Dash) -> Vec<Vec<Point>> {
    if pattern.is_empty() || pattern.iter().any(|&p| p <= 0.0) {
        return vec![points.to_vec()];
    }
    let mut pieces = Vec::new();
    let mut index = 0;
    let mut left = pattern[0];
    let mut piece = vec![points[0]];
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let length = dx.hypot(dy);
            if length <= left {
                left -= length;
                if index % 2 == 0 {
                    piece.push(to);
                }
                break;
            }
            // `length > left ≥ 0`, so the division is defined.
            from = (from.0 + dx * left / length, from.1 + dy * left / length);
            if index % 2 == 0 {
                piece.push(from);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![from];
            }
            index += 1;
            left = pattern[index % pattern.len()];
        }
    }
    if piece.len() >= 2 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::dashes;

    #[test]
    fn dashes_cover_their_share_of_the_line_around_a_corner() {
        let pieces = dashes(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)], &[3.0, 1.0]);
        let length: f64 =
            pieces.iter().flat_map(|p| p.windows(2)).map(|w| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1)).sum();
        assert!((length - 15.0).abs() < 1e-9, "3 of 4 points of 20 are drawn, got {length}");
        assert!(pieces.iter().any(|p| p.len() == 3), "the dash across the corner bends");
    }

    #[test]
    fn no_pattern_is_one_piece() {
        assert_eq!(dashes(&[(0.0, 0.0), (1.0, 1.0)], &[]).len(), 1);
    }
}
