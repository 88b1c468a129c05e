//! One row on a frame: denoised, measured, kept.

use std::collections::BTreeMap;
use std::path::Path;

use noisefloor_denoiser::{Diagnostic, Input, Unit};
use noisefloor_frame::{Counts, Finding, Frame, Hygiene, Image, Reference, RoundsTaken};
use noisefloor_io::IoError;
use noisefloor_metrics::{Measurer, MetricError};
use noisefloor_questions::{self as questions, Cell, Measure, MeasureError};
use noisefloor_study::files;
use noisefloor_study::record::{AdaptiveRecord, NonFinite, Outcome, Record};

use crate::error::HarnessError;
use crate::machine;
use crate::observer::Stage;
use crate::plan::{CellPlan, wants_diagnostics};
use crate::row::Row;
use crate::run::denoise::{Denoised, denoise};
use crate::run::runner::Runner;
use crate::source::{FrameKind, FrameSpec};
use crate::store::hash_of;

/// One frame against its truth.
pub(super) struct OnFrame<'a> {
    pub(super) runner: &'a Runner<'a>,
    pub(super) measurer: &'a Measurer<'a>,
    pub(super) measure: Measure<'a>,
    pub(super) reference: &'a Reference,
    pub(super) spec: &'a FrameSpec,
    pub(super) frame: &'a Frame,
    /// What was mended in it.
    pub(super) hygiene: &'a Hygiene,
    /// What was found about it, with its name.
    pub(super) findings: Vec<Finding>,
    /// Neighbouring frames of its sequence, by their distance.
    pub(super) beside: BTreeMap<i64, Frame>,
}

impl OnFrame<'_> {
    pub(super) fn run(&self, cell: &CellPlan, non_finite: NonFinite) -> Result<Record, HarnessError> {
        let (study, scene, spec) = (self.runner.request.study, self.runner.scene(), self.spec);
        let row = self.runner.plan.row(cell);
        self.runner.request.observer.stage(&Stage::Denoise {
            scene: scene.id.clone(),
            spp: spec.spp,
            replicate: spec.replicate,
            label: row.label.clone(),
        });
        let mut record = self.runner.blank(cell, self.frame.sampling);
        record.photon_maps = self.frame.provenance.maps();
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
        let (scene, spec) = (self.runner.scene(), self.spec);
        record.peak_memory_bytes = machine::peak_memory();
        record.seconds.denoise = Some(done.seconds);
        record.seconds.denoise_runs = done.runs;
        record.seconds.around = done.around;
        record.seconds.stages = done.stages;
        let output = &done.output;
        record.non_finite.output_values = output.image.count_non_finite();
        // Where nothing was read there is nothing to measure, whatever was made up there: for no row.
        let mut image = output.image.clone();
        self.hygiene.mark_invalid(&mut image);
        let finite = output.figures.iter().filter(|figure| figure.value.is_finite());
        let figures = finite.map(|figure| (figure.name.clone(), figure.value)).collect();
        let asked = questions::measure(
            self.runner.request.laboratory.questions,
            &Cell {
                study: self.runner.request.study,
                method: &row.method.id,
                card: &row.card,
                frame: self.frame,
                hygiene: self.hygiene,
                shared_frame: spec.kind == FrameKind::Uniform,
                single: scene.single(),
                output,
                image: &image,
                reference: self.reference,
                measurer: self.measurer,
                measure: &self.measure,
            },
            record,
        );
        match asked {
            Ok(()) => {}
            // An output without a number in it is the method's failure, not the study's.
            Err(MeasureError::Metric(error @ MetricError::NoCommonPixel { .. })) => {
                record.outcome = Outcome::Failed { reason: error.to_string() };
                return Ok(());
            }
            Err(MeasureError::Metric(source)) => {
                return Err(HarnessError::Metric { scene: scene.id.clone(), source });
            }
            Err(MeasureError::Shape(source)) => {
                return Err(HarnessError::Shape { scene: scene.id.clone(), source });
            }
        }
        record.figures = figures;

        let relative = files::image(&scene.id, &row.slug, spec.spp, spec.replicate);
        record.image = Some(self.write(relative, &image, record)?);
        if !output.log.is_empty() {
            let relative = files::log(&scene.id, &row.slug, spec.spp, spec.replicate);
            record.log = Some(self.keep(relative, record, |path| {
                noisefloor_io::write_atomically(path, |out| out.write_all(output.log.as_bytes()))
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
            let path = files::diagnostic(&scene.id, &row.slug, spec.spp, spec.replicate, &name_of_file);
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
    let RoundsTaken { count: rounds, density_seconds } = frame.provenance.rounds?;
    let counts = frame.samples.total();
    let most = match counts {
        Counts::Uniform(n) => *n,
        Counts::PerPixel(counts) => counts.iter().copied().max().unwrap_or(0),
    };
    Some(AdaptiveRecord { rounds, mean_spp: counts.mean(), least: counts.least(), most, density_seconds })
}

/// Samples of every pixel, grey.
fn sample_counts(frame: &Frame) -> Image {
    Image::from_fn(frame.width(), frame.height(), 3, |_, x, y| frame.samples.at(y * frame.width() + x) as f32)
}
