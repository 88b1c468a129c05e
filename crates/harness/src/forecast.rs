//! What a study will do and what its replicates can tell, without running it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use noisefloor_denoiser::Registry;
use noisefloor_questions::{Spread, spreads};
use noisefloor_study::plan::Item;
use noisefloor_study::record::Outcome;
use noisefloor_study::{Key, Study};

use crate::cache::Cache;
use crate::error::HarnessError;
use crate::plan::Plan;
use crate::recorded::KeptStudy;
use crate::store::{Layout, Records};

/// What a study will do.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// Everything, in the order in which a run works it off.
    pub items: Vec<Item>,
    /// Cells.
    pub cells: u64,
    /// Cells that are finished already.
    pub finished: u64,
    /// Camera samples still to be rendered: those of frames and references that unfinished cells need and the cache does
    /// not have.
    pub samples: u64,
    /// Seconds that the unfinished cells take on one core, to a factor of three: by what cards say, pixels and runs.
    pub seconds: f64,
}

/// Plans a study; `out` is the folder of its records and `cache` that of rendered frames, neither of which needs to be there.
/// Nothing is written. To know the keys of frames, a tiny one of every scene is rendered.
///
/// # Errors
/// As [`crate::run`] before any work, and [`HarnessError::Kept`] for records of a newer program.
pub fn forecast(
    study: &Study,
    registry: &Registry,
    size: Option<(usize, usize)>,
    out: &Path,
    cache: &Path,
) -> Result<Forecast, HarnessError> {
    let items = Plan::new(study, registry, size)?.items(study);
    let records = Records::read(&Layout::new(out).records())?.records;
    let ended: BTreeSet<&Key> =
        records.iter().filter(|r| !matches!(r.outcome, Outcome::Failed { .. })).map(|r| &r.cell).collect();
    let cache = Cache::unopened(cache);
    let (mut cells, mut finished, mut seconds) = (0, 0, 0.0);
    let (mut frames, mut scenes) = (BTreeSet::new(), BTreeSet::new());
    for item in &items {
        let Item::Cell(cell) = item else { continue };
        cells += 1;
        if ended.contains(&cell.key) {
            finished += 1;
            continue;
        }
        seconds += cell.seconds;
        scenes.insert(&cell.scene);
        frames.extend(std::iter::once(&cell.frame).chain(&cell.beside));
    }
    let to_render = |item: &Item| match item {
        Item::Frame(frame) if frames.contains(&frame.key) && !cache.has(&frame.key) => frame.samples,
        Item::Reference(range) if scenes.contains(&range.scene) && !range.key.is_empty() => {
            if cache.has(&range.key) { 0 } else { range.samples }
        }
        _ => 0,
    };
    let samples = items.iter().map(to_render).sum();
    Ok(Forecast { cells, finished, samples, seconds, items })
}

/// How much ratios of errors differed between the replicates of a study that was run, or of a recorded one; see [`Spread`].
/// `metric` is the study's primary metric unless given.
///
/// # Errors
/// As [`crate::analysis_of`].
pub fn spreads_of(dir: &Path, metric: Option<&str>) -> Result<SpreadsOf, HarnessError> {
    let kept = KeptStudy::read(dir)?;
    let sizes = kept.context.scenes.iter().map(|scene| (scene.id.clone(), (scene.width, scene.height)));
    let sizes = sizes.collect();
    Ok(SpreadsOf { spreads: spreads(&kept.records, metric.unwrap_or(&kept.study.primary_metric)), sizes })
}

/// Spreads over replicates, and of images of which size.
#[derive(Debug)]
pub struct SpreadsOf {
    /// By scene, level and pair.
    pub spreads: Vec<Spread>,
    /// Columns and rows of each scene.
    pub sizes: BTreeMap<String, (usize, usize)>,
}
