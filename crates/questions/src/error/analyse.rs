use std::collections::{BTreeMap, BTreeSet};

use noisefloor_stats::{MonteCarloFit, equal_error_multiplier, monte_carlo_constant};

use crate::records::Index;
use crate::records::{LEVEL, bias, mean, median, metric, told, value};
use crate::records::{error_ratio, reference_share, series};
use noisefloor_study::context::{RowContext, SceneContext};
use noisefloor_study::record::Record;
use noisefloor_study::summary::{CellSummary, Interval, Source, Summary};

pub(super) fn analyse(index: &Index<'_>, summary: &mut Summary) {
    summary.cells = cells(index);
    summary.skipped = index.skipped();
}

/// Averages over replicates, per scene, level and row.
fn cells(index: &Index<'_>) -> Vec<CellSummary> {
    let mut out = Vec::new();
    for scene in index.scenes() {
        let fits = monte_carlo(index, scene);
        for spp in index.levels_of(scene) {
            for row in index.rows() {
                let records = index.records(scene, spp, &row.summary.label);
                if !records.is_empty() {
                    out.push(Cell { index, scene, spp, row, records }.summary(&fits));
                }
            }
        }
    }
    out
}

/// Id of a squared error to the constant of plain Monte Carlo's error = c/n.
pub(crate) type Fits = BTreeMap<String, MonteCarloFit>;

/// Fits the squared errors of the baseline, whose expectation is exactly c/n if samples are independent.
pub(crate) fn monte_carlo(index: &Index<'_>, scene: &SceneContext) -> Fits {
    let Some(baseline) = index.baseline() else { return Fits::new() };
    // With new photon maps in each replicate the expectation is c/n and the error of the maps.
    if crate::cell::void(scene.sampling).is_some() || scene.fresh_maps() {
        return Fits::new();
    }
    // The root of a squared error needs as many samples as that.
    let squared: BTreeSet<&str> =
        index.study.metrics.iter().filter_map(|id| noisefloor_study::metric::squared(id)).collect();
    squared
        .into_iter()
        .filter_map(|id| {
            let levels = series(index, scene, &baseline.summary.label, id);
            Some((id.to_owned(), monte_carlo_constant(&levels, LEVEL)?))
        })
        .collect()
}

/// The ratio of the baseline to itself.
fn itself(records: &[&Record]) -> Interval {
    Interval {
        value: 1.0,
        standard_error: Some(0.0),
        low: Some(1.0),
        high: Some(1.0),
        confidence: LEVEL.confidence(),
        n: records.len() as u32,
        source: Source::Replicates,
        below: None,
    }
}

struct Cell<'a> {
    index: &'a Index<'a>,
    scene: &'a SceneContext,
    spp: u32,
    row: &'a RowContext,
    records: &'a [&'a Record],
}

impl Cell<'_> {
    fn summary(&self, fits: &Fits) -> CellSummary {
        let records = self.records;
        let label = &self.row.summary.label;
        let every = self.index.every_record(self.scene, self.spp, label);
        let runs: Vec<f64> = records.iter().flat_map(|r| r.seconds.denoise_runs.iter().copied()).collect();
        let classes: BTreeSet<&String> = records.iter().flat_map(|r| r.classes.keys()).collect();
        let multipliers = self.multipliers(fits);
        CellSummary {
            scene: self.scene.id.clone(),
            spp: self.spp,
            label: label.clone(),
            metrics: self.means(None),
            ratio_to_mc: self.ratios(None),
            reference_bias: self.reference_bias(),
            classes: classes.iter().map(|c| ((*c).clone(), self.means(Some(c)))).collect(),
            class_ratio_to_mc: classes
                .iter()
                .map(|c| ((*c).clone(), self.ratios(Some(c))))
                .filter(|(_, ratios)| !ratios.is_empty())
                .collect(),
            denoise_seconds: median(records.iter().filter_map(|r| r.seconds.denoise)),
            denoise_seconds_range: (!runs.is_empty()).then(|| {
                [runs.iter().copied().fold(f64::INFINITY, f64::min), runs.iter().copied().fold(0.0, f64::max)]
            }),
            render_seconds: median(records.iter().filter_map(|r| r.seconds.render)),
            equal_error_extrapolated: multipliers.iter().map(|(id, (_, far))| (id.clone(), *far)).collect(),
            equal_error: multipliers.into_iter().map(|(id, (interval, _))| (id, interval)).collect(),
            peak_memory_bytes: every.iter().filter_map(|r| r.peak_memory_bytes).max(),
            enclosure_worst_ratio: every
                .iter()
                .flat_map(|r| &r.enclosures)
                .map(|check| check.worst_ratio)
                .reduce(f64::max),
            figures: self.figures(),
            replicates: records.len() as u32,
            planned_replicates: self.scene.replicates.get(&self.spp).copied().unwrap_or(0),
            pixels: records.iter().map(|r| r.pixels).min().unwrap_or(0),
            pixels_of: records.iter().map(|r| r.pixels_of).max().unwrap_or(0),
            left_out: self.index.left_out(self.scene, self.spp, label).map(str::to_owned),
            invalid_input_pixels: every.iter().map(|r| r.non_finite.input_pixels as u64).sum(),
            non_finite_output: every.iter().map(|r| r.non_finite.output_values as u64).sum(),
        }
    }

    fn means(&self, class: Option<&str>) -> BTreeMap<String, Interval> {
        let floor = &self.scene.reference.floor;
        let ids = self.index.study.metrics.iter();
        ids.filter_map(|id| Some((id.clone(), metric(self.records, class, id, floor.get(id).copied())?)))
            .collect()
    }

    fn reference_bias(&self) -> BTreeMap<String, f64> {
        let ids = self.index.study.metrics.iter();
        let of = |id: &String| Some((id.clone(), bias(self.records, None, id).filter(|bias| *bias != 0.0)?));
        ids.filter_map(of).collect()
    }

    /// Ratios of errors to the baseline's on the same frames; none for scores, nor where a corrected error is not
    /// positive.
    fn ratios(&self, class: Option<&str>) -> BTreeMap<String, Interval> {
        let Some(baseline) = self.index.baseline() else { return BTreeMap::new() };
        let of_baseline = self.index.records(self.scene, self.spp, &baseline.summary.label);
        let errors =
            self.index.study.metrics.iter().filter(|id| noisefloor_study::metric::lower_is_better(id));
        if self.row.summary.label == baseline.summary.label {
            // Certain, whatever the noise: the reference's share would not cancel in the general formula.
            return errors.map(|id| (id.clone(), itself(self.records))).collect();
        }
        errors.filter_map(|id| Some((id.clone(), self.ratio(of_baseline, class, id)?))).collect()
    }

    fn ratio(&self, of_baseline: &[&Record], class: Option<&str>, id: &str) -> Option<Interval> {
        let within = match self.records {
            [only] if class.is_none() => only.ratio_within_se.get(id).copied(),
            _ => None,
        };
        error_ratio(self.records, of_baseline, class, id, within)
    }

    fn multipliers(&self, fits: &Fits) -> BTreeMap<String, (Interval, bool)> {
        if self.index.left_out(self.scene, self.spp, &self.row.summary.label).is_some() {
            return BTreeMap::new();
        }
        let top = self.index.levels_of(self.scene).max().unwrap_or(self.spp);
        self.index
            .study
            .metrics
            .iter()
            .filter_map(|id| {
                let squared = noisefloor_study::metric::squared(id)?;
                let fit = fits.get(squared)?;
                let errors: Vec<f64> = self.records.iter().filter_map(|r| value(r, None, squared)).collect();
                let reference = reference_share(self.records, None, squared);
                let spent = self.records.first().and_then(|r| r.frame_spp).unwrap_or(self.spp);
                let (spp, top) = (f64::from(spent), f64::from(top));
                let multiplier = equal_error_multiplier(fit, spp, &errors, &reference, top, LEVEL)?;
                let interval = told(multiplier.interval, Source::Replicates, None);
                Some((id.clone(), (interval, multiplier.extrapolated)))
            })
            .collect()
    }

    fn figures(&self) -> BTreeMap<String, f64> {
        let names: BTreeSet<&String> = self.records.iter().flat_map(|r| r.figures.keys()).collect();
        let average = |name: &str| mean(self.records.iter().filter_map(|r| r.figures.get(name).copied()));
        names.into_iter().filter_map(|name| Some((name.clone(), average(name)?))).collect()
    }
}
