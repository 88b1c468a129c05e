//! What is drawn under the points.

use noisefloor_study::exhibit::Guide;

use super::figure::{Anchor, Point, Stroke};
use super::frame::{Frame, text};
use super::legend::{Key, Legend};
use super::style::{INK, MUTED, SHADE, nth};

/// A law or an identity.
pub(crate) const DOTTED: Stroke = Stroke { color: MUTED, width: 0.7, dash: &[1.0, 1.8] };
/// The border of what is reachable.
const FRONT: Stroke = Stroke { color: SHADE, width: 1.8, dash: &[] };
/// How dark shaded regions are: in the plot, and in the small sample of the legend.
pub(crate) const BELOW: f64 = 0.22;
pub(crate) const ABOVE: f64 = 0.25;
const SAMPLE: f64 = 0.4;
/// Size of names beside lines.
pub(crate) const NAME_SIZE: f64 = 7.0;

/// The line of a level: in ink, or in the colour of the family that it belongs to.
pub(crate) fn level(own: Option<usize>) -> Stroke {
    match own {
        None => Stroke { color: INK, width: 0.8, dash: &[3.0, 2.0] },
        Some(own) => Stroke { color: nth(own).color, width: 0.7, dash: &[3.0, 2.0] },
    }
}

/// What the legend says of a guide.
pub(crate) fn key(guide: &Guide) -> Key {
    match guide {
        Guide::Below { name, .. } | Guide::Above { name, .. } => Key::Shade(SHADE, SAMPLE, name.clone()),
        Guide::Level { name, own, .. } => Key::Line(level(*own), name.clone()),
        Guide::Line { name, .. } => Key::Line(DOTTED, name.clone()),
        Guide::Front { name, .. } => Key::Line(FRONT, name.clone()),
    }
}

/// Draws the guides of a panel with two axes.
pub(crate) fn lines(frame: &mut Frame, guides: &[Guide], legend: &mut Legend) {
    for guide in guides {
        match guide {
            Guide::Below { y, .. } => shade_below(frame, *y),
            Guide::Above { line, .. } => shade_above(frame, line),
            Guide::Level { y, label, own, .. } => named_level(frame, *y, level(*own), label),
            Guide::Line { points, .. } => frame.clipped(points, DOTTED),
            Guide::Front { points, .. } => frame.clipped(points, FRONT),
        }
        legend.guide(key(guide));
    }
}

fn shade_below(frame: &mut Frame, y: f64) {
    let (_, py) = frame.at(frame.x.low, y);
    frame.figure.rect((frame.left, py), (frame.right, frame.bottom), SHADE, BELOW);
    frame.figure.line(vec![(frame.left, py), (frame.right, py)], Stroke::solid(SHADE, 0.7));
}

fn shade_above(frame: &mut Frame, line: &[(f64, f64)]) {
    let mut corners: Vec<Point> = line.iter().map(|&(x, y)| frame.at(x, y)).collect();
    let edge = corners.clone();
    if let (Some(first), Some(last)) = (edge.first(), edge.last()) {
        corners.extend([(last.0, frame.top), (first.0, frame.top)]);
        frame.figure.area(corners, SHADE, ABOVE);
        frame.figure.line(edge, Stroke::solid(SHADE, 0.7));
    }
}

fn named_level(frame: &mut Frame, y: f64, stroke: Stroke, name: &str) {
    let (_, py) = frame.at(frame.x.low, y);
    frame.figure.line(vec![(frame.left, py), (frame.right, py)], stroke);
    let at = (frame.right - 2.0, py - 5.0);
    frame.figure.label(text(at, name.to_owned(), NAME_SIZE, Anchor::Right, stroke.color));
}
