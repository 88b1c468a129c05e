//! Optional statistics ready for pixels, and what a frame gets of them.

use std::sync::Arc;

use noisefloor_frame::{Counts, FourParts, Frame, FrameError, Gathering, Image, Optional, Statistic, Tapped};

use super::tally::OptionalTally;
use crate::RenderRequest;
use crate::columns::COLOR;

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
        OptionalTally::new(&self.gathering)
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
    let part_samples = parts.then(|| {
        let total: Vec<u32> = ends.iter().map(|end| end - first).collect();
        let total = Counts::PerPixel(total);
        FourParts::dealt(first, &total.uniform().map_or(total, Counts::Uniform))
    });
    frame.optional = Optional::new(recorded, part_samples, tapped)?;
    frame.check()
}
