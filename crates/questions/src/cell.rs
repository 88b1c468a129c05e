//! What questions measure: a finished cell beside its truth.

mod blocks;
mod classes;

use noisefloor_denoiser::{MethodCard, Output};
use noisefloor_frame::{Counts, Frame, Hygiene, Image, Maps, Reference, Sampling, Variance};
use noisefloor_metrics::{Measurer, MetricError};
use noisefloor_stats::{
    self as stats, Groups, IntervalFamily, IntervalPlanes, Level, Observed, SamplePlanes, ShapeError, Truth,
    students_t,
};
use noisefloor_study::Study;

pub(crate) use blocks::{Blocks, within_se};
pub use classes::{PixelClasses, UnknownClass};

/// The class that stands for all pixels.
pub(crate) const ALL: &str = "all";

/// A method's output on a noisy frame, beside the truth.
#[derive(Debug, Clone, Copy)]
pub struct Cell<'a> {
    /// The study that asks.
    pub study: &'a Study,
    /// Id of the method.
    pub method: &'a str,
    /// What the method claims.
    pub card: &'a MethodCard,
    /// The noisy frame, mended.
    pub frame: &'a Frame,
    /// What was mended in it.
    pub hygiene: &'a Hygiene,
    /// Whether it is the study's own frame of its level, shared by all such rows.
    pub shared_frame: bool,
    /// Whether no level of the scene has a second replicate, so that uncertainty can only come from within the image.
    pub single: bool,
    /// What the method gave.
    pub output: &'a Output,
    /// Its image, with the pixels marked that were not finite on input.
    pub image: &'a Image,
    /// The truth.
    pub reference: &'a Reference,
    /// Metrics against it.
    pub measurer: &'a Measurer<'a>,
    /// Intervals and bounds against it.
    pub measure: &'a Measure<'a>,
}

/// Why a cell could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// A metric does not apply.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// Buffers do not fit together.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

/// A noisy frame, its truth, and what to tell apart.
#[derive(Debug)]
pub struct Measure<'a> {
    frame: &'a Frame,
    pub(crate) truth: Truth<'a>,
    pub(crate) classes: &'a PixelClasses,
    /// Pixels that were finite on input; the others have no statistics.
    valid: Vec<bool>,
    /// The intervals that are judged, and that bounds are made of.
    intervals: &'a dyn IntervalFamily,
    /// Blocks of the image, if its uncertainty has to come from within.
    pub(crate) blocks: Option<Blocks>,
}

/// Why t-intervals of a frame say nothing, if so.
#[must_use]
pub fn void(sampling: Sampling) -> Option<&'static str> {
    match sampling {
        Sampling::Independent => None,
        Sampling::LowDiscrepancy => Some(
            "low-discrepancy samples: s²/n is not the variance of the mean, so intervals and bounds are void",
        ),
    }
}

impl<'a> Measure<'a> {
    /// `invalid` flags the pixels that were not finite on input (empty: none); `within` asks for standard errors within
    /// this one image.
    #[must_use]
    pub fn new(
        frame: &'a Frame,
        reference: &'a Reference,
        classes: &'a PixelClasses,
        invalid: &[bool],
        within: bool,
    ) -> Self {
        let variance = reference.frame.color.variance.as_ref().map(|v| v.mean_variance().data());
        Self {
            frame,
            truth: Truth { mean: reference.mean().data(), variance },
            classes,
            valid: (0..frame.pixels()).map(|p| !invalid.get(p).is_some_and(|bad| *bad)).collect(),
            intervals: students_t(),
            blocks: within.then(|| Blocks::new(frame.width(), frame.height())),
        }
    }

    /// With other intervals than Student's t.
    #[must_use]
    pub fn with_intervals(self, intervals: &'a dyn IntervalFamily) -> Self {
        Self { intervals, ..self }
    }

    /// The input's statistics, if it has any.
    pub(crate) fn observed(&self) -> Option<Observed<'_>> {
        let variance = self.frame.color.variance.as_ref().map(Variance::mean_variance)?;
        Some(Observed {
            mean: self.frame.color.mean.data(),
            variance: variance.data(),
            counts: match self.frame.samples.total() {
                Counts::Uniform(n) => stats::SampleCounts::Uniform(*n),
                Counts::PerPixel(map) => stats::SampleCounts::PerPixel(map),
            },
            pixels: self.frame.pixels(),
            valid: Some(&self.valid),
        })
    }

    /// The same, if t-intervals mean anything: sample counts that differ between pixels depend on the data, and void
    /// them, and so do photon maps that the truth does not share.
    pub(crate) fn intervals(&self) -> Option<Observed<'_>> {
        let sound = void(self.frame.sampling).is_none()
            && self.frame.provenance.maps() != Some(Maps::Fresh)
            && self.frame.provenance.rounds.is_none()
            && self.frame.samples.total().uniform().is_some_and(|n| n >= 2);
        self.observed().filter(|_| sound)
    }

    /// Everything of the frame that intervals can be made of.
    pub(crate) fn planes<'b>(&'b self, observed: Observed<'b>) -> SamplePlanes<'b> {
        let optional = &self.frame.optional;
        SamplePlanes {
            observed,
            width: self.frame.width(),
            third_moment: optional.third_moment().map(Image::data),
            least: optional.least().map(Image::data),
            greatest: optional.greatest().map(Image::data),
        }
    }

    /// Intervals of all pixels at a level; `None` where the frame lacks something that they need.
    pub(crate) fn intervals_at(
        &self,
        observed: &Observed<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError> {
        self.intervals.intervals(&self.planes(*observed), level)
    }

    /// Half-widths of a bound in terms of them: those of Student's t to the last digit.
    pub(crate) fn half_widths(
        &self,
        observed: &Observed<'_>,
        terms: &[(f64, Level)],
    ) -> Result<Option<Vec<f64>>, ShapeError> {
        if self.intervals.id() == students_t().id() {
            return stats::half_widths(observed, terms).map(Some);
        }
        let mut out = vec![0.0; observed.mean.len()];
        for &(factor, level) in terms {
            let Some(planes) = self.intervals_at(observed, level)? else { return Ok(None) };
            let widths = planes.low.iter().zip(&planes.high).map(|(low, high)| 0.5 * (high - low));
            out.iter_mut().zip(widths).for_each(|(sum, width)| *sum += factor * width);
        }
        Ok(Some(out))
    }

    pub(crate) fn groups(&self) -> Groups<'_> {
        Groups { of_pixel: &self.classes.of_pixel, count: self.classes.names.len() }
    }

    /// `all` and the names of the classes, as tallies come out.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(ALL).chain(self.classes.names.iter().map(String::as_str))
    }

    /// Standard error within this image of a rate in class `index` (0: all), from tallies per block.
    pub(crate) fn within<T>(
        &self,
        index: usize,
        count: impl Fn(&Observed<'_>, Groups<'_>) -> Result<Vec<T>, ShapeError>,
        hits_and_total: impl Fn(&T) -> (u64, u64),
    ) -> Option<f64> {
        let blocks = self.blocks.as_ref()?;
        let inside = |p: usize| index == 0 || usize::from(self.classes.of_pixel[p]) + 1 == index;
        let valid: Vec<bool> = self.valid.iter().enumerate().map(|(p, ok)| *ok && inside(p)).collect();
        let observed = Observed { valid: Some(&valid), ..self.observed()? };
        within_se(&blocks.tallies(|groups| count(&observed, groups))?, hits_and_total)
    }
}
