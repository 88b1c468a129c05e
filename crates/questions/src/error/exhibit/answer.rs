use noisefloor_study::exhibit::{Answer, Tone};
use noisefloor_study::format;
use noisefloor_study::summary::SceneSummary;

use crate::view::View;

/// The best of a scene and what the replicates cannot tell from it, best first.
struct Winners<'a> {
    scene: &'a SceneSummary,
    group: Vec<&'a str>,
    single: bool,
}

pub(in crate::error) fn answer(view: &View<'_>) -> Option<Answer> {
    let spp = view.default_spp()?;
    let (metric, _) = view.primary();
    let winners: Vec<Winners<'_>> = view
        .summary
        .scenes
        .iter()
        .filter_map(|scene| {
            let &label = view.ranking(&scene.id, spp, metric).first()?;
            let tied = view.tied(&scene.id, spp, metric, label);
            let group = std::iter::once(label).chain(tied).collect();
            Some(Winners { scene, group, single: view.single(&scene.id, spp) })
        })
        .collect();
    let everywhere = everywhere(&winners);
    let mut lead = lead(view, &winners, &everywhere, spp)?;
    if let Some(range) = gain(view, &everywhere, spp) {
        let whose = if everywhere.len() == 1 { "Its error is" } else { "Their errors are" };
        lead = format!("{lead} {whose} {range} times below plain Monte Carlo's.");
    }
    let mut sentences = vec![lead];
    if winners.iter().any(|w| w.single) {
        sentences.push("One replicate: other random seeds may give another order.".into());
    }
    let of_scene = |scene: &SceneSummary| -> Vec<String> {
        let cells = view.left_out(&scene.id, spp).into_iter().map(|(cell, _)| cell);
        cells.map(|cell| format!("{} on {}", cell.label, scene.title)).collect()
    };
    let left_out: Vec<String> = view.summary.scenes.iter().flat_map(of_scene).collect();
    if !left_out.is_empty() {
        sentences.push(format!("Not ranked, for the reasons below the tables: {}.", format::list(&left_out)));
    }
    Some(Answer { question: "Which is closest to the truth?".into(), sentences, tone: Tone::Plain })
}

/// Rows that are best or tied with the best on every scene.
fn everywhere<'a>(winners: &[Winners<'a>]) -> Vec<&'a str> {
    let first = winners.first().map_or(&[][..], |w| &w.group);
    first.iter().copied().filter(|l| winners.iter().all(|w| w.group.contains(l))).collect()
}

/// The sentence that names the best rows; nothing if nothing ran.
fn lead(view: &View<'_>, winners: &[Winners<'_>], everywhere: &[&str], spp: u32) -> Option<String> {
    let (metric, name) = view.primary();
    let best = view.best_word(metric);
    let total = winners.len();
    let planned = view.planned_scenes(spp);
    let unfinished = winners.iter().any(|w| !view.complete_at(&w.scene.id, spp)) || total < planned;
    let start = if unfinished { format!("So far, at {spp} spp,") } else { format!("At {spp} spp,") };
    let place = match (planned, total) {
        (_, 0) => return None,
        (..=1, _) => String::new(),
        (planned, total) if planned == total => format!(" on all {total} scenes"),
        (planned, total) => format!(" on {total} of {planned} scenes, those that have it"),
    };
    Some(match everywhere {
        [] => {
            let parts: Vec<String> = winners.iter().map(of_scene).collect();
            format!("{start} no method is best everywhere. The {best} {name}: {}.", parts.join("; "))
        }
        [label] => {
            let alone = winners.iter().filter(|w| w.group.len() == 1).count();
            match (alone, total - alone) {
                (_, 0) => format!("{start} {label} has the {best} {name}{place}."),
                (0, _) => {
                    let others = format::list(&others(winners, label));
                    format!("{start} {label} is tied for the {best} {name}{place}, with {others}.")
                }
                (alone, _) => format!(
                    "{start} {label} has the {best} {name} on {alone} of {total} scenes and is tied with the best on the others."
                ),
            }
        }
        many => format!(
            "{start} {} are tied for the {best} {name}{place}: the replicates cannot tell them apart.",
            format::list(many)
        ),
    })
}

fn of_scene(w: &Winners<'_>) -> String {
    match w.group.as_slice() {
        [] => String::new(),
        [label] => format!("{label} on {}", w.scene.title),
        [label, others @ ..] => {
            format!("{label} on {} (tied with {})", w.scene.title, format::list(others))
        }
    }
}

/// Rows other than this one that are tied with the best somewhere.
fn others<'a>(winners: &[Winners<'a>], label: &str) -> Vec<&'a str> {
    let mut others: Vec<&str> =
        winners.iter().flat_map(|w| &w.group).copied().filter(|l| *l != label).collect();
    others.sort_unstable();
    others.dedup();
    others
}

/// Range over the scenes of how many times the rows' errors are below plain Monte Carlo's, if they are below on all.
fn gain(view: &View<'_>, labels: &[&str], spp: u32) -> Option<String> {
    let (metric, _) = view.primary();
    if labels.is_empty() || labels.iter().any(|label| Some(*label) == view.baseline()) {
        return None;
    }
    let of = |scene: &SceneSummary, label: &str| {
        Some(view.cell(&scene.id, spp, label)?.ratio_to_mc.get(metric)?.value)
    };
    let scenes = || view.summary.scenes.iter();
    let ratios: Vec<f64> = labels.iter().flat_map(|label| scenes().filter_map(|s| of(s, label))).collect();
    let low = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ratios.iter().copied().fold(0.0, f64::max);
    if !(low > 0.0 && high < 1.0) {
        return None;
    }
    let (least, most) = (format::ratio(1.0 / high), format::ratio(1.0 / low));
    Some(if least == most { least } else { format!("{least} to {most}") })
}
