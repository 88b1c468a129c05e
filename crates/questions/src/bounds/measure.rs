//! How often an output leaves the bounds that its method claims or states, and the certain half of these claims.

use noisefloor_denoiser::{Bound, Claim};
use noisefloor_frame::Image;
use noisefloor_stats::{self as stats, BoundTally, Groups, Level, Observed, ShapeError};
use noisefloor_study::record::{BoundCount, EnclosureCheck, Record};

use crate::cell::{Cell, Measure, MeasureError};

/// Nothing is claimed where samples were placed by what was seen.
pub(super) fn measure(cell: &Cell<'_>, record: &mut Record) -> Result<(), MeasureError> {
    if cell.frame.provenance.rounds.is_some() {
        return Ok(());
    }
    let (claims, image) = (&cell.card.claims, &cell.output.image);
    record.bounds = cell.measure.bounds(image, &claims.error_bound)?;
    record.bounds.extend(cell.measure.own_bounds(image, &cell.output.bounds)?);
    record.enclosures = cell.measure.enclosures(image, &claims.enclosure)?;
    Ok(())
}

impl Measure<'_> {
    /// How often an output leaves each claimed bound, per class; empty where intervals are void or unknown.
    ///
    /// # Errors
    /// If output, frame and truth differ in size.
    pub fn bounds(&self, image: &Image, claims: &[Claim]) -> Result<Vec<BoundCount>, ShapeError> {
        let Some(observed) = self.intervals() else { return Ok(Vec::new()) };
        let mut out = Vec::new();
        for claim in claims {
            let Some(widths) = self.half_widths(&observed, &claim.terms)? else { continue };
            out.extend(self.leaves(image, &observed, &widths, (&claim.name, claim.level, claim.proven))?);
        }
        Ok(out)
    }

    /// How often an output leaves each bound that the method stated for it; whoever states one answers for the sampling.
    ///
    /// # Errors
    /// If output, frame and truth differ in size.
    pub fn own_bounds(&self, image: &Image, stated: &[Bound]) -> Result<Vec<BoundCount>, ShapeError> {
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
    ///
    /// # Errors
    /// If output, frame and truth differ in size.
    pub fn enclosures(&self, image: &Image, claims: &[Claim]) -> Result<Vec<EnclosureCheck>, ShapeError> {
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
