//! Statements that a reader must see before the numbers.

use noisefloor_frame::Sampling;
use noisefloor_study::context::SceneContext;
use noisefloor_study::summary::{CellSummary, Status, Summary, Warning, WarningKind};

use crate::cell::void;
use crate::error::monte_carlo;
use crate::records::{Index, LONG_ENOUGH, reference_ratio, times};

/// Standard errors by which a level may differ from plain Monte Carlo's c/n before it is told.
const DEVIATION: f64 = 5.0;

/// Cells whose output left an interval that it claims never to leave: scene, level, row and the worst ratio. Empty
/// unless a method is broken or claims too much.
#[must_use]
pub fn violations(summary: &Summary) -> Vec<String> {
    let worst = |cell: &CellSummary| cell.enclosure_worst_ratio.filter(|ratio| *ratio > 1.0);
    let sentence = |cell: &CellSummary| {
        let ratio = worst(cell)?;
        Some(format!(
            "{} on {} at {} spp left an interval that it claims never to leave, by a factor of {ratio:.4}",
            cell.label, cell.scene, cell.spp
        ))
    };
    summary.cells.iter().filter_map(sentence).collect()
}

/// What a reader must see first, most serious first.
pub(super) fn warnings(index: &Index<'_>, summary: &Summary) -> Vec<Warning> {
    let broken = violations(summary).into_iter();
    let mut out: Vec<Warning> = broken.map(|text| Warning::new(WarningKind::Enclosure, text)).collect();
    out.extend(failed(summary));
    if summary.progress.is_none() {
        out.push(Warning::new(
            WarningKind::UnknownPlan,
            "how many cells the study asks for is unknown (the list of its folders' frames was not kept): whether it is finished \
             cannot be told",
        ));
    }
    out.extend(left_out(summary));
    if index.baseline().is_none() {
        out.push(Warning::new(
            WarningKind::NoBaseline,
            "no row is plain Monte Carlo: ratios, equal-error multipliers and coverage are absent",
        ));
    }
    for row in &summary.methods {
        let ran = summary.cells.iter().any(|cell| cell.label == row.label);
        let gave = summary.estimates.iter().any(|estimate| estimate.label == row.label);
        if row.estimates_error && ran && !gave {
            let text = "claims an estimate of its own error and gave none";
            out.push(Warning::about(WarningKind::NoEstimate, &row.label, text));
        }
    }
    for scene in index.scenes() {
        of_scene(index, scene, summary, &mut out);
    }
    // About times, not about inputs: here alone, so that it is said once.
    if summary.environment.profile == "debug" {
        out.push(Warning::new(
            WarningKind::Times,
            "times are of a debug build and say nothing about the methods",
        ));
    }
    out
}

/// Rows that ended in an error, those with the same one together; what a finding says of the frame is not said again.
fn failed(summary: &Summary) -> Vec<Warning> {
    let told: Vec<String> = summary.findings.iter().map(ToString::to_string).collect();
    let failed = summary.skipped.iter().filter(|entry| entry.status == Status::Failed);
    let fresh = failed.filter(|entry| !told.contains(&entry.reason));
    let mut groups = Groups::default();
    for entry in fresh {
        let spp: Vec<String> = entry.spp.iter().map(u32::to_string).collect();
        groups.add(entry.label.as_str(), (&entry.scene, spp, &entry.reason));
    }
    let line = |(labels, (scene, spp, reason)): (Vec<&str>, (&String, Vec<String>, &String))| {
        let about = format!("{} failed on {scene} at {} spp", labels.join(", "), spp.join(", "));
        Warning::about(WarningKind::Failed, about, reason)
    };
    groups.0.into_iter().map(line).collect()
}

/// Rows that are not ranked: levels with the same reason together, then rows.
fn left_out(summary: &Summary) -> Vec<Warning> {
    let mut levels = Groups::default();
    for cell in &summary.cells {
        if let Some(reason) = &cell.left_out {
            levels.add(cell.spp.to_string(), (&cell.scene, &cell.label, reason));
        }
    }
    let mut rows = Groups::default();
    for (spp, (scene, label, reason)) in levels.0 {
        rows.add(label.as_str(), (scene, spp, reason));
    }
    let line = |(labels, (scene, spp, reason)): (Vec<&str>, (&String, Vec<String>, &String))| {
        let are = if labels.len() == 1 { "is" } else { "are" };
        let about = format!("{} on {scene} at {} spp {are} not ranked", labels.join(", "), spp.join(", "));
        Warning::about(WarningKind::NotRanked, about, reason)
    };
    rows.0.into_iter().map(line).collect()
}

/// Things by what they share, both in the order in which they came.
struct Groups<T, K>(Vec<(Vec<T>, K)>);

impl<T, K> Default for Groups<T, K> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T, K: PartialEq> Groups<T, K> {
    fn add(&mut self, thing: impl Into<T>, shared: K) {
        match self.0.iter_mut().find(|(_, known)| *known == shared) {
            Some((things, _)) => things.push(thing.into()),
            None => self.0.push((vec![thing.into()], shared)),
        }
    }
}

fn of_scene(index: &Index<'_>, scene: &SceneContext, summary: &Summary, out: &mut Vec<Warning>) {
    let id = &scene.id;
    let mut tell = |kind, text: String| out.push(Warning::about(kind, id, text));
    let top = scene.replicates.keys().copied().max().unwrap_or(1);
    let ratio = reference_ratio(scene, top);
    if ratio == 0.0 {
        tell(
            WarningKind::ShortReference,
            String::from("how many samples the reference has is unknown; coverage and bounds may be off"),
        );
    } else if ratio < LONG_ENOUGH {
        tell(
            WarningKind::ShortReference,
            format!(
                "the reference has only {} times the samples of the {top} spp level; coverage and bounds are marked \
             where it has less than {LONG_ENOUGH:.0} times",
                times(ratio)
            ),
        );
    }
    if scene.sampling == Sampling::LowDiscrepancy {
        tell(
            WarningKind::NoIntervals,
            format!("coverage and bounds are left out ({})", void(scene.sampling).unwrap_or("")),
        );
    }
    let fresh = scene.fresh_maps();
    if fresh {
        tell(
            WarningKind::NoIntervals,
            String::from(
                "coverage and bounds are left out (photon maps are new in each replicate, and the variance between a frame's samples does \
             not know their error)",
            ),
        );
    }
    let counted = summary.coverage.iter().any(|row| row.scene == *id);
    if scene.sampling == Sampling::Independent && !fresh && top >= 2 && index.baseline().is_some() && !counted
    {
        tell(
            WarningKind::NoIntervals,
            String::from(
                "coverage and bounds are left out: the frames state no variance, or sample counts that differ between pixels and so \
             depend on the data",
            ),
        );
    }
    if scene.replicates.values().all(|&n| n == 1) {
        tell(
            WarningKind::OneReplicate,
            String::from(
                "one replicate per level; intervals are from blocks within the image and say nothing about other random seeds, \
             and rows cannot be told apart",
            ),
        );
    }
    let cells = || summary.cells.iter().filter(|cell| cell.scene == *id);
    let invalid = cells().map(|cell| cell.invalid_input_pixels).max().unwrap_or(0);
    if invalid > 0 {
        tell(
            WarningKind::FewerPixels,
            format!("up to {invalid} input pixels per level were not finite and are in no number"),
        );
    }
    let fewer = cells().filter(|cell| cell.left_out.is_none() && cell.pixels < cell.pixels_of);
    if let Some(least) = fewer.min_by_key(|cell| cell.pixels) {
        tell(
            WarningKind::FewerPixels,
            format!(
                "errors are over as few as {} of {} pixels, those where input, output and reference are finite",
                least.pixels, least.pixels_of
            ),
        );
    }
    for (metric, fit) in monte_carlo(index, scene) {
        if let Some(deviation) = fit.worst_deviation.filter(|deviation| *deviation > DEVIATION) {
            tell(
                WarningKind::Law,
                format!(
                    "{metric} of plain Monte Carlo deviates from c/n by {deviation:.1} standard errors; multipliers may be off"
                ),
            );
        }
    }
}
