//! Whether the buffers of a frame or a reference can belong together, and what is wrong with them.

mod average;
mod fidelity;
mod precision;
mod reference;
mod spread;
#[cfg(test)]
mod tests;

use crate::{Counts, Estimate, FeatureId, Flash, Frame, FrameError, Hygiene, Sampling};
use average::{Film, Halves};
pub use fidelity::Fidelity;
pub(crate) use precision::Precision;

impl Frame {
    /// The one place where a frame that came from outside is checked before numbers are made from it: refuses buffers
    /// that contradict each other, mends what [`Frame::sanitize`] mends, and tells everything found as
    /// [`Hygiene::findings`]. A method may look at a frame that has passed.
    ///
    /// * The halves of colour, features and flash must average to their mean, (n_A·A + n_B·B)/n = mean, to the
    ///   precision that the buffers show (half floats, rounded mantissas) or [`Fidelity::Lossy`] leaves. With
    ///   weighted pixel filters the shares are not n_A/n and n_B/n; what holds then is that the mean lies between the
    ///   halves, with shares that differ from pixel to pixel without a trend. That suffices where the film's filter
    ///   is not known to be unweighted. Visibility, a quotient of two counts, must lie between its halves. Ids and normalised vectors are no averages and are not compared.
    /// * For independent samples the stated variance must agree with the halves: a finding, if not.
    /// * Zero variance where the halves differ is a finding. Neither is looked for in features of weighted samples.
    ///
    /// # Errors
    /// [`FrameError::Contradiction`] for halves that do not average to their mean, [`FrameError::NoValidPixel`] if no
    /// pixel has a colour, and those of [`Frame::check`].
    pub fn inspect(&mut self, fidelity: Fidelity) -> Result<Hygiene, FrameError> {
        self.check()?;
        let mut found = Vec::new();
        // Samples that were placed by what was seen are no longer exchangeable between the halves.
        let even = matches!(self.samples.total(), Counts::Uniform(_));
        for (name, estimate) in self.estimates() {
            let film = match name {
                "color" if self.provenance.filter.is_some() => Film::Unweighted,
                "color" => Film::Unknown,
                // Rays that reached a light over rays traced.
                "visibility" => Film::Quotient,
                _ => Film::OfFeature,
            };
            let halves = average::check(name, estimate, &self.samples, film, fidelity)?;
            // Where samples that hit nothing do not count, nobody knows how many of a pixel's made up its variance.
            if matches!(film, Film::OfFeature | Film::Quotient) && halves == Halves::Weighted {
                continue;
            }
            let subject = if name == "color" { String::new() } else { name.to_owned() };
            found.extend(spread::zero(&subject, estimate, &self.samples, fidelity));
            if self.sampling == Sampling::Independent && fidelity == Fidelity::Rounded {
                let exact = even && halves == Halves::Exact;
                found.extend(spread::against_halves(&subject, estimate, &self.samples, exact));
            }
        }
        let mut hygiene = self.sanitize()?;
        found.append(&mut hygiene.findings);
        hygiene.findings = crate::sorted_findings(found);
        Ok(hygiene)
    }

    /// All estimates whose halves are averages, with the names of their layers.
    fn estimates(&self) -> impl Iterator<Item = (&str, &Estimate)> {
        let features = self.features.iter().filter(|(id, _)| **id != FeatureId::Material);
        let flash: Vec<(&str, &Estimate)> = match &self.flash {
            Some(Flash::Parts { base, light, .. }) => vec![("flashBase", base), ("flashLight", light)],
            Some(Flash::Ready(flash)) => vec![("flash", flash)],
            None => Vec::new(),
        };
        std::iter::once(("color", &self.color))
            .chain(features.map(|(id, estimate)| (id.name(), estimate)))
            .chain(flash)
    }
}
