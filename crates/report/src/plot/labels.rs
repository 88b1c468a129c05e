//! Short texts beside data points, each where it hides least.

use super::figure::{Anchor, Color, Point};
use super::font::{Weight, width};
use super::frame::{Frame, text};
use super::guides::NAME_SIZE;
use super::style::BACKGROUND;

/// A point with a text.
#[derive(Debug)]
pub(crate) struct Named {
    pub at: Point,
    pub text: String,
    pub color: Color,
}

/// Left, top, right and bottom.
type Area = [f64; 4];

/// Writes the texts over everything else, each at the side of its point that covers the fewest marks; one that would
/// cover another text is left out.
pub(crate) fn place(frame: &mut Frame, named: &[Named], marks: &[Point]) {
    let room = [frame.left, frame.top, frame.right, frame.bottom];
    let mut taken: Vec<Area> = Vec::new();
    for name in named {
        let Some(area) = free(name, room, &taken, marks) else { continue };
        taken.push(area);
        frame.figure.rect((area[0], area[1]), (area[2], area[3]), BACKGROUND, 0.75);
        let middle = (0.5 * (area[0] + area[2]), 0.5 * (area[1] + area[3]));
        frame.figure.label(text(middle, name.text.clone(), NAME_SIZE, Anchor::Center, name.color));
    }
}

fn free(name: &Named, room: Area, taken: &[Area], marks: &[Point]) -> Option<Area> {
    let half = 0.5 * width(&name.text, NAME_SIZE, Weight::Normal) + 1.0;
    // Above, to the right, to the left, below, and at the corners.
    let offsets = [
        (0.0, -8.0),
        (half + 4.0, 0.0),
        (-half - 4.0, 0.0),
        (0.0, 8.0),
        (half + 2.0, -6.0),
        (-half - 2.0, -6.0),
        (half + 2.0, 6.0),
        (-half - 2.0, 6.0),
    ];
    let area = |(dx, dy): Point| {
        let (x, y) = (name.at.0 + dx, name.at.1 + dy);
        [x - half, y - 4.0, x + half, y + 4.0]
    };
    let inside = |a: &Area| a[0] >= room[0] && a[1] >= room[1] && a[2] <= room[2] && a[3] <= room[3];
    let hidden = |a: &Area| {
        let covers =
            |m: &&Point| m.0 > a[0] - 2.0 && m.0 < a[2] + 2.0 && m.1 > a[1] - 2.0 && m.1 < a[3] + 2.0;
        marks.iter().filter(covers).count()
    };
    let candidates = offsets.into_iter().map(area).filter(inside);
    candidates.filter(|a| taken.iter().all(|t| apart(a, t))).min_by_key(hidden)
}

fn apart(a: &Area, b: &Area) -> bool {
    a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::style::INK;

    const ROOM: Area = [0.0, 0.0, 200.0, 100.0];

    fn named(at: Point) -> Named {
        Named { at, text: "64 spp".into(), color: INK }
    }

    #[test]
    fn a_text_stands_above_its_point_unless_something_is_there() {
        let at = (100.0, 50.0);
        let above = free(&named(at), ROOM, &[], &[at]).unwrap();
        assert!(above[3] < 50.0 && above[0] < 100.0 && above[2] > 100.0);
        let moved = free(&named(at), ROOM, &[], &[at, (100.0, 42.0)]).unwrap();
        assert!(moved[0] > 100.0, "to the right of a point that has another above it");
    }

    #[test]
    fn a_text_stays_inside_and_covers_no_other() {
        let corner = free(&named((199.0, 1.0)), ROOM, &[], &[]).unwrap();
        assert!(corner[2] <= 200.0 && corner[1] >= 0.0);
        assert!(free(&named((100.0, 50.0)), ROOM, &[ROOM], &[]).is_none(), "no room is no text");
    }
}
