use noisefloor_study::exhibit::Card;
use noisefloor_study::format;
use noisefloor_study::summary::{Interval, SceneSummary};

use crate::view::View;

/// One card per scene at the level that the page opens with.
pub(crate) fn cards(view: &View<'_>) -> Vec<Card> {
    let Some(spp) = view.default_spp() else { return Vec::new() };
    view.summary.scenes.iter().map(|scene| card(view, scene, spp)).collect()
}

fn card(view: &View<'_>, scene: &SceneSummary, spp: u32) -> Card {
    let ranking = view.ranking(&scene.id, spp, view.primary().0);
    let baseline = view.baseline();
    let mut shown: Vec<String> = baseline.map(str::to_owned).into_iter().collect();
    // Where nothing beats the input, the next best shows what denoising did.
    shown.extend(ranking.iter().find(|l| Some(**l) != baseline).map(|l| (*l).to_owned()));
    let sentences = match ranking.first() {
        None => vec![format!("Nothing ran at {spp} spp.")],
        Some(label) => sentences(view, &scene.id, spp, label),
    };
    Card { scene: scene.id.clone(), title: scene.title.clone(), sentences, shown }
}

fn sentences(view: &View<'_>, scene: &str, spp: u32, label: &str) -> Vec<String> {
    let group = view.tied(scene, spp, view.primary().0, label);
    let mut out = vec![verdict(view, scene, spp, label, !group.is_empty())];
    if !group.is_empty() {
        out.push(format!("The replicates cannot tell it from {}.", format::list(&group)));
    }
    if view.single(scene, spp) {
        out.push("One replicate: other random seeds may give another order.".into());
    }
    let left_out: Vec<&str> =
        view.left_out(scene, spp).into_iter().map(|(cell, _)| cell.label.as_str()).collect();
    if !left_out.is_empty() {
        out.push(format!("Not ranked: {}.", format::list(&left_out)));
    }
    out
}

/// What the best row gains.
fn verdict(view: &View<'_>, scene: &str, spp: u32, label: &str, tied: bool) -> String {
    let (metric, name) = view.primary();
    let best = view.best_word(metric);
    let complete = view.complete_at(scene, spp);
    let start = if complete { format!("At {spp} spp") } else { format!("So far, at {spp} spp") };
    if Some(label) == view.baseline() {
        return format!("{start} no method beats the unfiltered input in {name}.");
    }
    let mut sentence = match tied {
        false => format!("{start}, {label} has the {best} {name}"),
        true => format!("{start}, {label} is tied for the {best} {name}"),
    };
    let cell = view.cell(scene, spp, label);
    let ratio = cell.and_then(|c| c.ratio_to_mc.get(metric)).filter(|r| r.value > 0.0 && r.value < 1.0);
    if let Some(ratio) = ratio {
        sentence += &format!(", {} below plain Monte Carlo", times(ratio));
    }
    let equal = cell.and_then(|c| c.equal_error.get(metric)).filter(|e| e.value > 0.0);
    if let Some(equal) = equal {
        let beyond = cell.and_then(|c| c.equal_error_extrapolated.get(metric)) == Some(&true);
        let note = if beyond { " (extrapolated)" } else { "" };
        let times = format::ratio(equal.value);
        sentence += &format!(". Plain Monte Carlo needs {times}× the samples for that{note}");
    }
    sentence + "."
}

/// `5.2 times (95 % interval 4.9 to 5.5)` from a ratio below one.
fn times(ratio: &Interval) -> String {
    let factor = format!("{} times", format::ratio(1.0 / ratio.value));
    match (ratio.low, ratio.high) {
        (Some(low), Some(high)) if low > 0.0 => format!(
            "{factor} ({} interval {} to {})",
            format::percent_short(ratio.confidence),
            format::ratio(1.0 / high),
            format::ratio(1.0 / low)
        ),
        _ => factor,
    }
}
