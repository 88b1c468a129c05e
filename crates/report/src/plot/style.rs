//! Colours, markers and dashes: each row of a study keeps its look in every plot.

use noisefloor_study::exhibit::{self, RowKind, RowLook, Shape};

use super::figure::{Color, Dash, Figure, Point, Stroke};
pub(crate) use super::palette::{BACKGROUND, GRID, INK, MUTED, SERIES, SHADE, css};
use super::svg::Drawing;
use crate::error::ReportError;

/// Shape of a data point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Cross,
}

const MARKERS: [Marker; 5] =
    [Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Wedge, Marker::Cross];
const DASHES: [Dash; 4] = [&[], &[7.0, 1.6], &[4.5, 1.5, 1.2, 1.5], &[1.3, 1.3]];
/// Dash of the guarded variant of a row.
const GUARDED: Dash = &[2.6, 1.6];
/// Dots of a row whose method is also a row on the study's own frames, and whose frames are others.
const OTHER_FRAMES: Dash = &[0.9, 1.4];

/// Look of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub color: Color,
    pub marker: Marker,
    /// Outline only.
    pub open: bool,
    pub dash: Dash,
}

impl Look {
    /// The line through the row's points.
    pub(crate) fn stroke(&self) -> Stroke {
        Stroke { color: self.color, width: 1.1, dash: self.dash }
    }
}

/// The look of every row of a study, by its place: plain Monte Carlo in ink with discs, the others in their order, a
/// guarded row in the colour of the row that it guards, dashed and with open marks, and a row on frames of its own in
/// the colour of the same method on the study's frames, dotted and with open marks.
#[derive(Debug, Clone)]
pub(crate) struct Looks {
    rows: Vec<Look>,
}

/// Of what is no row of the study.
const UNKNOWN: Look = Look { color: INK, marker: Marker::Circle, open: true, dash: &[] };

impl Looks {
    pub(crate) fn of(rows: &[RowLook]) -> Self {
        let own = |kind: RowKind| matches!(kind, RowKind::Baseline | RowKind::Plain);
        // What a row is a variant of, if that has a look of its own.
        let variant = |kind: RowKind| match kind {
            RowKind::Guarded(of) | RowKind::OtherFrames(of) => {
                rows.get(of).is_some_and(|row| own(row.kind)).then_some(of)
            }
            RowKind::Baseline | RowKind::Plain => None,
        };
        let mut looks: Vec<Option<Look>> = vec![None; rows.len()];
        let mut next = 0;
        for (look, row) in looks.iter_mut().zip(rows).filter(|(_, row)| variant(row.kind).is_none()) {
            *look = Some(match row.kind {
                RowKind::Baseline => Look { color: INK, marker: Marker::Circle, open: false, dash: &[] },
                _ => {
                    next += 1;
                    nth(next - 1)
                }
            });
        }
        for (at, row) in rows.iter().enumerate() {
            let Some(inner) = variant(row.kind).and_then(|of| looks[of]) else { continue };
            let dash = if matches!(row.kind, RowKind::Guarded(_)) { GUARDED } else { OTHER_FRAMES };
            let mut look = Look { open: true, dash, ..inner };
            // Two such rows of one method differ in their parameters only: tell them apart by marker.
            for marker in MARKERS {
                if looks.iter().flatten().any(|taken| *taken == look) {
                    look.marker = marker;
                }
            }
            looks[at] = Some(look);
        }
        Self { rows: looks.into_iter().map(|look| look.unwrap_or(UNKNOWN)).collect() }
    }

    /// The look of the row at a place.
    pub(crate) fn row(&self, at: usize) -> Look {
        self.rows.get(at).copied().unwrap_or(UNKNOWN)
    }

    /// The look that an exhibit asks for.
    pub(crate) fn get(&self, asked: exhibit::Look) -> Look {
        let look = asked.row.map_or_else(|| nth(asked.own), |row| self.row(row));
        let marker = match asked.shape {
            None => look.marker,
            Some(Shape::Circle) => Marker::Circle,
            Some(Shape::Square) => Marker::Square,
            Some(Shape::Triangle) => Marker::Triangle,
            Some(Shape::Diamond) => Marker::Diamond,
        };
        Look { marker, open: asked.open.unwrap_or(look.open), ..look }
    }

    /// SVG symbols `swatch-0`, `swatch-1`, … with the look of each row.
    pub(crate) fn swatches(&self) -> Result<String, ReportError> {
        let mut out = String::new();
        for (i, look) in self.rows.iter().enumerate() {
            let mut figure = Figure::new(20.0, 8.0, String::new());
            figure.line(vec![(0.0, 4.0), (20.0, 4.0)], Stroke { width: 1.4, ..look.stroke() });
            mark(&mut figure, *look, (10.0, 4.0));
            out += &Drawing::of(&figure, "swatch")?.symbol(&format!("swatch-{i}"));
        }
        Ok(out)
    }
}

/// Look number `n`: colours repeat after six, then with another dash and marker.
pub(crate) fn nth(n: usize) -> Look {
    let round = n / SERIES.len();
    Look {
        color: SERIES[n % SERIES.len()],
        marker: MARKERS[(n + round) % MARKERS.len()],
        open: round % 2 == 1,
        dash: DASHES[round % DASHES.len()],
    }
}

/// Draws a data point of about 4.4 points across.
pub(crate) fn mark(figure: &mut Figure, look: Look, (x, y): Point) {
    let r = 2.2;
    let stroke = Stroke::solid(look.color, 0.9);
    let polygon = |corners: &[(f64, f64)]| -> Vec<Point> {
        corners.iter().map(|&(dx, dy)| (x + r * dx, y + r * dy)).collect()
    };
    let corners = match look.marker {
        Marker::Circle => {
            figure.disc((x, y), r, look.color);
            if look.open {
                figure.disc((x, y), r - 0.8, BACKGROUND);
            }
            return;
        }
        Marker::Cross => {
            let wide = Stroke::solid(look.color, if look.open { 0.9 } else { 1.4 });
            figure.line(polygon(&[(-0.9, -0.9), (0.9, 0.9)]), wide);
            figure.line(polygon(&[(-0.9, 0.9), (0.9, -0.9)]), wide);
            return;
        }
        Marker::Square => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
        Marker::Triangle => polygon(&[(0.0, -1.15), (1.1, 0.85), (-1.1, 0.85)]),
        Marker::Wedge => polygon(&[(0.0, 1.15), (1.1, -0.85), (-1.1, -0.85)]),
        Marker::Diamond => polygon(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)]),
    };
    figure.area(corners.clone(), if look.open { BACKGROUND } else { look.color }, 1.0);
    if look.open {
        let mut outline = corners.clone();
        outline.extend([corners[0], corners[1]]);
        figure.line(outline, stroke);
    }
}

/// A circle around a data point.
pub(crate) fn ring(figure: &mut Figure, (x, y): Point) {
    let corner = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 24.0;
        (x + 5.0 * angle.cos(), y + 5.0 * angle.sin())
    };
    figure.line((0..=24).map(corner).collect(), Stroke::solid(MUTED, 0.7));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looks(kinds: &[RowKind]) -> Looks {
        let row = |kind: &RowKind| RowLook { label: String::new(), kind: *kind };
        Looks::of(&kinds.iter().map(row).collect::<Vec<_>>())
    }

    #[test]
    fn a_guarded_row_has_the_colour_of_its_inner_row() {
        use RowKind::{Baseline, Guarded, OtherFrames, Plain};
        let kinds = [
            Guarded(3),
            Baseline,
            Plain,
            Plain,
            Guarded(2),
            Guarded(2),
            Plain,
            Guarded(6),
            OtherFrames(3),
            OtherFrames(1),
        ];
        let looks = looks(&kinds);
        let color = |at: usize| looks.row(at).color;
        assert_eq!(color(1), INK);
        assert_eq!((color(4), color(5)), (color(2), color(2)));
        assert!(looks.row(4).open && !looks.row(2).open);
        assert_eq!((color(0), color(8)), (color(3), color(3)));
        assert_ne!(color(3), color(2));
        assert_eq!((color(9), looks.row(9).dash), (INK, OTHER_FRAMES));
        assert_eq!(color(6), color(7));
        for i in 0..kinds.len() {
            assert!((0..i).all(|k| looks.row(k) != looks.row(i)), "row {i}");
        }
    }

    #[test]
    fn a_row_that_guards_nothing_known_has_a_colour_of_its_own() {
        let looks = looks(&[RowKind::Guarded(0), RowKind::Guarded(7), RowKind::OtherFrames(0)]);
        assert_eq!([0, 1, 2].map(|at| looks.row(at)), [0, 1, 2].map(nth));
        assert_eq!(looks.row(9), UNKNOWN);
    }

    #[test]
    fn an_exhibit_may_ask_for_another_mark() {
        let looks = looks(&[RowKind::Plain]);
        let asked =
            exhibit::Look { open: Some(true), shape: Some(Shape::Diamond), ..exhibit::Look::of_row(0) };
        assert_eq!(looks.get(asked), Look { open: true, marker: Marker::Diamond, ..nth(0) });
        assert_eq!(looks.get(exhibit::Look::own(4)), nth(4));
    }

    #[test]
    fn two_dozen_rows_all_look_different() {
        let looks: Vec<Look> = (0..24).map(nth).collect();
        for (i, a) in looks.iter().enumerate() {
            assert!(looks[..i].iter().all(|b| a != b), "look {i} repeats");
        }
    }
}
