//! How optional statistics are asked for.

use std::collections::BTreeSet;

use noisefloor_frame::{Sampling, Statistic, TappedSample};

use crate::RenderError;

/// Optional statistics of the colour to record; nothing by default, which costs nothing. They change no sample.
///
/// A statistic takes about 10 to 100 ns per sample, most where it needs logarithms. Frames made of rounds or of appended
/// ranges have the statistics of one run: bit for bit where means and variances do (see [`crate::Rounds::append`]), else
/// to the rounding of `f64`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OptionalRecord {
    /// Statistics, each once. Every pixel needs as many samples as [`noisefloor_frame::Row::least`] says, in the first
    /// round if there are several. [`Statistic::FourParts`] is for independent samples alone: with low-discrepancy
    /// sampling, parts 0 and 2 would be of one sequence, and not independent of each other.
    pub statistics: Vec<Statistic>,
    /// Pixels of which all samples are kept, as column and row, each once.
    pub tap: Vec<[usize; 2]>,
}

impl OptionalRecord {
    /// Whether nothing is asked for.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.statistics.is_empty() && self.tap.is_empty()
    }

    /// Checks everything against the rest of a request: image size in pixels, samples and their kind.
    pub(crate) fn check(
        &self,
        (width, height): (usize, usize),
        spp: u32,
        sampling: Sampling,
    ) -> Result<(), RenderError> {
        let wrong = |parameter, value: String, expected: String| {
            Err(RenderError::InvalidRequest { parameter, value, expected })
        };
        for (at, statistic) in self.statistics.iter().enumerate() {
            let row = statistic.row();
            if self.statistics[..at].contains(statistic) {
                return wrong("optional.statistics", format!("{statistic:?} twice"), "each once".into());
            }
            if spp < row.least {
                let expected = format!("at least {} for `{}`", row.least, row.id);
                return wrong("spp", spp.to_string(), expected);
            }
            if *statistic == Statistic::FourParts && sampling == Sampling::LowDiscrepancy {
                let expected = "independent, of which four parts are independent of each other".into();
                return wrong("sampling", sampling.name().into(), expected);
            }
        }
        let mut seen = BTreeSet::new();
        for [x, y] in &self.tap {
            if *x >= width || *y >= height {
                let expected = format!("inside {width}×{height} pixels");
                return wrong("optional.tap", format!("({x}, {y})"), expected);
            }
            if !seen.insert((x, y)) {
                return wrong("optional.tap", format!("({x}, {y}) twice"), "each once".into());
            }
        }
        Ok(())
    }

    /// Bytes that tapped samples take.
    pub(crate) fn tap_bytes(&self, spp: u32) -> u64 {
        self.tap.len() as u64 * u64::from(spp) * size_of::<TappedSample>() as u64
    }
}
