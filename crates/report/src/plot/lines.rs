//! Panels of points with error bars, joined by lines.

use noisefloor_study::exhibit::{Panel, Point as Datum, Scale, Series};

use super::axis::Axis;
use super::figure::{Color, Figure, Point, Stroke};
use super::frame::Frame;
use super::guides;
use super::labels::{self, Named};
use super::legend::{Key, Legend};
use super::style::{Look, Looks, mark, ring};

/// What the legend says of points that are not compared with the others.
const DOUBTFUL: &str = "other frames or fewer pixels: not ranked";

/// Draws a panel below its title; `left` is the room for numbers and `height` that of the plotting area.
pub(crate) fn panel(
    panel: &Panel,
    title: &str,
    looks: &Looks,
    legend: &mut Legend,
    (left, height): (f64, f64),
) -> Figure {
    let (x, y) = (Axis::of(&panel.x), Axis::of(&panel.y));
    let mut frame = Frame::new(title, x, y, left, height);
    guides::lines(&mut frame, &panel.guides, legend);
    let step = step(panel);
    let middle = 0.5 * (panel.series.len().saturating_sub(1)) as f64;
    let mut named: Vec<Named> = Vec::new();
    let mut marks: Vec<Point> = Vec::new();
    for (i, series) in panel.series.iter().enumerate() {
        let look = looks.get(series.look);
        let shift = (i as f64 - middle) * step;
        let points: Vec<&Datum> =
            series.points.iter().filter(|p| frame.x.holds(p.x) && frame.y.holds(p.y)).collect();
        family(&mut frame, look, &points, shift, series.band);
        for point in points {
            let (px, py) = frame.at(point.x, point.y);
            marks.push((px + shift, py));
            if !point.label.is_empty() {
                let label = point.label.clone();
                named.push(Named { at: (px + shift, py), text: label, color: look.color });
            }
        }
        legend.series(look, &series.name);
    }
    labels::place(&mut frame, &named, &marks);
    doubt(&panel.series, legend);
    frame.figure
}

/// A key for the rings, if there is one.
pub(crate) fn doubt(series: &[Series], legend: &mut Legend) {
    if series.iter().flat_map(|s| &s.points).any(|p| p.doubtful) {
        legend.guide(Key::Doubtful(DOUBTFUL.into()));
    }
}

/// How far families stand apart, so that intervals at the same level do not hide each other. Where a strip stands for
/// zero many points have the same height, and need more.
fn step(panel: &Panel) -> f64 {
    if panel.x.scale != Scale::Levels || panel.series.iter().any(|s| s.band) {
        return 0.0;
    }
    let families = panel.series.len().max(1) as f64;
    if panel.y.scale == Scale::LogWithZero { (14.0 / families).min(3.4) } else { (6.0 / families).min(1.2) }
}

/// Points with error bars or a band, and the line through them.
fn family(frame: &mut Frame, look: Look, points: &[&Datum], shift: f64, band: bool) {
    let place = |frame: &Frame, x: f64, y: f64| {
        let (px, py) = frame.at(x, y);
        (px + shift, py)
    };
    let ends: Vec<_> = points.iter().filter_map(|p| Some((p.x, p.low?, p.high?))).collect();
    // A band needs two levels to span.
    let band = band && ends.len() >= 2;
    if band {
        let upper = ends.iter().map(|&(x, _, high)| place(frame, x, high));
        let lower = ends.iter().rev().map(|&(x, low, _)| place(frame, x, low));
        let corners = upper.chain(lower).collect();
        frame.figure.area(corners, look.color, 0.18);
    }
    // Limits and zeros have no place on a logarithmic line, nor has what cannot be compared.
    for run in points.split(|p| p.limit || p.doubtful || p.y <= 0.0) {
        let line = run.iter().map(|p| place(frame, p.x, p.y)).collect();
        frame.figure.line(line, look.stroke());
    }
    for p in points.iter().filter(|p| !p.limit && !band) {
        if let (Some(low), Some(high)) = (p.low, p.high) {
            error_bar(frame, look.color, place(frame, p.x, low), place(frame, p.x, high));
        }
    }
    for p in points {
        let at = place(frame, p.x, p.y);
        if p.limit {
            arrow(frame, look.color, at);
        }
        if p.doubtful {
            ring(&mut frame.figure, at);
        }
        mark(&mut frame.figure, look, at);
        frame.figure.spot(at, p.about.clone());
    }
}

fn error_bar(frame: &mut Frame, color: Color, low: Point, high: Point) {
    let stroke = Stroke::solid(color, 0.7);
    frame.figure.line(vec![low, high], stroke);
    for (x, y) in [low, high] {
        if y > frame.top + 0.01 && y < frame.bottom - 0.01 {
            frame.figure.line(vec![(x - 1.7, y), (x + 1.7, y)], stroke);
        }
    }
}

/// From an upper limit towards smaller values.
fn arrow(frame: &mut Frame, color: Color, (x, y): Point) {
    let tip = (y + 13.0).min(frame.bottom - 0.5);
    frame.figure.line(vec![(x, y), (x, tip - 2.0)], Stroke::solid(color, 0.9));
    frame.figure.area(vec![(x, tip), (x - 2.0, tip - 4.2), (x + 2.0, tip - 4.2)], color, 1.0);
}
