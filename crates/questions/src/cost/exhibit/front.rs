use noisefloor_study::exhibit::Point;

/// The border of what the points reach, with right angles. Rows over other frames or fewer pixels are shown, and beat
/// nothing.
pub(super) fn front<'a>(points: impl Iterator<Item = &'a Point>, lower_is_better: bool) -> Vec<(f64, f64)> {
    let ranked: Vec<(f64, f64)> = points.filter(|p| !p.doubtful).map(|p| (p.x, p.y)).collect();
    staircase(&unbeaten(ranked, lower_is_better))
}

/// Points that no other point beats in both time and error, from fast to slow. Upper limits count as their limit.
fn unbeaten(mut points: Vec<(f64, f64)>, lower_is_better: bool) -> Vec<(f64, f64)> {
    let sign = if lower_is_better { 1.0 } else { -1.0 };
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then((sign * a.1).total_cmp(&(sign * b.1))));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for p in points {
        if front.last().is_none_or(|last| sign * p.1 < sign * last.1) {
            front.push(p);
        }
    }
    front
}

/// Horizontal, then vertical, from point to point.
fn staircase(front: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut line: Vec<(f64, f64)> = Vec::new();
    for &(x, y) in front {
        if let Some(&(_, last)) = line.last() {
            line.push((x, last));
        }
        line.push((x, y));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_has_exactly_the_unbeaten_points() {
        let points = vec![(1.0, 9.0), (2.0, 9.5), (3.0, 4.0), (3.0, 5.0), (8.0, 4.0), (9.0, 1.0)];
        assert_eq!(unbeaten(points.clone(), true), [(1.0, 9.0), (3.0, 4.0), (9.0, 1.0)]);
        assert_eq!(unbeaten(points, false), [(1.0, 9.0), (2.0, 9.5)]);
    }

    #[test]
    fn the_staircase_turns_at_right_angles() {
        assert_eq!(staircase(&[(1.0, 9.0), (3.0, 4.0)]), [(1.0, 9.0), (3.0, 9.0), (3.0, 4.0)]);
        assert!(staircase(&[]).is_empty());
    }

    #[test]
    fn a_row_that_is_not_ranked_beats_nothing() {
        let point = |x, y, doubtful| Point { x, y, doubtful, ..Point::default() };
        let points = [point(1.0, 1.0, true), point(2.0, 2.0, false)];
        assert_eq!(front(points.iter(), true), [(2.0, 2.0)]);
    }
}
