//! What a reader sees.

mod answer;
mod chart;
mod front;

use noisefloor_study::exhibit::{Chart, Exhibit, Part};

pub(super) use answer::answer;

use crate::view::View;
use chart::{Time, chart};

const LINES: &str = "One line per method through its sample counts, from few to many.";
const POINTS: &str = "One point per method.";
const FRONT: &str = "The front joins what no other point beats in both error and time.";

pub(super) fn exhibits(view: &View<'_>) -> Vec<Exhibit> {
    let metric = view.summary.study.primary_metric.as_str();
    let of = |time: Time| -> Vec<Chart> {
        let scenes = view.named_scenes().filter(|_| view.draws("speed"));
        scenes.filter_map(|(scene, name)| chart(view, scene, &name, metric, time)).collect()
    };
    let (total, denoise) = (of(Time::Total), of(Time::Denoise));
    if total.is_empty() && denoise.is_empty() {
        return Vec::new();
    }
    let panels = || total.iter().chain(&denoise).flat_map(|chart| &chart.panels);
    let lines = panels().flat_map(|panel| &panel.series).any(|series| series.points.len() > 1);
    let mut parts = vec![Part::Note(format!("{} {FRONT}", if lines { LINES } else { POINTS }))];
    if !total.is_empty() {
        parts.push(Part::Heading("Render and denoise".into()));
        parts.push(Part::Charts(total));
    }
    if !denoise.is_empty() {
        parts.push(Part::Heading("Denoise only".into()));
        parts.push(Part::Note("The unfiltered input needs no denoising and is absent here.".into()));
        parts.push(Part::Charts(denoise));
    }
    vec![Exhibit {
        id: "speed".into(),
        name: "Speed".into(),
        title: "Speed: error against time".into(),
        parts,
    }]
}
