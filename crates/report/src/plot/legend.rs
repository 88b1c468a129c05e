//! The legend below the axes: one line for each look.

use super::figure::{Anchor, Color, Figure, Stroke};
use super::font::{Weight, width};
use super::frame::{COLUMN, elide, text};
use super::style::{INK, Look, mark, ring};

/// A line of the legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Key {
    /// A family of points.
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

/// The lines of a legend that panels share.
#[derive(Debug, Default)]
pub(crate) struct Legend {
    series: Vec<Key>,
    guides: Vec<Key>,
}

impl Legend {
    /// A family of points, said once however many panels have it.
    pub(crate) fn series(&mut self, look: Look, name: &str) {
        add(&mut self.series, Key::Series(look, name.to_owned()));
    }

    /// What is not a family of points.
    pub(crate) fn guide(&mut self, key: Key) {
        add(&mut self.guides, key);
    }

    /// Draws the lines in as many columns as fit; nothing if there are none.
    pub(crate) fn figure(&self, room: f64) -> Option<Figure> {
        // Guides come last, unless the columns pack better with them first.
        let mut keys = [self.series.clone(), self.guides.clone()].concat();
        let turned = [self.guides.clone(), self.series.clone()].concat();
        if columns(&turned, room).len() > columns(&keys, room).len() {
            keys = turned;
        }
        if keys.is_empty() {
            return None;
        }
        let columns = columns(&keys, room);
        let rows = keys.len().div_ceil(columns.len().max(1)).max(1);
        let height = START + rows as f64 * HEIGHT - HEIGHT / 2.0 + 3.0;
        let mut figure = Figure::new(room, height, "legend".into());
        for (i, key) in keys.iter().enumerate() {
            // Down the columns, so that the order reads like the table's.
            let (x, y) = (columns[i / rows], START + (i % rows) as f64 * HEIGHT);
            sample(&mut figure, key, (x, y));
            let left = x + SAMPLE + 4.0;
            let said = elide(key.text(), SIZE, Weight::Normal, room - 1.0 - left);
            figure.label(text((left, y), said, SIZE, Anchor::Left, INK));
        }
        Some(figure)
    }
}

fn add(keys: &mut Vec<Key>, key: Key) {
    if !key.text().is_empty() && !keys.contains(&key) {
        keys.push(key);
    }
}

fn sample(figure: &mut Figure, key: &Key, (x, y): (f64, f64)) {
    let ends = vec![(x, y), (x + SAMPLE, y)];
    match key {
        Key::Series(look, _) => {
            figure.line(ends, look.stroke());
            mark(figure, *look, (x + 0.5 * SAMPLE, y));
        }
        Key::Doubtful(_) => ring(figure, (x + 0.5 * SAMPLE, y)),
        Key::Line(stroke, _) => figure.line(ends, *stroke),
        Key::Shade(color, alpha, _) => figure.rect((x, y - 3.0), (x + SAMPLE, y + 3.0), *color, *alpha),
    }
}

const SIZE: f64 = 7.1;
const SAMPLE: f64 = 15.0;
const HEIGHT: f64 = 10.8;
/// Middle of the first line.
const START: f64 = 8.0;

/// Left ends of the columns: as many as fit side by side, each as wide as its widest text.
fn columns(keys: &[Key], room: f64) -> Vec<f64> {
    let most = if room > COLUMN { 6 } else { 3 };
    for count in (1..=most).rev() {
        let rows = keys.len().div_ceil(count).max(1);
        let mut lefts = Vec::new();
        let mut x = 4.0;
        for column in keys.chunks(rows) {
            lefts.push(x);
            let widest = column.iter().map(|k| width(k.text(), SIZE, Weight::Normal)).fold(0.0, f64::max);
            x += widest + SAMPLE + 4.0 + 8.0;
        }
        if x - 8.0 <= room - 1.0 || count == 1 {
            return lefts;
        }
    }
    vec![4.0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::style::nth;

    #[test]
    fn the_legend_makes_room_for_every_row() {
        let height = |n: usize| {
            let mut legend = Legend::default();
            (0..n).for_each(|i| legend.series(nth(i), &format!("a-rather-long-method-{i}")));
            legend.figure(COLUMN).map_or(0.0, |figure| figure.height)
        };
        let heights = [0, 1, 4, 12].map(height);
        assert!(heights[0] == 0.0 && heights.windows(2).all(|w| w[1] > w[0]), "{heights:?}");
    }

    #[test]
    fn what_several_panels_have_is_said_once() {
        let mut legend = Legend::default();
        for _ in 0..3 {
            legend.series(nth(0), "one");
            legend.guide(Key::Shade(INK, 0.4, "floor".into()));
            legend.guide(Key::Shade(INK, 0.4, String::new()));
        }
        assert_eq!((legend.series.len(), legend.guides.len()), (1, 1));
    }
}
