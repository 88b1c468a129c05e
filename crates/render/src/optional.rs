//! Optional statistics of a rendering: how they are asked for, what a pixel keeps, and what a frame gets.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use noisefloor_frame::{
    BLOCK_SAMPLES, Block, Counts, Frame, FrameError, Gathered, Gathering, Image, Optional, Sampling,
    Statistic, Tapped, TappedSample,
};

use crate::columns::COLOR;
use crate::{RenderError, RenderRequest};

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

    /// Checks everything against the rest of the request.
    pub(crate) fn check(&self, request: &RenderRequest<'_>) -> Result<(), RenderError> {
        let wrong = |parameter, value: String, expected: String| {
            Err(RenderError::InvalidRequest { parameter, value, expected })
        };
        for (at, statistic) in self.statistics.iter().enumerate() {
            let row = statistic.row();
            if self.statistics[..at].contains(statistic) {
                return wrong("optional.statistics", format!("{statistic:?} twice"), "each once".into());
            }
            if request.spp < row.least {
                let expected = format!("at least {} for `{}`", row.least, row.id);
                return wrong("spp", request.spp.to_string(), expected);
            }
            if *statistic == Statistic::FourParts && request.sampling == Sampling::LowDiscrepancy {
                let expected = "independent, of which four parts are independent of each other".into();
                return wrong("sampling", request.sampling.name().into(), expected);
            }
        }
        let mut seen = std::collections::BTreeSet::new();
        for [x, y] in &self.tap {
            if *x >= request.width || *y >= request.height {
                let expected = format!("inside {}×{} pixels", request.width, request.height);
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

/// What is asked for, ready for pixels.
#[derive(Debug, Clone)]
pub struct OptionalPlan {
    gathering: Arc<Gathering>,
    /// Indices of the tapped pixels, row by row, sorted.
    tap: Vec<usize>,
}

impl OptionalPlan {
    /// Of a checked request; `None` where nothing is asked for.
    pub fn new(request: &RenderRequest<'_>) -> Option<Self> {
        let asked = &request.optional;
        if asked.is_empty() {
            return None;
        }
        let mut tap: Vec<usize> = asked.tap.iter().map(|[x, y]| y * request.width + x).collect();
        tap.sort_unstable();
        Some(Self { gathering: Arc::new(Gathering::new(asked.statistics.clone(), COLOR)), tap })
    }

    /// Images that a frame gets, of as many planes as the colour has.
    pub fn images(&self) -> usize {
        self.gathering.images()
    }

    /// What one pixel keeps.
    pub fn pixel(&self) -> OptionalTally {
        OptionalTally {
            gathered: (!self.gathering.statistics().is_empty()).then(|| Gathered::new(&self.gathering)),
            tapped: Vec::new(),
        }
    }

    /// Bytes that it takes, without tapped samples.
    pub fn bytes(&self) -> usize {
        size_of::<OptionalTally>() + self.gathering.bytes()
    }

    /// Whether all samples of a pixel are kept.
    pub fn taps(&self, pixel: usize) -> bool {
        self.tap.binary_search(&pixel).is_ok()
    }

    /// Whether something looks at the positions of this pixel's samples.
    pub fn looks_at_positions(&self, pixel: usize) -> bool {
        self.gathering.statistics().contains(&Statistic::Position) || self.taps(pixel)
    }
}

/// What one pixel keeps.
#[derive(Debug, Clone)]
pub struct OptionalTally {
    gathered: Option<Gathered>,
    tapped: Vec<TappedSample>,
}

impl OptionalTally {
    /// Forgets everything.
    pub fn clear(&mut self) {
        if let Some(gathered) = &mut self.gathered {
            gathered.clear();
        }
        self.tapped.clear();
    }

    /// Adds samples of one block; `tap`: whether to keep all of them too.
    pub fn extend(&mut self, block: &Block<'_>, tap: bool) {
        if let Some(gathered) = &mut self.gathered {
            gathered.extend(block);
        }
        if tap {
            let samples = block.values.chunks(block.stride).zip(block.positions);
            self.tapped.extend(samples.map(|(values, position)| {
                let color = std::array::from_fn(|c| values.get(c).copied().unwrap_or_default());
                TappedSample { color, position: *position }
            }));
        }
    }

    /// Adds the samples of a range that went on where this one ended.
    pub fn append(&mut self, next: &Self) {
        if let (Some(gathered), Some(next)) = (&mut self.gathered, &next.gathered) {
            gathered.append(next);
        }
        self.tapped.extend_from_slice(&next.tapped);
    }

    /// Writes the value of each plane.
    pub fn finish(&self, out: &mut [f64]) {
        if let Some(gathered) = &self.gathered {
            gathered.finish(out);
        }
    }

    /// The samples of a tapped pixel.
    pub fn tapped(&self) -> &[TappedSample] {
        &self.tapped
    }
}

/// The positions of a block's samples in their pixel.
pub type Positions = [[f32; 2]; BLOCK_SAMPLES as usize];

/// Samples of tapped pixels, from all threads.
#[derive(Debug, Default)]
pub struct Taps(Mutex<BTreeMap<usize, Vec<TappedSample>>>);

impl Taps {
    /// Keeps those of a pixel.
    pub fn put(&self, pixel: usize, samples: &[TappedSample]) {
        // A poisoned lock only means that another thread panicked; the samples are plain numbers.
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(pixel, samples.to_vec());
    }

    /// The tapped pixels, row by row, of an image of this width; `first`: index of their first sample.
    pub fn into_tapped(self, width: usize, first: u32) -> Vec<Tapped> {
        let taps = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        let tapped = taps.into_iter();
        tapped.map(|(at, samples)| Tapped { x: at % width, y: at / width, first, samples }).collect()
    }
}

/// Gives a frame its optional statistics; `images`: theirs, in order; `first`: index of every pixel's first sample;
/// `ends`: the index after the last one, one for all pixels or one for each.
pub fn put(
    wanted: &OptionalPlan,
    frame: &mut Frame,
    mut images: impl Iterator<Item = Vec<f32>>,
    first: u32,
    ends: &[u32],
    tapped: Vec<Tapped>,
) -> Result<(), FrameError> {
    let (width, height) = (frame.width(), frame.height());
    let mut image = || Image::from_vec(width, height, COLOR, images.next().unwrap_or_default());
    let mut recorded = Vec::new();
    for statistic in wanted.gathering.statistics() {
        let all = statistic.row().images.iter().map(|_| image()).collect::<Result<Vec<_>, _>>()?;
        recorded.push((*statistic, all));
    }
    let parts = wanted.gathering.statistics().contains(&Statistic::FourParts);
    let part_samples = parts.then(|| std::array::from_fn(|part| samples_of(part as u32, first, ends)));
    frame.optional = Optional::new(recorded, part_samples, tapped)?;
    frame.check()
}

/// Samples whose index leaves `part` when divided by 4.
fn samples_of(part: u32, first: u32, ends: &[u32]) -> Counts {
    let below = |end: u32| end / 4 + u32::from(end % 4 > part);
    let counts: Vec<u32> = ends.iter().map(|end| below(*end) - below(first)).collect();
    let counts = Counts::PerPixel(counts);
    counts.uniform().map_or(counts, Counts::Uniform)
}
