use std::collections::BTreeSet;

use noisefloor_study::exhibit::{Axis, Chart, Form, Guide, Look, Panel, Point, Scale, Series, Shape};
use noisefloor_study::format;
use noisefloor_study::summary::{BoundSummary, SceneSummary};

use crate::charts::{distinct, distinct_values, levels_axis};
use crate::view::View;

/// Violation rates over all pixels of one scene; nothing if no row claims a bound there.
pub(super) fn chart(view: &View<'_>, scene: &SceneSummary, name: &str) -> Option<Chart> {
    let of_scene: Vec<&BoundSummary> =
        view.summary.bounds.iter().filter(|b| b.scene == scene.id && b.class == "all").collect();
    if of_scene.is_empty() {
        return None;
    }
    let alphas = distinct_values(of_scene.iter().map(|b| b.alpha));
    let rates = of_scene.iter().flat_map(|b| [Some(b.violations.value), b.violations.high]).flatten();
    // Rates near none belong to the strip that stands for none.
    let values = rates.chain(alphas.iter().copied()).filter(|v| *v > 1e-7).map(|v| v.min(1.0)).collect();
    let promised = |alpha: &f64| Guide::Level {
        y: *alpha,
        label: format!("α = {}", short(*alpha)),
        name: "promised rate α".into(),
        own: None,
    };
    let claims = claims(view, &of_scene);
    let series = claims.iter().map(|claim| Series {
        name: format!("{} · {}{}", claim.label, claim.name, claim.kind()),
        look: look(claim, &claims),
        points: of_scene.iter().filter(|b| claim.matches(b)).map(|b| point(b)).collect(),
        band: false,
    });
    let panel = Panel {
        title: String::new(),
        x: levels_axis(&distinct(of_scene.iter().map(|b| b.spp))),
        y: Axis { title: "violation rate".into(), scale: Scale::LogWithZero, values },
        form: Form::Lines,
        guides: alphas.iter().map(promised).collect(),
        series: series.collect(),
    };
    Some(Chart {
        id: format!("bounds-{name}"),
        kind: "bounds".into(),
        title: format!("{} · bound violations", scene.title),
        panels: vec![panel],
    })
}

/// As many digits as α needs.
fn short(alpha: f64) -> String {
    let text = format::significant(alpha, 2);
    if text.contains('.') { text.trim_end_matches('0').to_owned() } else { text }
}

/// A claim of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Claim<'a> {
    row: usize,
    label: &'a str,
    name: &'a str,
    proven: bool,
}

impl Claim<'_> {
    fn matches(&self, b: &BoundSummary) -> bool {
        b.label == self.label && b.claim == self.name && b.proven == self.proven
    }

    fn kind(&self) -> &'static str {
        match self.proven {
            true => " (proven)",
            // Some names say it themselves.
            false if self.name.contains("as printed") => "",
            false => " (as printed)",
        }
    }
}

fn claims<'a>(view: &View<'_>, bounds: &[&'a BoundSummary]) -> Vec<Claim<'a>> {
    let claim = |b: &&'a BoundSummary| Claim {
        row: view.row(&b.label),
        label: &b.label,
        name: &b.claim,
        proven: b.proven,
    };
    let set: BTreeSet<Claim<'a>> = bounds.iter().map(claim).collect();
    set.into_iter().collect()
}

/// The row's colour; filled for proven claims, open for claims as printed; further claims change the mark.
fn look(claim: &Claim<'_>, claims: &[Claim<'_>]) -> Look {
    const SHAPES: [Shape; 4] = [Shape::Circle, Shape::Square, Shape::Triangle, Shape::Diamond];
    let of_row = claims.iter().filter(|other| other.label == claim.label);
    let nth = of_row.take_while(|other| *other != claim).count();
    Look { open: Some(!claim.proven), shape: Some(SHAPES[nth % SHAPES.len()]), ..Look::of_row(claim.row) }
}

fn point(b: &BoundSummary) -> Point {
    let mark = b.mark.as_deref().map(|m| format!(" ({m})")).unwrap_or_default();
    Point {
        x: f64::from(b.spp),
        y: b.violations.value.max(0.0),
        low: b.violations.low.map(|v| v.max(0.0)),
        high: b.violations.high,
        about: format!(
            "{}, {}, {} spp: {} beside α = {}{mark}",
            b.label,
            b.claim,
            b.spp,
            format::percent_interval(&b.violations).line(),
            format::percent(b.alpha)
        ),
        ..Point::default()
    }
}
