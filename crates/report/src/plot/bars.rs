//! Panels of one value per family, for studies of a single level: name, mark and interval on a line of its own.
//!
//! On a logarithmic axis a bar's length means nothing, so the value is a mark and the bar is its interval.

use noisefloor_study::exhibit::{Guide, Panel, Point as Datum};

use super::axis::Axis;
use super::figure::{Anchor, Color, Figure, Point, Stroke};
use super::font::{Weight, width};
use super::frame::{COLUMN, FOOT, TICK_SIZE, TOP, elide, heading, lower_axis, text};
use super::guides::{self, ABOVE, BELOW, DOTTED, NAME_SIZE};
use super::legend::Legend;
use super::lines::doubt;
use super::style::{GRID, INK, Look, Looks, MUTED, SHADE, mark, ring};

/// Height of a line.
const ROW: f64 = 14.0;
/// Room above the first line and below the last.
const EDGE: f64 = 4.0;
/// Names of guides stand above the lines.
const NAMES: f64 = 9.0;

/// Draws a panel below its title; `left` is the room for the names, see [`left_of`].
pub(crate) fn panel(panel: &Panel, title: &str, looks: &Looks, legend: &mut Legend, left: f64) -> Figure {
    let named = panel.guides.iter().any(|g| matches!(g, Guide::Level { label, .. } if !label.is_empty()));
    let top = if named { TOP + NAMES } else { TOP };
    let bottom = top + 2.0 * EDGE + ROW * panel.series.len().max(1) as f64;
    let mut chart = Bars {
        figure: Figure::new(COLUMN, bottom + FOOT, title.to_owned()),
        axis: Axis::of(&panel.y),
        left,
        right: COLUMN - 6.0,
        top,
        bottom,
    };
    chart.figure.label(heading(title));
    lower_axis(&mut chart.figure, &chart.axis, (left, chart.right), (top, bottom));
    for guide in &panel.guides {
        chart.guide(guide, legend);
    }
    for (i, series) in panel.series.iter().enumerate() {
        let middle = top + EDGE + ROW * (i as f64 + 0.5);
        let look = looks.get(series.look);
        let name = elide(&series.name, TICK_SIZE, Weight::Normal, left - 8.0);
        chart.figure.label(text((left - 5.0, middle), name, TICK_SIZE, Anchor::Right, INK));
        chart.figure.line(vec![(left, middle), (chart.right, middle)], Stroke::solid(GRID, 0.5));
        for point in &series.points {
            if chart.axis.holds(point.y) {
                chart.value(look, point, middle);
            }
        }
    }
    let axis = Stroke::solid(MUTED, 0.7);
    chart.figure.line(vec![(left, top), (left, bottom), (chart.right, bottom)], axis);
    doubt(&panel.series, legend);
    chart.figure
}

/// What the names of a panel need to the left of the axis: half of a column at most.
pub(crate) fn left_of(panel: &Panel) -> f64 {
    let widest = panel.series.iter().map(|s| width(&s.name, TICK_SIZE, Weight::Normal)).fold(20.0, f64::max);
    (widest + 9.0).min(0.5 * COLUMN)
}

struct Bars {
    figure: Figure,
    axis: Axis,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Bars {
    fn across(&self, value: f64) -> f64 {
        self.left + self.axis.position(value) * (self.right - self.left)
    }

    /// Guides as vertical lines and shades. A line over levels has one level here; a front has no meaning.
    fn guide(&mut self, guide: &Guide, legend: &mut Legend) {
        let (left, right) = (self.left, self.right);
        let drawn = match guide {
            Guide::Below { y, .. } => self.shade((left, self.across(*y)), BELOW),
            Guide::Above { line, .. } => {
                line.first().is_some_and(|(_, y)| self.shade((self.across(*y), right), ABOVE))
            }
            Guide::Level { y, label, own, .. } => {
                let stroke = guides::level(*own);
                let half = 0.5 * width(label, NAME_SIZE, Weight::Normal);
                let at = self.across(*y).clamp(left.min(right - half) + half, right.max(left + half) - half);
                let above = (at, self.top - 5.0);
                self.figure.label(text(above, label.clone(), NAME_SIZE, Anchor::Center, stroke.color));
                self.vertical(*y, stroke)
            }
            Guide::Line { points, .. } => points.first().is_some_and(|(_, y)| self.vertical(*y, DOTTED)),
            Guide::Front { .. } => false,
        };
        if drawn {
            legend.guide(guides::key(guide));
        }
    }

    fn vertical(&mut self, value: f64, stroke: Stroke) -> bool {
        let x = self.across(value);
        self.figure.line(vec![(x, self.top), (x, self.bottom)], stroke);
        true
    }

    fn shade(&mut self, (from, to): (f64, f64), alpha: f64) -> bool {
        self.figure.rect((from, self.top), (to, self.bottom), SHADE, alpha);
        for x in [from, to].into_iter().filter(|x| *x > self.left && *x < self.right) {
            self.figure.line(vec![(x, self.top), (x, self.bottom)], Stroke::solid(SHADE, 0.7));
        }
        true
    }

    fn value(&mut self, look: Look, point: &Datum, middle: f64) {
        let at = (self.across(point.y), middle);
        let reach = if point.doubtful { 5.0 } else { 3.0 };
        let mut ends = (at.0 - reach, at.0 + reach);
        if let (Some(low), Some(high), false) = (point.low, point.high, point.limit) {
            let (low, high) = (self.across(low), self.across(high));
            self.figure.rect((low, middle - 2.6), (high, middle + 2.6), look.color, 0.28);
            self.interval(look.color, (low, high), middle);
            ends = (low.min(ends.0), high.max(ends.1));
        }
        if point.limit {
            ends.0 = self.arrow(look.color, at);
        }
        if point.doubtful {
            ring(&mut self.figure, at);
        }
        mark(&mut self.figure, look, at);
        self.figure.spot(at, point.about.clone());
        if !point.label.is_empty() {
            self.note(&point.label, ends, middle);
        }
    }

    fn interval(&mut self, color: Color, (low, high): (f64, f64), middle: f64) {
        let stroke = Stroke::solid(color, 0.8);
        self.figure.line(vec![(low, middle), (high, middle)], stroke);
        for x in [low, high].into_iter().filter(|x| *x > self.left + 0.01 && *x < self.right - 0.01) {
            self.figure.line(vec![(x, middle - 2.6), (x, middle + 2.6)], stroke);
        }
    }

    /// A short text behind the interval, or before it where there is no room behind.
    fn note(&mut self, said: &str, (start, end): (f64, f64), middle: f64) {
        let wide = width(said, NAME_SIZE, Weight::Normal);
        let (at, anchor) = if end + 4.0 + wide <= self.right {
            ((end + 4.0, middle), Anchor::Left)
        } else {
            ((start - 4.0, middle), Anchor::Right)
        };
        self.figure.label(text(at, said.to_owned(), NAME_SIZE, anchor, MUTED));
    }

    /// From an upper limit towards smaller values; gives where it ends.
    fn arrow(&mut self, color: Color, (x, y): Point) -> f64 {
        let tip = (x - 13.0).max(self.left + 0.5);
        self.figure.line(vec![(x, y), (tip + 2.0, y)], Stroke::solid(color, 0.9));
        self.figure.area(vec![(tip, y), (tip + 4.2, y - 2.0), (tip + 4.2, y + 2.0)], color, 1.0);
        tip
    }
}
