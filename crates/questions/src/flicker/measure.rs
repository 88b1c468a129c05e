//! How much the error of an output changes over the frames of a sequence, from the kept images.

use std::collections::BTreeMap;

use noisefloor_frame::{Image, Reference};
use noisefloor_study::context::Context;
use noisefloor_study::record::{Outcome, Record};
use noisefloor_study::summary::{Warning, WarningKind};
use noisefloor_study::{Flicker, Study, files};

use super::over_time::Truth;

/// The images of a study's folder; errors are sentences for people.
pub trait Images {
    /// A denoised image, by its path relative to the folder.
    ///
    /// # Errors
    /// If it cannot be read.
    fn color(&self, path: &str) -> Result<Image, String>;

    /// A scene's reference.
    ///
    /// # Errors
    /// If it cannot be read.
    fn reference(&self, scene: &str) -> Result<Reference, String>;
}

/// All that could be measured, and what could not.
#[derive(Debug, Default)]
pub struct Sequences {
    /// The numbers.
    pub measured: Vec<Flicker>,
    /// Sequences that are left out, with the reason.
    pub problems: Vec<Warning>,
}

/// Measures every sequence of a study, replicate by replicate: frame t of replicate r belongs to replicate r of the
/// sequence. What has not run on all frames is left out; a file that cannot be read leaves its sequence out and is
/// told.
pub fn flicker(study: &Study, context: &Context, records: &[Record], images: &dyn Images) -> Sequences {
    let mut out = Sequences::default();
    for (name, frames) in study.sequences() {
        let ids: Vec<&str> = frames.iter().map(|scene| scene.id.as_str()).collect();
        // A study that was stopped has not come to all of them.
        let begun = ids.iter().all(|id| records.iter().any(|record| record.scene == *id));
        let lost = context.scenes.iter().filter(|scene| ids.contains(&scene.id.as_str()));
        let lost = lost.flat_map(|scene| scene.damaged.get(&files::reference(&scene.id))).next();
        if let Some(reference) = lost {
            let text = format!("flicker is left out: {reference} is not what was written, or is gone");
            out.problems.push(problem(name, text));
            continue;
        }
        match one_sequence(name, &ids, context, records, images) {
            Ok(found) if found.is_empty() && begun => out
                .problems
                .push(problem(name, "flicker is left out: no replicate of a row ran on all frames")),
            Ok(found) => out.measured.extend(found),
            Err(error) => out.problems.push(problem(name, format!("flicker is left out: {error}"))),
        }
    }
    out
}

/// A sequence that is left out.
fn problem(name: &str, text: impl Into<String>) -> Warning {
    Warning::about(WarningKind::NotMeasured, format!("sequence {name}"), text)
}

fn one_sequence(
    name: &str,
    ids: &[&str],
    context: &Context,
    records: &[Record],
    kept: &dyn Images,
) -> Result<Vec<Flicker>, String> {
    // By level, row and replicate: the images of all frames, in their order.
    let mut images: BTreeMap<(u32, usize, u32), Vec<Option<&str>>> = BTreeMap::new();
    for record in records.iter().filter(|record| record.outcome == Outcome::Done) {
        let Some(frame) = ids.iter().position(|id| *id == record.scene) else { continue };
        let row = context.methods.iter().position(|row| row.summary.label == record.label);
        let Some(row) = row else { continue };
        let key = (record.spp, row, record.replicate);
        images.entry(key).or_insert_with(|| vec![None; ids.len()])[frame] = record.image.as_deref();
    }
    let whole: Vec<_> = images
        .into_iter()
        .filter_map(|(key, images)| Some((key, images.into_iter().collect::<Option<Vec<&str>>>()?)))
        .collect();
    if whole.is_empty() {
        return Ok(Vec::new());
    }
    let references = ids.iter().map(|id| kept.reference(id));
    let truth = Truth::new(references)?;
    // The row that the others are compared with, by level; the order is that of levels and rows.
    let mut first: BTreeMap<u32, usize> = BTreeMap::new();
    whole.iter().for_each(|((spp, row, _), _)| {
        first.entry(*spp).or_insert(*row);
    });
    let beside: BTreeMap<(u32, u32), Vec<&str>> = whole
        .iter()
        .filter(|((spp, row, _), _)| first[spp] == *row)
        .map(|((spp, _, replicate), images)| ((*spp, *replicate), images.clone()))
        .collect();
    let mut out = Vec::new();
    for ((spp, row, replicate), images) in whole {
        let other = beside.get(&(spp, replicate)).filter(|_| first[&spp] != row);
        let outputs = images.iter().enumerate().map(|(frame, path)| {
            let other = other.map(|images| kept.color(images[frame])).transpose()?;
            Ok::<_, String>((kept.color(path)?, other))
        });
        out.extend(truth.over_time(outputs)?.map(|found| Flicker {
            sequence: name.to_owned(),
            spp,
            replicate,
            label: context.methods[row].summary.label.clone(),
            found,
        }));
    }
    Ok(out)
}
