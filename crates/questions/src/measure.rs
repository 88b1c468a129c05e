//! What is counted against the truth beside the metrics: coverage of intervals, violations of bounds, enclosures.

mod blocks;
mod estimate;
mod ratio;

use noisefloor_denoiser::{Bound, Claim};
use noisefloor_frame::{Counts, Frame, Image, Reference, Sampling, Variance};
use noisefloor_render::Integrator;
use noisefloor_stats::{
    self as stats, BoundTally, CoverageTally, Groups, Level, Observed, ShapeError, Truth,
};

use crate::Maps;
use crate::record::{BoundCount, CoverageCount, EnclosureCheck};
use crate::source::PixelClasses;
use blocks::{Blocks, within_se};
pub(crate) use ratio::ratio_within_se;

/// The class that stands for all pixels.
pub(crate) const ALL: &str = "all";

/// A noisy frame, its truth, and what to tell apart.
pub(crate) struct Measure<'a> {
    frame: &'a Frame,
    truth: Truth<'a>,
    classes: &'a PixelClasses,
    /// Pixels that were finite on input; the others have no statistics.
    valid: Vec<bool>,
    /// Blocks of the image, if its uncertainty has to come from within.
    blocks: Option<Blocks>,
}

/// Why t-intervals of a frame say nothing, if so.
pub(crate) fn void(sampling: Sampling) -> Option<&'static str> {
    match sampling {
        Sampling::Independent => None,
        Sampling::LowDiscrepancy => Some(
            "low-discrepancy samples: s²/n is not the variance of the mean, so intervals and bounds are void",
        ),
    }
}

/// Key in a frame's provenance: which photon maps it was rendered with.
pub(crate) const PHOTON_MAPS: &str = "photon_maps";

/// Key in a frame's provenance: in how many rounds it was rendered, if samples were placed by what was seen.
pub(crate) const ADAPTIVE: &str = "adaptive_rounds";
/// Key in a frame's provenance: seconds that the decisions took where to place samples.
pub(crate) const DENSITY_SECONDS: &str = "density_seconds";

/// Which photon maps carried the light of a frame, if any did. A photon-mapped frame that does not say it, because it
/// was rendered alone and imported, counts as one whose maps the truth does not share.
pub(crate) fn photon_maps(frame: &Frame) -> Option<Maps> {
    let told = frame.provenance.extra.get(PHOTON_MAPS);
    if let Some(maps) =
        [Maps::Fixed, Maps::Fresh].into_iter().find(|maps| told.is_some_and(|t| t == maps.name()))
    {
        return Some(maps);
    }
    let integrator = frame.provenance.integrator.as_deref().unwrap_or_default();
    integrator.starts_with(Integrator::PhotonMapping.name()).then_some(Maps::Fresh)
}

impl<'a> Measure<'a> {
    /// `invalid` flags the pixels that were not finite on input (empty: none); `within` asks for standard errors within
    /// this one image.
    pub(crate) fn new(
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
            blocks: within.then(|| Blocks::new(frame.width(), frame.height())),
        }
    }

    /// The input's statistics, if it has any.
    fn observed(&self) -> Option<Observed<'_>> {
        let variance = self.frame.color.variance.as_ref().map(Variance::mean_variance)?;
        Some(Observed {
            mean: self.frame.color.mean.data(),
            variance: variance.data(),
            counts: match self.frame.samples.total() {
                Counts::Uniform(n) => stats::Counts::Uniform(*n),
                Counts::PerPixel(map) => stats::Counts::PerPixel(map),
            },
            pixels: self.frame.pixels(),
            valid: Some(&self.valid),
        })
    }

    /// The same, if t-intervals mean anything: sample counts that differ between pixels depend on the data, and void
    /// them, and so do photon maps that the truth does not share.
    fn intervals(&self) -> Option<Observed<'_>> {
        let sound = void(self.frame.sampling).is_none()
            && photon_maps(self.frame) != Some(Maps::Fresh)
            && !self.frame.provenance.extra.contains_key(ADAPTIVE)
            && self.frame.samples.total().uniform().is_some_and(|n| n >= 2);
        self.observed().filter(|_| sound)
    }

    fn groups(&self) -> Groups<'_> {
        Groups { of_pixel: &self.classes.of_pixel, count: self.classes.names.len() }
    }

    /// `all` and the names of the classes, as tallies come out.
    fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(ALL).chain(self.classes.names.iter().map(String::as_str))
    }

    /// Standard error within this image of a rate in class `index` (0: all), from tallies per block.
    fn within<T>(
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

    /// Coverage of the t-intervals of the input mean, per level and class; empty where intervals are void or unknown.
    pub(crate) fn coverage(&self, confidences: &[f64]) -> Result<Vec<CoverageCount>, ShapeError> {
        let Some(observed) = self.intervals() else { return Ok(Vec::new()) };
        let mut out = Vec::new();
        // Confidences were checked with the study.
        for level in confidences.iter().filter_map(|&c| Level::two_sided(c).ok()) {
            let tallies = stats::coverage(&observed, &self.truth, level, Some(self.groups()))?;
            for (index, (class, tally)) in
                self.names().zip(tallies).enumerate().filter(|(_, (_, t))| t.all() > 0)
            {
                out.push(CoverageCount {
                    confidence: level.confidence(),
                    class: class.to_owned(),
                    total: tally.total,
                    covered: tally.covered,
                    covered_uncorrected: tally.covered_uncorrected,
                    constant: tally.constant,
                    missed: tally.missed,
                    within_se: self.within(
                        index,
                        |observed, groups| stats::coverage(observed, &self.truth, level, Some(groups)),
                        |t: &CoverageTally| (t.covered + t.constant, t.all()),
                    ),
                });
            }
        }
        Ok(out)
    }

    /// How often an output leaves each claimed bound, per class; empty where intervals are void or unknown.
    pub(crate) fn bounds(&self, image: &Image, claims: &[Claim]) -> Result<Vec<BoundCount>, ShapeError> {
        let Some(observed) = self.intervals() else { return Ok(Vec::new()) };
        let mut out = Vec::new();
        for claim in claims {
            let widths = stats::half_widths(&observed, &claim.terms)?;
            out.extend(self.leaves(image, &observed, &widths, (&claim.name, claim.level, claim.proven))?);
        }
        Ok(out)
    }

    /// How often an output leaves each bound that the method stated for it; whoever states one answers for the sampling.
    pub(crate) fn own_bounds(&self, image: &Image, stated: &[Bound]) -> Result<Vec<BoundCount>, ShapeError> {
        let Some(observed) = self.observed() else { return Ok(Vec::new()) };
        let mut out = Vec::new();
        for bound in stated {
            let widths: Vec<f64> = bound.half_width.data().iter().copied().map(f64::from).collect();
            out.extend(self.leaves(image, &observed, &widths, (&bound.name, bound.level, false))?);
        }
        Ok(out)
    }

    /// How often an output leaves one bound of these half-widths, per class.
    fn leaves(
        &self,
        image: &Image,
        observed: &Observed<'_>,
        widths: &[f64],
        (name, level, proven): (&str, Level, bool),
    ) -> Result<Vec<BoundCount>, ShapeError> {
        let count = |observed: &Observed<'_>, groups: Groups<'_>| {
            stats::bound_violations(image.data(), widths, observed, &self.truth, level, Some(groups))
        };
        let tallies = count(observed, self.groups())?;
        let present = self.names().zip(tallies).enumerate().filter(|(_, (_, tally))| tally.total > 0);
        Ok(present
            .map(|(index, (class, tally))| BoundCount {
                claim: name.to_owned(),
                proven,
                alpha: level.alpha(),
                class: class.to_owned(),
                total: tally.total,
                violations: tally.violations,
                violations_uncorrected: tally.violations_uncorrected,
                violations_missed: tally.violations_missed,
                mean_ratio: tally.mean_ratio(),
                within_se: self.within(index, count, |t: &BoundTally| (t.violations, t.total)),
            })
            .collect())
    }

    /// The certain half of each claim. Holds for any sampling, because it compares the output with its own input.
    pub(crate) fn enclosures(
        &self,
        image: &Image,
        claims: &[Claim],
    ) -> Result<Vec<EnclosureCheck>, ShapeError> {
        let Some(observed) = self.observed() else { return Ok(Vec::new()) };
        let everywhere = Observed { valid: None, ..observed };
        let check = |claim: &Claim| {
            let widths = stats::half_widths(&everywhere, &claim.terms)?;
            let found = stats::enclosure(image.data(), &widths, &everywhere)?;
            Ok(EnclosureCheck {
                claim: claim.name.to_string(),
                worst_ratio: found.worst_ratio,
                held: found.held,
            })
        };
        claims.iter().map(check).collect()
    }
}
