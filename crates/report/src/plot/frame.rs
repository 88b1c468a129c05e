//! The axes of a panel, its grid and its ticks.

use super::axis::{Axis, Scale, Tick};
use super::figure::{Anchor, Color, Figure, Label, Point, Stroke};
use super::font::{Weight, width};
use super::style::{GRID, INK, MUTED};

/// Width of a figure that fills one column of a paper, points (3.5 inch, 89 mm).
pub(crate) const COLUMN: f64 = 252.0;
/// Size of the numbers along axes.
pub(crate) const TICK_SIZE: f64 = 7.2;
/// Size of titles.
pub(crate) const TITLE_SIZE: f64 = 8.0;
/// Where the plotting area begins, below the title.
pub(crate) const TOP: f64 = 19.0;
/// What numbers and title of the lower axis need.
pub(crate) const FOOT: f64 = 26.0;

/// A plotting area with its axes, drawn into a figure of its own.
#[derive(Debug)]
pub(crate) struct Frame {
    pub figure: Figure,
    pub x: Axis,
    pub y: Axis,
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Frame {
    /// Axes of this height, with grid and ticks; `left` is what the vertical axis needs, see [`left_of`].
    pub(crate) fn new(title: &str, x: Axis, y: Axis, left: f64, height: f64) -> Self {
        let bottom = TOP + height;
        let mut frame = Self {
            figure: Figure::new(COLUMN, bottom + FOOT, title.to_owned()),
            x,
            y,
            left,
            top: TOP,
            right: COLUMN - 6.0,
            bottom,
        };
        frame.figure.label(heading(title));
        frame.grid();
        frame
    }

    /// Page position of data coordinates, clamped to the plotting area.
    pub(crate) fn at(&self, x: f64, y: f64) -> Point {
        self.inside(self.x.position(x), self.y.position(y))
    }

    fn inside(&self, across: f64, up: f64) -> Point {
        (self.left + across * (self.right - self.left), self.bottom - up * (self.bottom - self.top))
    }

    fn grid(&mut self) {
        let (line, tick) = (Stroke::solid(GRID, 0.5), Stroke::solid(MUTED, 0.5));
        let (left, right) = (self.left, self.right);
        let heights: Vec<(f64, Tick)> =
            self.y.ticks.iter().map(|t| (self.at(self.x.low, t.value).1, t.clone())).collect();
        for (py, t) in &heights {
            if let Some(label) = &t.label {
                self.figure.line(vec![(left, *py), (right, *py)], line);
                self.figure.label(text((left - 5.0, *py), label.clone(), TICK_SIZE, Anchor::Right, INK));
            }
        }
        lower_axis(&mut self.figure, &self.x, (left, right), (self.top, self.bottom));
        for (py, t) in &heights {
            let length = if t.label.is_some() { 3.0 } else { 1.6 };
            self.figure.line(vec![(left - length, *py), (left, *py)], tick);
        }
        if let Scale::LogWithZero(strip) = self.y.scale {
            let (_, py) = self.inside(0.0, 0.5 * strip);
            self.figure.label(text((left - 5.0, py), "0".into(), TICK_SIZE, Anchor::Right, INK));
            let (_, edge) = self.inside(0.0, strip);
            self.figure.line(vec![(left, edge), (right, edge)], STRIP);
        }
        let corner = vec![(left, self.top), (left, self.bottom), (right, self.bottom)];
        self.figure.line(corner, Stroke::solid(MUTED, 0.7));
        let middle = (7.0, 0.5 * (self.top + self.bottom));
        self.figure.label(text(middle, self.y.title.clone(), TITLE_SIZE, Anchor::Upwards, INK));
    }

    /// A line through data points, cut at the border of the plotting area.
    pub(crate) fn clipped(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let unit: Vec<Point> = points.iter().map(|&(x, y)| (self.x.place(x), self.y.place(y))).collect();
        for piece in clip(&unit) {
            let piece = piece.iter().map(|&(across, up)| self.inside(across, up)).collect();
            self.figure.line(piece, stroke);
        }
    }
}

/// The border of the strip that stands for zero.
const STRIP: Stroke = Stroke { color: MUTED, width: 0.5, dash: &[1.0, 1.6] };

/// What a vertical axis needs to its left.
pub(crate) fn left_of(y: &Axis) -> f64 {
    let labels = y.ticks.iter().filter_map(|t| t.label.as_deref());
    labels.map(|l| width(l, TICK_SIZE, Weight::Normal)).fold(10.0, f64::max) + 20.0
}

/// A title at the upper left corner, cut to the width of a column.
pub(crate) fn heading(title: &str) -> Label {
    let text = elide(title, TITLE_SIZE, Weight::Bold, COLUMN - 4.0);
    Label { at: (2.0, 7.5), text, size: TITLE_SIZE, weight: Weight::Bold, color: INK, anchor: Anchor::Left }
}

/// A text of normal weight.
pub(crate) fn text(at: Point, text: String, size: f64, anchor: Anchor, color: Color) -> Label {
    Label { at, text, size, weight: Weight::Normal, color, anchor }
}

/// Grid, ticks, numbers and title of a horizontal axis below a plotting area.
pub(crate) fn lower_axis(
    figure: &mut Figure,
    axis: &Axis,
    (left, right): (f64, f64),
    (top, bottom): (f64, f64),
) {
    let place = |value: f64| left + axis.position(value) * (right - left);
    let tick = Stroke::solid(MUTED, 0.5);
    for t in axis.ticks.iter().filter(|t| t.label.is_some()) {
        let px = place(t.value);
        figure.line(vec![(px, top), (px, bottom)], Stroke::solid(GRID, 0.5));
    }
    let named = thinned(&axis.ticks, &place);
    for (t, keep) in axis.ticks.iter().zip(named) {
        let px = place(t.value);
        let length = if t.label.is_some() { 3.0 } else { 1.6 };
        figure.line(vec![(px, bottom), (px, bottom + length)], tick);
        if let Some(label) = t.label.as_ref().filter(|_| keep) {
            let half = 0.5 * width(label, TICK_SIZE, Weight::Normal);
            let at = (px.min(COLUMN - 1.0 - half), bottom + 5.0);
            figure.label(text(at, label.clone(), TICK_SIZE, Anchor::Below, INK));
        }
    }
    if let Scale::LogWithZero(strip) = axis.scale {
        let at = |share: f64| left + share * (right - left);
        figure.label(text((at(0.5 * strip), bottom + 5.0), "0".into(), TICK_SIZE, Anchor::Below, INK));
        figure.line(vec![(at(strip), top), (at(strip), bottom)], STRIP);
    }
    let middle = (0.5 * (left + right), bottom + 17.0);
    figure.label(text(middle, axis.title.clone(), TITLE_SIZE, Anchor::Below, INK));
}

/// Which ticks of a horizontal axis keep their numbers, so that none touches the next: all; else those at powers of
/// ten; else every second, third, … of these.
fn thinned(ticks: &[Tick], place: &dyn Fn(f64) -> f64) -> Vec<bool> {
    let labelled = |t: &Tick| t.label.is_some();
    let decade = |t: &Tick| labelled(t) && (t.value.log10() - t.value.log10().round()).abs() < 1e-9;
    let all: Vec<usize> = (0..ticks.len()).filter(|&i| labelled(&ticks[i])).collect();
    let tens: Vec<usize> = all.iter().copied().filter(|&i| decade(&ticks[i])).collect();
    let free = |chosen: &[usize]| {
        let end = |i: usize, side: f64| {
            let label = ticks[i].label.as_deref().unwrap_or_default();
            place(ticks[i].value) + side * (0.5 * width(label, TICK_SIZE, Weight::Normal) + 1.5)
        };
        chosen.windows(2).all(|w| end(w[0], 1.0) <= end(w[1], -1.0))
    };
    let fewer = if tens.len() >= 2 { tens } else { all.clone() };
    let every = |step: usize| fewer.iter().copied().step_by(step).collect::<Vec<_>>();
    let chosen = std::iter::once(all.clone()).chain((1..=fewer.len().max(1)).map(every)).find(|c| free(c));
    let chosen = chosen.unwrap_or_default();
    (0..ticks.len()).map(|i| chosen.contains(&i)).collect()
}

/// The parts of a line that are inside the unit square.
fn clip(points: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let Some((from, to)) = clip_segment(pair[0], pair[1]) else { continue };
        match pieces.last_mut().filter(|piece| piece.last() == Some(&from)) {
            Some(piece) => piece.push(to),
            None => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// Liang and Barsky's: the segment between its latest entry and its first exit.
fn clip_segment(from: Point, to: Point) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (step, room) in [(-dx, from.0), (dx, 1.0 - from.0), (-dy, from.1), (dy, 1.0 - from.1)] {
        if step == 0.0 {
            if room < 0.0 {
                return None;
            }
            continue;
        }
        let at = room / step;
        if step < 0.0 { enter = enter.max(at) } else { leave = leave.min(at) }
    }
    let along = |t: f64| match t {
        0.0 => from,
        1.0 => to,
        t => (from.0 + t * dx, from.1 + t * dy),
    };
    (enter < leave).then(|| (along(enter), along(leave)))
}

/// Cuts a text that does not fit and ends it with an ellipsis.
pub(crate) fn elide(text: &str, size: f64, weight: Weight, room: f64) -> String {
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
    use crate::plot::axis::{log_ticks, plain};

    #[test]
    fn larger_values_are_right_and_up() {
        let (x, y) = (Axis::spp("spp", &[4, 16, 64]), Axis::log("rMSE", [0.01, 0.1, 1.0]));
        let frame = Frame::new("t", x, y, 40.0, 150.0);
        let (a, b) = (frame.at(4.0, 0.01), frame.at(64.0, 1.0));
        assert!(b.0 > a.0 && b.1 < a.1);
        assert!(a.0 > frame.left && b.1 > frame.top, "a margin is kept");
    }

    #[test]
    fn lines_end_at_the_border_and_keep_their_direction() {
        assert_eq!(clip(&[(-1.0, -1.0), (2.0, 2.0)]), [[(0.0, 0.0), (1.0, 1.0)]]);
        assert_eq!(clip(&[(0.2, 0.2), (0.5, 0.5), (0.8, 0.2)]).len(), 1, "inside, it stays one line");
        assert!(clip(&[(-1.0, 0.5), (-0.5, 0.7)]).is_empty());
        assert_eq!(clip(&[(0.5, 0.5), (0.5, 3.0), (0.7, 3.0), (0.7, 0.5)]).len(), 2);
    }

    #[test]
    fn numbers_below_a_narrow_axis_do_not_touch() {
        let ticks = log_ticks(0.008, 0.11, &plain);
        let kept = |wide: f64| {
            let place = move |v: f64| wide * (v / 0.008).ln();
            thinned(&ticks, &place).iter().filter(|k| **k).count()
        };
        assert_eq!((kept(90.0), kept(12.0)), (4, 2), "then powers of ten only");
        assert_eq!(kept(0.1), 1);
    }

    #[test]
    fn long_texts_end_in_an_ellipsis() {
        let cut = elide(&"m".repeat(200), 8.0, Weight::Normal, 100.0);
        assert!(cut.ends_with('…') && width(&cut, 8.0, Weight::Normal) <= 100.0);
        assert_eq!(elide("short", 8.0, Weight::Normal, 100.0), "short");
    }
}
