//! Charts as a whole: what a reader sees of an exhibit.

use noisefloor_study::exhibit::{
    Axis, Chart, Form, Guide, Look, Panel, Point, RowKind, RowLook, Scale, Series,
};

use super::style::Looks;
use super::svg::Drawing;
use super::{Drawn, draw};

fn axis(scale: Scale, values: &[f64]) -> Axis {
    Axis { title: "an axis".into(), scale, values: values.to_vec() }
}

fn point(x: f64, y: f64) -> Point {
    Point { x, y, low: Some(0.8 * y), high: Some(1.25 * y), about: format!("here {x}"), ..Point::default() }
}

fn series(name: &str, points: Vec<Point>) -> Series {
    Series { name: name.into(), look: Look::of_row(0), points, band: false }
}

fn panel(form: Form, series: Vec<Series>) -> Panel {
    Panel {
        title: "a panel".into(),
        x: axis(Scale::Levels, &[4.0, 16.0]),
        y: axis(Scale::Log, &[0.001, 1.0]),
        form,
        guides: Vec::new(),
        series,
    }
}

fn drawn(panels: Vec<Panel>) -> Drawn {
    let rows = [RowLook { label: "one".into(), kind: RowKind::Plain }];
    let chart = Chart { id: "speed-x".into(), kind: "speed".into(), title: "the title".into(), panels };
    draw(&chart, &Looks::of(&rows))
}

fn svg(panels: Vec<Panel>) -> String {
    Drawing::of(&drawn(panels).sheet(), "t").unwrap().file()
}

fn one() -> Vec<Point> {
    vec![point(4.0, 0.5), point(16.0, 0.1)]
}

#[test]
fn one_panel_fills_a_column_and_has_the_charts_title() {
    let drawn = drawn(vec![panel(Form::Lines, vec![series("one", one())])]);
    let sheet = drawn.sheet();
    assert_eq!(sheet.width, 252.0);
    let svg = svg(vec![panel(Form::Lines, vec![series("one", one())])]);
    assert!(svg.contains("data-text=\"the title\"") && !svg.contains("data-text=\"a panel\""));
    assert!(svg.contains("data-text=\"one\""), "the legend names the row");
    assert_eq!(svg.matches("<title>here").count(), 2, "every point says what it is");
}

#[test]
fn panels_stand_two_in_a_row_with_one_legend() {
    let panels = |n: usize| vec![panel(Form::Lines, vec![series("one", one())]); n];
    let heights: Vec<f64> = [2, 3, 4, 5].map(|n| drawn(panels(n)).sheet().height).to_vec();
    assert_eq!(heights[1], heights[2], "three and four take two lines");
    assert!(heights[0] < heights[1] && heights[2] < heights[3]);
    let svg = svg(panels(3));
    assert!(svg.contains("width=\"504pt\""));
    assert_eq!(svg.matches("data-text=\"a panel\"").count(), 3);
    assert_eq!(svg.matches("data-text=\"one\"").count(), 1);
    assert_eq!(svg.matches("data-text=\"the title\"").count(), 1);
}

#[test]
fn a_limit_is_an_arrow_without_an_interval_or_a_line() {
    let with = |limit: bool| {
        let points = vec![Point { limit, ..point(4.0, 0.5) }];
        svg(vec![panel(Form::Lines, vec![series("", points)])])
    };
    let (arrow, plain) = (with(true), with(false));
    // Both have a square; the head of the arrow is one filled path more.
    let filled = |svg: &str| svg.matches(" fill=\"#0072b2\"").count();
    assert!(filled(&arrow) > filled(&plain), "a head more");
    assert_eq!(arrow.matches("<title>here").count(), 1);
}

#[test]
fn doubtful_points_are_ringed_and_the_legend_says_why() {
    let mut points = one();
    points[1].doubtful = true;
    for form in [Form::Lines, Form::Bars] {
        let svg = svg(vec![panel(form, vec![series("one", points.clone())])]);
        assert!(svg.contains("data-text=\"other frames or fewer pixels: not ranked\""), "{form:?}");
    }
    assert!(!svg(vec![panel(Form::Lines, vec![series("one", one())])]).contains("not ranked"));
}

#[test]
fn bars_have_their_names_beside_them_and_no_legend_of_rows() {
    let rows = vec![series("first row", one()), series("second row", vec![point(4.0, 0.01)])];
    let drawn = drawn(vec![panel(Form::Bars, rows.clone())]);
    assert!(drawn.legend().is_none());
    let svg = svg(vec![panel(Form::Bars, rows)]);
    assert!(svg.contains("data-text=\"first row\"") && svg.contains("data-text=\"second row\""));
    assert!(svg.contains("data-text=\"0.01\""), "the axis of values is below");
}

#[test]
fn guides_are_named_once_and_only_where_they_are_drawn() {
    let level =
        |label: &str| Guide::Level { y: 0.1, label: label.into(), name: "promised".into(), own: None };
    let guides = vec![
        Guide::Below { y: 0.01, name: "floor".into() },
        level("α"),
        level("β"),
        Guide::Front { points: vec![(4.0, 0.5), (16.0, 0.2)], name: "front".into() },
    ];
    for (form, front) in [(Form::Lines, 1), (Form::Bars, 0)] {
        let svg = svg(vec![Panel { guides: guides.clone(), ..panel(form, vec![series("one", one())]) }]);
        let count = |text: &str| svg.matches(&format!("data-text=\"{text}\"")).count();
        assert_eq!([count("floor"), count("promised"), count("α"), count("β")], [1, 1, 1, 1], "{form:?}");
        assert_eq!(count("front"), front, "{form:?}");
    }
}

#[test]
fn what_has_no_place_on_an_axis_is_left_out() {
    let points = vec![point(4.0, f64::NAN), point(4.0, 0.0), point(16.0, f64::INFINITY), point(16.0, 0.3)];
    for form in [Form::Lines, Form::Bars] {
        let svg = svg(vec![panel(form, vec![series("one", points.clone())])]);
        assert_eq!(svg.matches("<title>here").count(), 1, "{form:?}");
        assert!(!svg.contains("NaN"));
    }
}

#[test]
fn a_chart_without_panels_or_series_is_still_a_sheet() {
    assert!(drawn(vec![]).sheet().height > 0.0);
    for form in [Form::Lines, Form::Bars] {
        assert!(svg(vec![panel(form, vec![])]).contains("<svg"));
    }
}

#[test]
fn a_band_joins_intervals_instead_of_bars() {
    let with = |band: bool| {
        let family = Series { band, ..series("one", one()) };
        svg(vec![panel(Form::Lines, vec![family])])
    };
    assert!(with(true).contains("fill-opacity=\"0.180\"") && !with(false).contains("fill-opacity"));
}
