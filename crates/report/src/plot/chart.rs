//! Axes, grid, legend and data points: what all plots have in common.

use super::axis::{Axis, Scale};
use super::figure::{Anchor, Color, Figure, Label, Point, Stroke};
use super::font::{Weight, width};
use super::style::{BACKGROUND, GRID, INK, Look, MUTED, SHADE, mark};

/// Width of a figure that fills one column of a paper, points (3.5 inch, 89 mm).
pub(crate) const COLUMN: f64 = 252.0;
/// Height of the plotting area, points.
const PLOT_HEIGHT: f64 = 152.0;
const TICK_SIZE: f64 = 7.2;
const TITLE_SIZE: f64 = 8.0;

/// A line of the legend.
#[derive(Debug, Clone)]
pub(crate) enum Key {
    /// A row of the study.
    Series(Look, String),
    /// A plain line.
    Line(Stroke, String),
    /// A shaded region.
    Shade(Color, f64, String),
    /// The ring around points that cannot be compared with the others.
    Doubtful(String),
}

impl Key {
    fn text(&self) -> &str {
        match self {
            Self::Series(_, t) | Self::Line(_, t) | Self::Shade(_, _, t) | Self::Doubtful(t) => t,
        }
    }
}

/// A data point in data coordinates.
#[derive(Debug, Clone)]
pub(crate) struct Datum {
    pub x: f64,
    pub y: f64,
    /// Ends of the interval, where known.
    pub low: Option<f64>,
    pub high: Option<f64>,
    /// `y` is only an upper limit: drawn as an arrow that points to the lower end of the axis.
    pub limit: bool,
    /// Over other frames or fewer pixels than the others: ringed.
    pub doubtful: bool,
    /// What the page shows under the pointer.
    pub spot: String,
}

/// A chart under construction.
#[derive(Debug)]
pub(crate) struct Chart {
    pub figure: Figure,
    pub x: Axis,
    pub y: Axis,
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Chart {
    /// Frame, grid and ticks. `title` stands above the plot.
    pub(crate) fn new(title: &str, x: Axis, y: Axis) -> Self {
        let labels = y.ticks.iter().filter_map(|t| t.label.as_deref());
        let widest = labels.map(|l| width(l, TICK_SIZE, Weight::Normal)).fold(10.0, f64::max);
        let (left, top) = (widest + 20.0, 19.0);
        let mut chart = Self {
            figure: Figure::new(COLUMN, top + PLOT_HEIGHT, title.to_owned()),
            x,
            y,
            left,
            top,
            right: COLUMN - 6.0,
            bottom: top + PLOT_HEIGHT,
        };
        chart.text(
            (2.0, 7.5),
            elide(title, TITLE_SIZE, Weight::Bold, COLUMN - 4.0),
            TITLE_SIZE,
            Anchor::Left,
            INK,
        );
        chart.grid();
        chart
    }

    fn text(&mut self, at: Point, text: String, size: f64, anchor: Anchor, color: Color) {
        let weight = if size >= TITLE_SIZE && anchor == Anchor::Left { Weight::Bold } else { Weight::Normal };
        self.figure.label(Label { at, text, size, weight, color, anchor });
    }

    /// Page position of data coordinates, clamped to the plotting area.
    pub(crate) fn at(&self, x: f64, y: f64) -> Point {
        (
            self.left + self.x.position(x) * (self.right - self.left),
            self.bottom - self.y.position(y) * (self.bottom - self.top),
        )
    }

    fn grid(&mut self) {
        let (x, y) = (self.x.clone(), self.y.clone());
        let line = Stroke::solid(GRID, 0.5);
        let tick = Stroke::solid(MUTED, 0.5);
        for t in &y.ticks {
            let (_, py) = self.at(x.low, t.value);
            if let Some(label) = &t.label {
                self.figure.line(vec![(self.left, py), (self.right, py)], line);
                self.text((self.left - 5.0, py), label.clone(), TICK_SIZE, Anchor::Right, INK);
            }
        }
        for t in x.ticks.iter().filter(|t| t.label.is_some()) {
            let (px, _) = self.at(t.value, y.low);
            self.figure.line(vec![(px, self.top), (px, self.bottom)], line);
        }
        for t in &y.ticks {
            let (_, py) = self.at(x.low, t.value);
            let length = if t.label.is_some() { 3.0 } else { 1.6 };
            self.figure.line(vec![(self.left - length, py), (self.left, py)], tick);
        }
        for t in &x.ticks {
            let (px, _) = self.at(t.value, y.low);
            let length = if t.label.is_some() { 3.0 } else { 1.6 };
            self.figure.line(vec![(px, self.bottom), (px, self.bottom + length)], tick);
            if let Some(label) = &t.label {
                let half = 0.5 * width(label, TICK_SIZE, Weight::Normal);
                let inside = px.min(COLUMN - 1.0 - half);
                self.text((inside, self.bottom + 5.0), label.clone(), TICK_SIZE, Anchor::Below, INK);
            }
        }
        if let Scale::LogWithZero(strip) = y.scale {
            let py = self.bottom - 0.5 * strip * (self.bottom - self.top);
            self.text((self.left - 5.0, py), "0".into(), TICK_SIZE, Anchor::Right, INK);
            let edge = self.bottom - strip * (self.bottom - self.top);
            let stroke = Stroke { color: MUTED, width: 0.5, dash: &[1.0, 1.6] };
            self.figure.line(vec![(self.left, edge), (self.right, edge)], stroke);
        }
        let axis = Stroke::solid(MUTED, 0.7);
        self.figure
            .line(vec![(self.left, self.top), (self.left, self.bottom), (self.right, self.bottom)], axis);
        let middle = (0.5 * (self.left + self.right), self.bottom + 17.0);
        self.text(middle, x.title, TITLE_SIZE, Anchor::Below, INK);
        self.text((7.0, 0.5 * (self.top + self.bottom)), y.title, TITLE_SIZE, Anchor::Upwards, INK);
    }

    /// Shades everything under the value `y`.
    pub(crate) fn shade_below(&mut self, y: f64, alpha: f64) {
        let (_, py) = self.at(self.x.low, y);
        self.figure.rect((self.left, py), (self.right, self.bottom), SHADE, alpha);
        self.figure.line(vec![(self.left, py), (self.right, py)], Stroke::solid(SHADE, 0.7));
    }

    /// Shades everything above a line through data points.
    pub(crate) fn shade_above(&mut self, line: &[(f64, f64)], alpha: f64) {
        let mut corners: Vec<Point> = line.iter().map(|&(x, y)| self.at(x, y)).collect();
        let edge = corners.clone();
        if let (Some(first), Some(last)) = (edge.first(), edge.last()) {
            corners.extend([(last.0, self.top), (first.0, self.top)]);
            self.figure.area(corners, SHADE, alpha);
            self.figure.line(edge, Stroke::solid(SHADE, 0.7));
        }
    }

    /// A translucent band between the ends of the intervals of `data`.
    pub(crate) fn band(&mut self, color: Color, data: &[Datum]) {
        let ends: Vec<_> = data.iter().filter_map(|d| Some((d.x, d.low?, d.high?))).collect();
        let upper = ends.iter().map(|&(x, _, high)| self.at(x, high));
        let corners = upper.chain(ends.iter().rev().map(|&(x, low, _)| self.at(x, low))).collect();
        self.figure.area(corners, color, 0.18);
    }

    /// A horizontal line at `y` with a short name at its right end.
    pub(crate) fn level(&mut self, y: f64, stroke: Stroke, name: &str) {
        let (_, py) = self.at(self.x.low, y);
        self.figure.line(vec![(self.left, py), (self.right, py)], stroke);
        if !name.is_empty() {
            let at = (self.right - 2.0, py - 5.0);
            self.text(at, name.to_owned(), 7.0, Anchor::Right, stroke.color);
        }
    }

    /// A line between data points, cut to the plotting area's ranges by clamping.
    pub(crate) fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let points = points.iter().map(|&(x, y)| self.at(x, y)).collect();
        self.figure.line(points, stroke);
    }

    /// Points with error bars and the line through them, moved sideways by `shift` points so that intervals of
    /// different rows do not hide each other.
    pub(crate) fn series(&mut self, look: Look, data: &[Datum], shift: f64, connect: bool) {
        let place = |chart: &Self, x: f64, y: f64| {
            let (px, py) = chart.at(x, y);
            (px + shift, py)
        };
        if connect {
            // Limits and zeros have no place on a logarithmic line, nor has what cannot be compared.
            for run in data.split(|d| d.limit || d.doubtful || d.y <= 0.0) {
                let points = run.iter().map(|d| place(self, d.x, d.y)).collect();
                self.figure.line(points, look.stroke());
            }
        }
        for d in data.iter().filter(|d| !d.limit) {
            if let (Some(low), Some(high)) = (d.low, d.high) {
                self.error_bar(look.color, place(self, d.x, low), place(self, d.x, high));
            }
        }
        for d in data {
            let at = place(self, d.x, d.y);
            if d.limit {
                self.arrow(look.color, at);
            }
            if d.doubtful {
                ring(&mut self.figure, at);
            }
            mark(&mut self.figure, look, at);
            self.figure.spot(at, d.spot.clone());
        }
    }

    fn error_bar(&mut self, color: Color, low: Point, high: Point) {
        let stroke = Stroke::solid(color, 0.7);
        self.figure.line(vec![low, high], stroke);
        for (x, y) in [low, high] {
            if y > self.top + 0.01 && y < self.bottom - 0.01 {
                self.figure.line(vec![(x - 1.7, y), (x + 1.7, y)], stroke);
            }
        }
    }

    /// From an upper limit towards smaller values.
    fn arrow(&mut self, color: Color, (x, y): Point) {
        let tip = (y + 13.0).min(self.bottom - 0.5);
        self.figure.line(vec![(x, y), (x, tip - 2.0)], Stroke::solid(color, 0.9));
        self.figure.area(vec![(x, tip), (x - 2.0, tip - 4.2), (x + 2.0, tip - 4.2)], color, 1.0);
    }

    /// A small text near a data point, legible over lines.
    pub(crate) fn note(&mut self, x: f64, y: f64, offset: Point, text: String, color: Color) {
        let at = self.at(x, y);
        let half = (0.5 * width(&text, 7.0, Weight::Normal) + 1.0, 4.0);
        let center = ((at.0 + offset.0).min(COLUMN - half.0), at.1 + offset.1);
        let corner = |s: f64| (center.0 + s * half.0, center.1 + s * half.1);
        self.figure.rect(corner(-1.0), corner(1.0), BACKGROUND, 0.75);
        self.text(center, text, 7.0, Anchor::Center, color);
    }

    /// Appends the legend under the axes, in as many columns as fit.
    pub(crate) fn finish(mut self, series: Vec<Key>, guides: Vec<Key>) -> Figure {
        // Guides come last, unless the columns pack better with them first.
        let mut keys = [series.clone(), guides.clone()].concat();
        let turned = [guides, series].concat();
        if legend_columns(&turned).len() > legend_columns(&keys).len() {
            keys = turned;
        }
        let columns = legend_columns(&keys);
        let rows = keys.len().div_ceil(columns.len().max(1)).max(1);
        let start = self.bottom + 34.0;
        for (i, key) in keys.iter().enumerate() {
            // Down the columns, so that the order reads like the table's.
            let (row, column) = (i % rows, i / rows);
            let (x, y) = (columns[column], start + row as f64 * KEY_HEIGHT);
            let ends = vec![(x, y), (x + KEY_SAMPLE, y)];
            match key {
                Key::Series(look, _) => {
                    self.figure.line(ends, look.stroke());
                    mark(&mut self.figure, *look, (x + 0.5 * KEY_SAMPLE, y));
                }
                Key::Doubtful(_) => ring(&mut self.figure, (x + 0.5 * KEY_SAMPLE, y)),
                Key::Line(stroke, _) => self.figure.line(ends, *stroke),
                Key::Shade(color, alpha, _) => {
                    self.figure.rect((x, y - 3.0), (x + KEY_SAMPLE, y + 3.0), *color, *alpha);
                }
            }
            let left = x + KEY_SAMPLE + 4.0;
            let text = elide(key.text(), KEY_SIZE, Weight::Normal, COLUMN - 1.0 - left);
            self.text((left, y), text, KEY_SIZE, Anchor::Left, INK);
        }
        self.figure.height = start + rows as f64 * KEY_HEIGHT - KEY_HEIGHT / 2.0 + 3.0;
        self.figure
    }
}

/// A circle around a point.
fn ring(figure: &mut Figure, (x, y): Point) {
    let corner = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 24.0;
        (x + 5.0 * angle.cos(), y + 5.0 * angle.sin())
    };
    figure.line((0..=24).map(corner).collect(), Stroke::solid(MUTED, 0.7));
}

const KEY_SIZE: f64 = 7.1;
const KEY_SAMPLE: f64 = 15.0;
const KEY_HEIGHT: f64 = 10.8;

/// Left ends of the legend's columns: as many as fit side by side, each as wide as its widest text.
fn legend_columns(keys: &[Key]) -> Vec<f64> {
    for count in (1..=3usize).rev() {
        let rows = keys.len().div_ceil(count).max(1);
        let mut lefts = Vec::new();
        let mut x = 4.0;
        for column in keys.chunks(rows) {
            lefts.push(x);
            let widest = column.iter().map(|k| width(k.text(), KEY_SIZE, Weight::Normal)).fold(0.0, f64::max);
            x += widest + KEY_SAMPLE + 4.0 + 8.0;
        }
        if x - 8.0 <= COLUMN - 1.0 || count == 1 {
            return lefts;
        }
    }
    vec![4.0]
}

/// Cuts a text that does not fit and ends it with an ellipsis.
fn elide(text: &str, size: f64, weight: Weight, room: f64) -> String {
    if width(text, size, weight) <= room {
        return text.to_owned();
    }
    let mut kept: String = text.to_owned();
    while !kept.is_empty() && width(&format!("{kept}…"), size, weight) > room {
        kept.pop();
    }
    kept + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        Chart::new("t", Axis::spp(&[4, 16, 64]), Axis::log("rMSE", [0.01, 0.1, 1.0]))
    }

    #[test]
    fn larger_values_are_right_and_up() {
        let chart = chart();
        let (a, b) = (chart.at(4.0, 0.01), chart.at(64.0, 1.0));
        assert!(b.0 > a.0 && b.1 < a.1);
        assert!(a.0 > chart.left && b.1 > chart.top, "a margin is kept");
    }

    #[test]
    fn the_legend_makes_room_for_every_row() {
        let keys = |n: usize| -> Vec<Key> {
            (0..n)
                .map(|i| Key::Series(super::super::style::nth(i), format!("a-rather-long-method-{i}")))
                .collect()
        };
        let heights: Vec<f64> = [1, 4, 12].map(|n| chart().finish(keys(n), vec![]).height).to_vec();
        assert!(heights.windows(2).all(|w| w[1] > w[0]), "{heights:?}");
    }

    #[test]
    fn long_texts_end_in_an_ellipsis() {
        let cut = elide(&"m".repeat(200), 8.0, Weight::Normal, 100.0);
        assert!(cut.ends_with('…') && width(&cut, 8.0, Weight::Normal) <= 100.0);
        assert_eq!(elide("short", 8.0, Weight::Normal, 100.0), "short");
    }
}
