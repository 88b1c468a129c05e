//! The first screen: what won, by how much, what held, what broke.

use std::collections::BTreeMap;

use noisefloor_harness::summary::{Interval, SceneSummary};
use serde::Serialize;

use crate::format;
use crate::index::Index;

/// A question with its answer in a sentence or a few.
#[derive(Debug, Serialize)]
pub(crate) struct Answer {
    pub question: &'static str,
    pub sentences: Vec<String>,
    /// `good`, `bad` or `plain`.
    pub tone: &'static str,
}

/// Best row per scene and level.
#[derive(Debug, Serialize)]
pub(crate) struct Board {
    pub spp: Vec<u32>,
    pub chosen: Option<u32>,
    pub rows: Vec<BoardRow>,
}

/// A scene of the board.
#[derive(Debug, Serialize)]
pub(crate) struct BoardRow {
    pub title: String,
    /// One per level; nothing where no row ran.
    pub cells: Vec<Option<BoardCell>>,
}

/// The best row of a scene at a level.
#[derive(Debug, Serialize)]
pub(crate) struct BoardCell {
    pub label: String,
    pub swatch: usize,
    /// How many times below plain Monte Carlo's error.
    pub factor: String,
    /// Other rows that cannot be told from it.
    pub tied: Vec<String>,
    pub is_baseline: bool,
    /// Cells of the level are missing.
    pub unfinished: bool,
}

/// A scene's verdict and its pictures.
#[derive(Debug, Serialize)]
pub(crate) struct SceneCard {
    pub id: String,
    pub title: String,
    pub sentences: Vec<String>,
    pub spp: u32,
    /// Rows whose images stand beside the reference.
    pub shown: Vec<String>,
    /// The same as JSON, for the page's script.
    pub shown_json: String,
}

/// The four questions of the page's top.
pub(crate) fn answers(index: &Index<'_>) -> Vec<Answer> {
    let mut answers = Vec::new();
    answers.extend(error(index));
    answers.extend(cost(index));
    answers.extend(claims(index));
    answers.push(breaks(index));
    answers
}

/// The best of a scene and what the replicates cannot tell from it, best first.
struct Winners<'a> {
    scene: &'a SceneSummary,
    group: Vec<&'a str>,
    single: bool,
}

fn error(index: &Index<'_>) -> Option<Answer> {
    let spp = index.default_spp()?;
    let metric = &index.summary.study.primary_metric;
    let winners: Vec<Winners<'_>> = index
        .summary
        .scenes
        .iter()
        .filter_map(|scene| {
            let &label = index.ranking(&scene.id, spp, metric).first()?;
            let tied = index.tied(&scene.id, spp, metric, label);
            let group = std::iter::once(label).chain(tied).collect();
            Some(Winners { scene, group, single: index.single(&scene.id, spp) })
        })
        .collect();
    let (mut lead, named) = lead(index, &winners, spp, metric)?;
    if let Some(range) = gain(index, &named, spp, metric) {
        let whose = if named.len() == 1 { "Its error is" } else { "Their errors are" };
        lead = format!("{lead} {whose} {range} times below plain Monte Carlo's.");
    }
    let mut sentences = vec![lead];
    if winners.iter().any(|w| w.single) {
        sentences.push("One replicate: other random seeds may give another order.".into());
    }
    let left_out: Vec<String> = index
        .summary
        .scenes
        .iter()
        .flat_map(|scene| index.left_out(&scene.id, spp).into_iter().map(move |(cell, _)| (scene, cell)))
        .map(|(scene, cell)| format!("{} on {}", cell.label, scene.title))
        .collect();
    if !left_out.is_empty() {
        sentences.push(format!("Not ranked, for the reasons below the tables: {}.", format::list(&left_out)));
    }
    Some(Answer { question: "Which is closest to the truth?", sentences, tone: "plain" })
}

/// The sentence that names the best rows, and those of them that are best everywhere.
fn lead<'a>(
    index: &Index<'a>,
    winners: &[Winners<'a>],
    spp: u32,
    metric: &str,
) -> Option<(String, Vec<&'a str>)> {
    let (name, best) = (index.metric_name(metric), best_word(index, metric));
    let (first, total) = (winners.first()?, winners.len());
    let planned = index.planned_scenes(spp);
    let unfinished = winners.iter().any(|w| !index.complete_at(&w.scene.id, spp)) || total < planned;
    let start = if unfinished { format!("So far, at {spp} spp,") } else { format!("At {spp} spp,") };
    let place = match (planned, total) {
        (..=1, _) => String::new(),
        (planned, total) if planned == total => format!(" on all {total} scenes"),
        (planned, total) => format!(" on {total} of {planned} scenes, those that have it"),
    };
    // Rows that are best or tied with the best on every scene.
    let everywhere: Vec<&str> =
        first.group.iter().copied().filter(|l| winners.iter().all(|w| w.group.contains(l))).collect();
    let sentence = match everywhere.as_slice() {
        [] => {
            let part = |w: &Winners<'_>| {
                let tied = match &w.group[1..] {
                    [] => String::new(),
                    others => format!(" (tied with {})", format::list(others)),
                };
                format!("{} on {}{tied}", w.group[0], w.scene.title)
            };
            let parts: Vec<String> = winners.iter().map(part).collect();
            format!("{start} no method is best everywhere. The {best} {name}: {}.", parts.join("; "))
        }
        [label] => {
            let alone = winners.iter().filter(|w| w.group.len() == 1).count();
            match (alone, total - alone) {
                (_, 0) => format!("{start} {label} has the {best} {name}{place}."),
                (0, _) => {
                    let mut others: Vec<&str> =
                        winners.iter().flat_map(|w| &w.group).copied().filter(|l| l != label).collect();
                    others.sort_unstable();
                    others.dedup();
                    format!(
                        "{start} {label} is tied for the {best} {name}{place}, with {}.",
                        format::list(&others)
                    )
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
    };
    Some((sentence, everywhere))
}

/// Range over the scenes of how many times the rows' errors are below plain Monte Carlo's, if they are below on all.
fn gain(index: &Index<'_>, labels: &[&str], spp: u32, metric: &str) -> Option<String> {
    if labels.is_empty() || labels.iter().any(|label| Some(*label) == index.baseline()) {
        return None;
    }
    let of = |scene: &SceneSummary, label: &str| {
        Some(index.cell(&scene.id, spp, label)?.ratio_to_mc.get(metric)?.value)
    };
    let scenes = || index.summary.scenes.iter();
    let ratios: Vec<f64> = labels.iter().flat_map(|label| scenes().filter_map(|s| of(s, label))).collect();
    let low = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    let high = ratios.iter().copied().fold(0.0, f64::max);
    if !(low > 0.0 && high < 1.0) {
        return None;
    }
    let (least, most) = (format::ratio(1.0 / high), format::ratio(1.0 / low));
    Some(if least == most { least } else { format!("{least} to {most}") })
}

fn best_word(index: &Index<'_>, metric: &str) -> &'static str {
    if index.metric(metric).is_none_or(|m| m.lower_is_better) { "lowest" } else { "highest" }
}

/// Times per frame, of frames of one size at a time: larger frames take longer, whatever the method.
fn cost(index: &Index<'_>) -> Option<Answer> {
    let spp = index.default_spp()?;
    let mut sizes: BTreeMap<(u64, u32, u32), Vec<&SceneSummary>> = BTreeMap::new();
    for scene in &index.summary.scenes {
        let pixels = u64::from(scene.width) * u64::from(scene.height);
        sizes.entry((pixels, scene.width, scene.height)).or_default().push(scene);
    }
    let of_size = |((_, w, h), scenes): (&(u64, u32, u32), &Vec<&SceneSummary>)| {
        Some(format!("{}.", cost_of(index, scenes, spp, &format!("a frame of {w}×{h}"))?))
    };
    let sentences: Vec<String> = sizes.iter().rev().filter_map(of_size).collect();
    (!sentences.is_empty()).then_some(Answer { question: "What does it cost?", sentences, tone: "plain" })
}

/// The fastest and the slowest row on frames of one size, beside their rendering.
fn cost_of(index: &Index<'_>, scenes: &[&SceneSummary], spp: u32, frame: &str) -> Option<String> {
    let mut times: Vec<(f64, &str)> = Vec::new();
    for method in index.summary.methods.iter().filter(|m| m.method != "mc") {
        let of = |s: &&SceneSummary| index.cell(&s.id, spp, &method.label)?.denoise_seconds;
        let seconds = scenes.iter().filter_map(of).fold(0.0, f64::max);
        if seconds > 0.0 {
            times.push((seconds, &method.label));
        }
    }
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sentence = match times.as_slice() {
        [] => return None,
        [(t, label)] => format!("{label} takes {} {frame}", format::duration(*t)),
        [fast, .., slow] => format!(
            "From {} ({}) to {} ({}) {frame}",
            format::duration(fast.0),
            fast.1,
            format::duration(slow.0),
            slow.1
        ),
    };
    let rendering: Vec<f64> = scenes.iter().filter_map(|s| s.render_seconds.get(&spp).copied()).collect();
    let longest = rendering.iter().copied().fold(0.0, f64::max);
    let shortest = rendering.iter().copied().fold(f64::INFINITY, f64::min);
    if longest > 0.0 {
        let span = if longest < 1.2 * shortest {
            format::duration(longest)
        } else {
            format!("{} to {}", format::duration(shortest), format::duration(longest))
        };
        sentence += &format!(", beside {span} for rendering its {spp} spp");
    }
    Some(sentence)
}

fn claims(index: &Index<'_>) -> Option<Answer> {
    let summary = index.summary;
    let mut sentences = Vec::new();
    // Green is for promises that were tested and held; coverage alone, or a study that was stopped, shows none.
    let mut tone = "plain";
    let good = if index.complete() { "good" } else { "plain" };
    sentences.extend(coverage_sentence(index));
    for (proven, kind) in [(true, "proven (for normal samples)"), (false, "printed but unproven")] {
        let of_kind: Vec<_> =
            summary.bounds.iter().filter(|b| b.class == "all" && b.proven == proven).collect();
        if of_kind.is_empty() {
            continue;
        }
        let broken = of_kind.iter().filter(|b| b.verdict == "fails").count();
        let undecided = of_kind.iter().filter(|b| b.verdict == "undecided").count();
        if broken > 0 {
            tone = "bad";
            let worst = of_kind
                .iter()
                .max_by(|a, b| (a.violations.value * b.alpha).total_cmp(&(b.violations.value * a.alpha)));
            let example = worst.map_or_else(String::new, |b| {
                let missed = if b.missed > 0.0 {
                    format!("; {} from missed events", format::percent(b.missed))
                } else {
                    String::new()
                };
                format!(
                    "; worst {} beside a promised {} ({}, {} spp, {}{missed})",
                    format::percent(b.violations.value),
                    format::percent_short(b.alpha),
                    index.scene_title(&b.scene),
                    b.spp,
                    b.label
                )
            });
            sentences.push(format!(
                "Error bounds, {kind}: broken more often than promised in {broken} of {} cells{example}.",
                of_kind.len()
            ));
        } else if undecided > 0 {
            sentences.push(format!(
                "Error bounds, {kind}: undecided in {undecided} of {} cells, where one replicate gives no interval; broken no \
                 more often than promised in the others.",
                of_kind.len()
            ));
        } else {
            tone = if tone == "plain" { good } else { tone };
            sentences.push(format!(
                "Error bounds, {kind}: broken no more often than promised in all {} cells.",
                of_kind.len()
            ));
        }
    }
    let ratios: Vec<f64> = summary.cells.iter().filter_map(|c| c.enclosure_worst_ratio).collect();
    if !ratios.is_empty() {
        let worst = ratios.iter().copied().fold(0.0, f64::max);
        if worst <= 1.0 {
            tone = if tone == "plain" { good } else { tone };
            sentences.push("No output left its confidence interval where the method promises that.".into());
        } else {
            tone = "bad";
            sentences.push(format!(
                "An output left the interval that its method promises, by a factor of {}.",
                format::ratio(worst)
            ));
        }
    }
    (!sentences.is_empty()).then_some(Answer { question: "Do the statistical claims hold?", sentences, tone })
}

/// Range of the coverage over the scenes at the first and the last level, for the lowest nominal level.
fn coverage_sentence(index: &Index<'_>) -> Option<String> {
    let all = || index.summary.coverage.iter().filter(|c| c.class == "all");
    let nominal = all().map(|c| c.confidence).fold(f64::INFINITY, f64::min);
    let (first, last) = (all().map(|c| c.spp).min()?, all().map(|c| c.spp).max()?);
    let range = |spp: u32| {
        let values = all().filter(|c| c.spp == spp && c.confidence == nominal).map(|c| c.covered.value);
        let (low, high) =
            values.fold((f64::INFINITY, 0.0f64), |(low, high), v| (f64::min(low, v), high.max(v)));
        let (low, high) = (format::percent(low), format::percent(high));
        let text = if low == high { low } else { format!("{} to {high}", low.trim_end_matches(" %")) };
        format!("{text} of the pixels at {spp} spp")
    };
    let at_last = if last > first { format!(", {}", range(last)) } else { String::new() };
    let nominal = format::percent_short(nominal);
    Some(format!("Nominal {nominal} intervals of the input cover {}{at_last}.", range(first)))
}

fn breaks(index: &Index<'_>) -> Answer {
    let summary = index.summary;
    let count = |status: &str| summary.skipped.iter().filter(|s| s.status == status).count();
    let (failed, skipped) = (count("failed"), count("skipped"));
    let lost: u64 = summary.cells.iter().map(|c| c.non_finite_output).sum();
    let (ran, known) = (!summary.cells.is_empty(), summary.progress.is_some());
    let mut sentences = Vec::new();
    match &summary.progress {
        _ if !ran => sentences.push("Nothing ran.".to_owned()),
        Some(progress) if !progress.complete() => sentences.push(format!(
            "The study is unfinished: {} of {} cells ended.",
            progress.finished, progress.planned
        )),
        Some(_) if failed + skipped == 0 => sentences.push("Every method ran on every frame.".into()),
        _ => {}
    }
    if skipped > 0 {
        let rows = format::plural(skipped, "row");
        sentences.push(format!("{rows} skipped, with the reason below the tables."));
    }
    if failed > 0 {
        sentences.push(format!("{} ended in an error.", format::plural(failed, "row")));
    }
    if lost > 0 {
        sentences.push(format!("{lost} output values were not finite."));
    } else if ran {
        let so_far =
            if index.complete() { "All outputs are finite." } else { "All outputs so far are finite." };
        sentences.push(so_far.into());
    }
    let tone = match failed > 0 || lost > 0 {
        true => "bad",
        false if ran && known && index.complete() && skipped == 0 => "good",
        false => "plain",
    };
    Answer { question: "Does anything break?", sentences, tone }
}

/// The best rows of all scenes and levels.
pub(crate) fn board(index: &Index<'_>) -> Board {
    let study = &index.summary.study;
    let metric = &study.primary_metric;
    let rows = index.summary.scenes.iter().map(|scene| BoardRow {
        title: scene.title.clone(),
        cells: study.spp.iter().map(|&spp| board_cell(index, &scene.id, spp, metric)).collect(),
    });
    Board { rows: rows.collect(), spp: study.spp.clone(), chosen: index.default_spp() }
}

fn board_cell(index: &Index<'_>, scene: &str, spp: u32, metric: &str) -> Option<BoardCell> {
    let label = *index.ranking(scene, spp, metric).first()?;
    let cell = index.cell(scene, spp, label)?;
    let is_baseline = Some(label) == index.baseline();
    let factor = match cell.ratio_to_mc.get(metric) {
        _ if is_baseline => String::new(),
        Some(r) if r.value > 0.0 && r.value < 1.0 => format!("{}× lower", format::ratio(1.0 / r.value)),
        _ => cell.metrics.get(metric).map(|i| format::interval(i).value).unwrap_or_default(),
    };
    Some(BoardCell {
        label: label.to_owned(),
        swatch: index.summary.methods.iter().position(|m| m.label == label).unwrap_or(0),
        factor,
        tied: index.tied(scene, spp, metric, label).into_iter().map(str::to_owned).collect(),
        is_baseline,
        unfinished: !index.complete_at(scene, spp),
    })
}

/// One card per scene at the level that the page opens with.
pub(crate) fn cards(index: &Index<'_>) -> Vec<SceneCard> {
    let Some(spp) = index.default_spp() else { return Vec::new() };
    index.summary.scenes.iter().map(|scene| card(index, scene, spp)).collect()
}

fn card(index: &Index<'_>, scene: &SceneSummary, spp: u32) -> SceneCard {
    let metric = &index.summary.study.primary_metric;
    let ranking = index.ranking(&scene.id, spp, metric);
    let baseline = index.baseline();
    let best = ranking.first().copied();
    let mut shown: Vec<String> = baseline.map(str::to_owned).into_iter().collect();
    // Where nothing beats the input, the next best shows what denoising did.
    shown.extend(ranking.iter().find(|l| Some(**l) != baseline).map(|l| (*l).to_owned()));
    let sentences = best.map_or_else(
        || vec![format!("Nothing ran at {spp} spp.")],
        |label| sentences(index, &scene.id, spp, metric, label),
    );
    let shown_json = serde_json::Value::from(shown.clone()).to_string();
    SceneCard { id: scene.id.clone(), title: scene.title.clone(), sentences, spp, shown, shown_json }
}

fn sentences(index: &Index<'_>, scene: &str, spp: u32, metric: &str, label: &str) -> Vec<String> {
    let (name, best) = (index.metric_name(metric), best_word(index, metric));
    let baseline = index.baseline();
    let group = index.tied(scene, spp, metric, label);
    let complete = index.complete_at(scene, spp);
    let start = if complete { format!("At {spp} spp") } else { format!("So far, at {spp} spp") };
    let mut out = Vec::new();
    if Some(label) == baseline {
        out.push(format!("{start} no method beats the unfiltered input in {name}."));
    } else {
        let mut sentence = match group.is_empty() {
            true => format!("{start}, {label} has the {best} {name}"),
            false => format!("{start}, {label} is tied for the {best} {name}"),
        };
        let cell = index.cell(scene, spp, label);
        let ratio = cell.and_then(|c| c.ratio_to_mc.get(metric)).filter(|r| r.value > 0.0 && r.value < 1.0);
        if let Some(ratio) = ratio {
            sentence += &format!(", {} below plain Monte Carlo", times(ratio));
        }
        let equal = cell.and_then(|c| c.equal_error.get(metric)).filter(|e| e.value > 0.0);
        if let Some(equal) = equal {
            let beyond = cell.and_then(|c| c.equal_error_extrapolated.get(metric)) == Some(&true);
            let note = if beyond { " (extrapolated)" } else { "" };
            sentence += &format!(
                ". Plain Monte Carlo needs {}× the samples for that{note}",
                format::ratio(equal.value)
            );
        }
        out.push(sentence + ".");
    }
    if !group.is_empty() {
        out.push(format!("The replicates cannot tell it from {}.", format::list(&group)));
    }
    if index.single(scene, spp) {
        out.push("One replicate: other random seeds may give another order.".into());
    }
    let left_out: Vec<&str> =
        index.left_out(scene, spp).into_iter().map(|(cell, _)| cell.label.as_str()).collect();
    if !left_out.is_empty() {
        out.push(format!("Not ranked: {}.", format::list(&left_out)));
    }
    out
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
