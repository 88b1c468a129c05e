//! Charts: which points, guides and panels are drawn.

use noisefloor_questions::document;
use noisefloor_study::exhibit::{Chart, Document, Form, Guide, Look, Part, Scale};
use noisefloor_study::summary::Summary;

use crate::fixture::{single_level, study};
use crate::look::{chart, exhibit};

fn has_law(chart: &Chart) -> bool {
    chart.panels[0].guides.iter().any(|guide| matches!(guide, Guide::Line { .. }))
}

#[test]
fn a_rate_is_drawn_for_metrics_that_have_one_only() {
    let law = |study: &Summary, metric: &str| {
        let shown = document(study);
        let columns = crate::look::table(&shown, "errors-rings-16").columns;
        let equal = columns.iter().any(|column| column.head.starts_with("Equal error"));
        (has_law(&chart(&shown, &format!("convergence-rings-{metric}"))), equal)
    };
    assert_eq!(law(&study(), "relmse"), (true, true));
    let mut scored = study();
    scored.study.primary_metric = "psnr".into();
    assert_eq!(law(&scored, "psnr"), (false, false), "a score has no rate");
    let mut trimmed = study();
    trimmed.study.primary_metric = "relmse_trimmed".into();
    assert_eq!(law(&trimmed, "relmse_trimmed"), (false, false), "nor has a trimmed mean");
    // Frames that are not independent samples: the analysis fitted no constant.
    let mut even = study();
    even.cells.iter_mut().for_each(|cell| cell.equal_error.clear());
    assert!(!law(&even, "relmse").0);
}

#[test]
fn a_single_level_is_drawn_as_bars_and_not_as_a_column_of_dots() {
    let shown = document(&single_level());
    let bars = chart(&shown, "convergence-rings-relmse");
    let panel = &bars.panels[0];
    assert_eq!(panel.form, Form::Bars);
    assert!(panel.series.len() == 3 && panel.series.iter().all(|series| series.points.len() == 1));
    assert!(bars.title.ends_with("at 16 spp") && !has_law(&bars));
    assert_eq!(shown.front.charts[0], bars, "the first screen shows the same");
    assert!(exhibit(&shown, "convergence").unwrap().title.contains("single level"));
    // A scatter of time and error stays one.
    assert_eq!(chart(&shown, "speed-rings-total").panels[0].form, Form::Lines);
    let note = |shown: &Document| match &exhibit(shown, "speed").unwrap().parts[0] {
        Part::Note(note) => note.clone(),
        other => panic!("{other:?}"),
    };
    assert!(note(&shown).starts_with("One point per method."));
    assert!(note(&document(&study())).starts_with("One line per method"));
    assert_eq!(chart(&document(&study()), "convergence-rings-relmse").panels[0].form, Form::Lines);
}

#[test]
fn an_upper_limit_is_drawn_as_one() {
    let errors = chart(&document(&study()), "convergence-rings-relmse");
    let guarded = errors.panels[0].series.iter().find(|s| s.name.starts_with("guarded")).unwrap();
    let last = guarded.points.last().unwrap();
    assert!(last.limit && last.y == 4e-4 && last.about.contains("< 0.00040"));
    let floor = errors.panels[0].guides.iter().any(|g| matches!(g, Guide::Below { y, .. } if *y == 2.1e-4));
    assert!(floor, "the noise of the reference is shaded");
    let least = errors.panels[0].y.values.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least > 0.0, "an interval that reaches zero does not stretch the axis");
}

#[test]
fn own_estimates_have_one_panel_per_row_and_a_colour_per_level() {
    let mut study = study();
    // A second row that estimates its error, at some levels.
    let mut more = study.estimates.clone();
    more.retain(|e| e.spp >= 64);
    more.iter_mut().for_each(|e| e.label = "guarded(virtual-flash)".into());
    study.estimates.extend(more);
    let chart = chart(&document(&study), "estimates-rings");
    let titles: Vec<&str> = chart.panels.iter().map(|panel| panel.title.as_str()).collect();
    assert_eq!(titles, ["virtual-flash", "guarded(virtual-flash)"]);
    let (first, second) = (&chart.panels[0], &chart.panels[1]);
    assert_eq!((&first.x, &first.y), (&second.x, &second.y), "panels can be compared");
    let names = |k: usize| -> Vec<(&str, Look)> {
        chart.panels[k].series.iter().map(|series| (series.name.as_str(), series.look)).collect()
    };
    assert_eq!(names(0)[0], ("4 spp", Look::own(0)));
    assert_eq!(names(1), [("64 spp", Look::own(2)), ("256 spp", Look::own(3))], "a level keeps its colour");
    assert!(chart.panels.iter().all(|panel| matches!(&panel.guides[..], [Guide::Line { .. }])));
}

#[test]
fn sample_counts_stand_beside_one_row_of_a_speed_chart() {
    for (id, named) in [("speed-rings-total", "mc"), ("speed-rings-denoise", "virtual-flash")] {
        let chart = chart(&document(&study()), id);
        for series in &chart.panels[0].series {
            let labels: Vec<&str> = series.points.iter().map(|point| point.label.as_str()).collect();
            let wanted = if series.name == named { ["4 spp", "16", "64", "256"] } else { [""; 4] };
            assert_eq!(labels, wanted, "{} of {id}", series.name);
        }
        assert!(matches!(&chart.panels[0].guides[..], [Guide::Front { .. }]));
    }
}

#[test]
fn coverage_shows_the_nominal_levels_in_the_colour_of_the_measured_ones() {
    let coverage = chart(&document(&study()), "coverage-rings");
    let panel = &coverage.panels[0];
    let lines: Vec<Option<usize>> = panel
        .guides
        .iter()
        .filter_map(|guide| match guide {
            Guide::Level { own, .. } => Some(*own),
            _ => None,
        })
        .collect();
    assert_eq!(lines, [Some(0), Some(1), Some(2)]);
    assert!(panel.series.iter().enumerate().all(|(k, series)| series.look == Look::own(k) && series.band));
    assert!(
        panel.guides.iter().any(|guide| matches!(guide, Guide::Above { .. })),
        "missed events are shaded"
    );
    assert_eq!(panel.y.scale, Scale::Miss);
}

#[test]
fn marks_of_bounds_are_filled_where_a_proof_covers_them() {
    let bounds = chart(&document(&study()), "bounds-rings");
    let panel = &bounds.panels[0];
    for series in &panel.series {
        assert_eq!(series.look.open, Some(!series.name.ends_with("(proven)")), "{}", series.name);
    }
    let shapes: Vec<_> =
        panel.series.iter().filter(|s| s.look.row == Some(1)).map(|s| s.look.shape).collect();
    assert!(shapes.len() == 2 && shapes[0] != shapes[1], "claims of one row differ in their marks");
    let promised = |guide: &Guide| matches!(guide, Guide::Level { label, .. } if label == "α = 0.002");
    assert!(panel.guides.iter().any(promised));
}

#[test]
fn a_study_chooses_its_charts_and_keeps_its_tables() {
    let mut chosen = study();
    chosen.study.figures = vec!["coverage".into()];
    let shown = document(&chosen);
    assert!(shown.charts().iter().all(|chart| chart.kind == "coverage") && shown.charts().len() == 2);
    assert!(exhibit(&shown, "convergence").is_none() && exhibit(&shown, "bounds").is_some());
    assert_eq!(shown.tables().len(), document(&study()).tables().len());
}
