//! All cells of one scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use noisefloor_denoiser::{Diagnostic, Input, Output, Unit};
use noisefloor_frame::{Counts, Finding, FindingKind, Frame, Hygiene, Image, Reference, Sampling};
use noisefloor_io::IoError;
use noisefloor_metrics::{Measurer, MetricError, block_bootstrap};

use crate::cache::{Cache, Key};
use crate::context::SceneContext;
use crate::error::HarnessError;
use crate::fingerprint::measuring;
use crate::machine;
use crate::measure::{Measure, ratio_within_se};
use crate::observer::Stage;
use crate::plan::{Plan, Row, wants_diagnostics};
use crate::record::{AdaptiveRecord, EstimateCheck, NonFinite, Outcome, RECORD_SCHEMA, Record, Seconds};
use crate::run::denoise::{Denoised, denoise};
use crate::run::inputs::Inputs;
use crate::run::prepare::{damaged_files, kept_context, truth};
use crate::run::settle::Owners;
use crate::run::{BOOTSTRAP_IMAGES, StudyRun, bootstrap_seed};
use crate::source::{FrameKind, FrameSpec, Scene};
use crate::store::{Layout, Records, hash_of};
use crate::study::Study;

/// Runs the cells of a scene.
pub(super) struct Runner<'a> {
    pub(super) request: &'a StudyRun<'a>,
    pub(super) plan: &'a Plan,
    pub(super) layout: &'a Layout,
    pub(super) cache: &'a Cache,
    pub(super) scene: &'a Scene,
    pub(super) owners: &'a Owners,
}

impl Runner<'_> {
    /// Runs what is not finished, and describes the scene for the analysis.
    pub(super) fn run(
        &self,
        records: &mut Records,
        kept: &BTreeSet<Key>,
    ) -> Result<SceneContext, HarnessError> {
        let (study, scene) = (self.request.study, self.scene);
        let work = frames(study, self.plan, scene, kept);
        if work.is_empty()
            && let Some(context) = kept_context(self.layout, scene)
        {
            return Ok(context);
        }
        for file in damaged_files(self.layout, scene) {
            let text = format!("{file} is not what was written or is gone; it is written again");
            self.request.observer.warning(&text);
        }
        let (truth, mut context) = truth(scene, self.cache, self.layout, self.request.observer)?;
        let measurer = truth.measurer(scene)?.with(&crate::metric::asked(&study.metrics));
        let mut inputs = Inputs::open(scene, self.layout, &truth.reference, &mut context);
        for (spec, rows) in work {
            self.request.observer.stage(&Stage::Frame {
                scene: scene.id.clone(),
                spp: spec.spp,
                replicate: spec.replicate,
            });
            let steering = rows.first().map(|(row, _)| *row);
            let made = scene.frame(&spec, steering, self.cache, self.request.observer);
            let made = made.and_then(|checked| Ok((checked, self.beside(&spec, &rows)?)));
            let (checked, beside) = match made {
                // A frame that contradicts itself, or a method that does not know where it needs samples, ends its
                // own cells, not the study.
                Err(error @ (HarnessError::Density { .. } | HarnessError::Unsound { .. })) => {
                    let refused = refused(&error);
                    for (row, key) in rows {
                        let mut record = self.blank(row, key, &spec, scene.sampling);
                        record.outcome = Outcome::Failed { reason: error.to_string() };
                        record.findings.extend(refused.clone());
                        records.append(record.clone())?;
                        self.request.observer.cell(&record, &record.outcome);
                    }
                    continue;
                }
                made => made?,
            };
            let (frame, hygiene, findings) = (&checked.frame, &checked.hygiene, checked.findings());
            let non_finite = NonFinite {
                input_pixels: hygiene.invalid_pixels,
                negative_variances: hygiene.negative_variances,
                output_values: 0,
            };
            let without = hygiene.without_statistics();
            let mut findings = findings;
            // One fault, told once: half buffers show it best.
            let told = findings.iter().any(|found| found.kind == FindingKind::VarianceAgainstHalves);
            let pairs = inputs.frame(&spec, frame, &without, &mut context)?;
            findings.extend(
                pairs.into_iter().filter(|f| !told || f.kind != FindingKind::VarianceAgainstReference),
            );
            let measure = Measure::new(frame, &truth.reference, &truth.classes, &without, scene.single());
            let cell = Cell {
                runner: self,
                measurer: &measurer,
                measure,
                reference: &truth.reference,
                spec: &spec,
                frame,
                hygiene,
                findings,
                beside,
            };
            for (row, key) in rows {
                if self.request.observer.cancelled() {
                    return Err(HarnessError::Cancelled);
                }
                let record = cell.run(row, key, non_finite)?;
                records.append(record.clone())?;
                self.request.observer.cell(&record, &record.outcome);
            }
        }
        Ok(context)
    }

    /// The record of a cell before it has run.
    fn blank(&self, row: &Row, key: Key, spec: &FrameSpec, sampling: Sampling) -> Record {
        Record {
            schema: RECORD_SCHEMA,
            cell: key,
            build: machine::build_id(),
            measuring: measuring().to_owned(),
            study: self.request.study.name.clone(),
            scene: self.scene.id.clone(),
            sampling,
            photon_maps: None,
            spp: spec.spp,
            replicate: spec.replicate,
            frame_spp: (spec.samples() != spec.spp).then_some(spec.samples()),
            adaptive: None,
            method: row.method.id.clone(),
            label: row.label.clone(),
            params: row.method.params.clone(),
            outcome: Outcome::Done,
            metrics: BTreeMap::new(),
            metrics_reference_se: BTreeMap::new(),
            reference: BTreeMap::new(),
            class_reference: BTreeMap::new(),
            metrics_within_se: BTreeMap::new(),
            ratio_within_se: BTreeMap::new(),
            pixels: 0,
            pixels_of: 0,
            classes: BTreeMap::new(),
            coverage: Vec::new(),
            bounds: Vec::new(),
            enclosures: Vec::new(),
            error_estimate: None,
            non_finite: NonFinite::default(),
            findings: Vec::new(),
            figures: BTreeMap::new(),
            seconds: Seconds { threads: rayon::current_num_threads() as u32, ..Seconds::default() },
            peak_memory_bytes: None,
            image: None,
            diagnostics: BTreeMap::new(),
            log: None,
            files: BTreeMap::new(),
        }
    }

    /// The neighbouring frames that some of the rows look at, by their distance.
    fn beside(&self, spec: &FrameSpec, rows: &[(&Row, Key)]) -> Result<BTreeMap<i64, Frame>, HarnessError> {
        let mut frames = BTreeMap::new();
        for (distance, spec) in rows.iter().flat_map(|(row, _)| self.scene.beside(spec, row)) {
            if let Some(moment) = self.scene.moment(distance).filter(|_| !frames.contains_key(&distance)) {
                let checked = moment.frame(&spec, None, self.cache, self.request.observer)?;
                frames.insert(distance, checked.frame);
            }
        }
        Ok(frames)
    }
}

/// A frame that could not be used is a finding about the inputs, in the same words as the failure of its cells.
fn refused(error: &HarnessError) -> Option<Finding> {
    let HarnessError::Unsound { frame, source } = error else { return None };
    Some(Finding::new(FindingKind::RefusedFrame, frame, source.to_string()))
}

/// Frames of a scene with the rows that are still to run on them: the study's own frames first, then each row's own.
pub(super) fn frames<'a>(
    study: &Study,
    plan: &Plan,
    scene: &'a Scene,
    kept: &BTreeSet<Key>,
) -> Vec<(FrameSpec, Vec<(&'a Row, Key)>)> {
    let mut out: Vec<(FrameSpec, Vec<(&Row, Key)>)> = Vec::new();
    for frame in &scene.frames {
        let first = out.len();
        for row in &scene.rows {
            let own = scene.frame_of(frame, row);
            let key = plan.cell_key(study, scene, &own, row);
            if kept.contains(&key) {
                continue;
            }
            match out[first..].iter_mut().find(|(spec, _)| spec.key == own.key) {
                Some((_, rows)) => rows.push((row, key)),
                None => out.push((own, vec![(row, key)])),
            }
        }
    }
    out
}

/// One frame against its truth.
struct Cell<'a> {
    runner: &'a Runner<'a>,
    measurer: &'a Measurer<'a>,
    measure: Measure<'a>,
    reference: &'a Reference,
    spec: &'a FrameSpec,
    frame: &'a Frame,
    /// What was mended in it.
    hygiene: &'a Hygiene,
    /// What was found about it, with its name.
    findings: Vec<Finding>,
    /// Neighbouring frames of its sequence, by their distance.
    beside: BTreeMap<i64, Frame>,
}

impl Cell<'_> {
    fn run(&self, row: &Row, key: Key, non_finite: NonFinite) -> Result<Record, HarnessError> {
        let (study, scene, spec) = (self.runner.request.study, self.runner.scene, self.spec);
        self.runner.request.observer.stage(&Stage::Denoise {
            scene: scene.id.clone(),
            spp: spec.spp,
            replicate: spec.replicate,
            label: row.label.clone(),
        });
        let mut record = self.runner.blank(row, key, spec, self.frame.sampling);
        record.photon_maps = crate::measure::photon_maps(self.frame);
        record.adaptive = adaptive(self.frame);
        record.non_finite = non_finite;
        record.findings.clone_from(&self.findings);
        record.seconds.render = self.frame.provenance.render_seconds;
        machine::reset_peak_memory();
        let diagnostics = wants_diagnostics(study, spec).then_some(study.probe);
        let reach = row.card.neighbors as i64;
        let side =
            |distances: std::ops::Range<i64>| self.beside.range(distances).map(|(_, f)| f.clone()).collect();
        let (before, after): (Vec<Frame>, Vec<Frame>) = (side(-reach..0), side(1..reach + 1));
        let input = Input::new(self.frame).with_neighbors(&before, &after);
        match denoise(row, input, &self.hygiene.findings, study.timing, diagnostics) {
            Ok(done) => self.measure(row, done, &mut record)?,
            Err(outcome) => record.outcome = outcome,
        }
        Ok(record)
    }

    fn measure(&self, row: &Row, done: Denoised, record: &mut Record) -> Result<(), HarnessError> {
        let (scene, spec) = (self.runner.scene, self.spec);
        record.peak_memory_bytes = machine::peak_memory();
        record.seconds.denoise = Some(done.seconds);
        record.seconds.denoise_runs = done.runs;
        record.seconds.around = done.around;
        record.seconds.stages = done.stages;
        let metric = |source| HarnessError::Metric { scene: scene.id.clone(), source };
        let Output { image: output, error_estimate, estimate_of, figures, bounds, log, .. } = done.output;
        record.non_finite.output_values = output.count_non_finite();
        // Where nothing was read there is nothing to measure, whatever was made up there: for no row.
        let mut image = output.clone();
        self.hygiene.mark_invalid(&mut image);
        let measured = match self.measurer.measure(&image) {
            // An output without a number in it is the method's failure, not the study's.
            Err(error @ MetricError::NoCommonPixel { .. }) => {
                record.outcome = Outcome::Failed { reason: error.to_string() };
                return Ok(());
            }
            measured => measured.map_err(metric)?,
        };
        record.take(measured);
        if scene.single() {
            record.metrics_within_se =
                block_bootstrap(self.measurer, &image, BOOTSTRAP_IMAGES, bootstrap_seed(record))
                    .map_err(metric)?;
        }
        // Of the same noisy input only: the ratio is to that.
        if scene.single() && row.method.id != crate::BASELINE && spec.kind == FrameKind::Uniform {
            record.ratio_within_se =
                ratio_within_se(&image, &self.frame.color.mean, self.reference).map_err(metric)?;
        }
        if let Some(estimate) = &error_estimate {
            let (of, mut about) =
                estimate_of.map_or_else(|| (None, image.clone()), |(name, image)| (Some(name), image));
            self.hygiene.mark_invalid(&mut about);
            let squared = self.measurer.squared_errors(&about).map_err(metric)?;
            let check = self.measure.estimate(estimate, &squared);
            record.error_estimate = check.map(|check| EstimateCheck { of, ..check });
        }
        let finite = figures.into_iter().filter(|figure| figure.value.is_finite());
        record.figures = finite.map(|figure| (figure.name, figure.value)).collect();
        let shape = |source| HarnessError::Shape { scene: scene.id.clone(), source };
        let measure = &self.measure;
        if row.method.id == crate::BASELINE {
            record.coverage = measure.coverage(&self.runner.request.study.coverage).map_err(shape)?;
        }
        // Nothing is claimed where samples were placed by what was seen.
        if record.adaptive.is_none() {
            let claims = &row.card.claims;
            record.bounds = measure.bounds(&output, &claims.error_bound).map_err(shape)?;
            record.bounds.extend(measure.own_bounds(&output, &bounds).map_err(shape)?);
            record.enclosures = measure.enclosures(&output, &claims.enclosure).map_err(shape)?;
        }

        let relative = Layout::image(&scene.id, &row.slug, spec.spp, spec.replicate);
        record.image = Some(self.write(relative, &image, record)?);
        if !log.is_empty() {
            let relative = Layout::log(&scene.id, &row.slug, spec.spp, spec.replicate);
            record.log = Some(self.keep(relative, record, |path| {
                noisefloor_io::write_atomically(path, |out| out.write_all(log.as_bytes()))
            })?);
        }
        let mut diagnostics = done.diagnostics;
        if matches!(spec.kind, FrameKind::Adaptive(_)) && wants_diagnostics(self.runner.request.study, spec) {
            let (name, unit) = ("samples per pixel".into(), Unit::None);
            diagnostics.push(Diagnostic { name, unit, image: sample_counts(self.frame) });
        }
        for Diagnostic { name, image: diagnostic, unit: _ } in &diagnostics {
            let name_of_file: String =
                name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
            let path = Layout::diagnostic(&scene.id, &row.slug, spec.spp, spec.replicate, &name_of_file);
            let path = self.write(path, diagnostic, record)?;
            record.diagnostics.insert(name.clone(), path);
        }
        Ok(())
    }

    /// Writes an image of a record; returns its path.
    fn write(&self, wanted: String, image: &Image, record: &mut Record) -> Result<String, HarnessError> {
        self.keep(wanted, record, |path| noisefloor_io::write_image(path, image, &BTreeMap::new()))
    }

    /// Writes a file of a record and keeps its hash; returns its path.
    fn keep(
        &self,
        wanted: String,
        record: &mut Record,
        write: impl FnOnce(&Path) -> Result<(), IoError>,
    ) -> Result<String, HarnessError> {
        let relative = self.runner.owners.path(wanted, &record.cell);
        let path = self.runner.layout.ready(&relative)?;
        write(path.as_ref())?;
        record.files.insert(relative.clone(), hash_of(&path)?);
        Ok(relative)
    }
}

/// How an adaptive frame was rendered.
fn adaptive(frame: &Frame) -> Option<AdaptiveRecord> {
    let extra = &frame.provenance.extra;
    let rounds = extra.get(crate::measure::ADAPTIVE)?.parse().ok()?;
    let counts = frame.samples.total();
    let most = match counts {
        Counts::Uniform(n) => *n,
        Counts::PerPixel(counts) => counts.iter().copied().max().unwrap_or(0),
    };
    let density_seconds = extra.get(crate::measure::DENSITY_SECONDS).and_then(|s| s.parse().ok());
    Some(AdaptiveRecord { rounds, mean_spp: counts.mean(), least: counts.least(), most, density_seconds })
}

/// Samples of every pixel, grey.
fn sample_counts(frame: &Frame) -> Image {
    Image::from_fn(frame.width(), frame.height(), 3, |_, x, y| frame.samples.at(y * frame.width() + x) as f32)
}
