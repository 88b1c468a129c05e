//! What a pixel keeps of optional statistics.

use std::sync::Arc;

use noisefloor_frame::{BLOCK_SAMPLES, Block, Gathered, Gathering, TappedSample};

/// What one pixel keeps.
#[derive(Debug, Clone)]
pub struct OptionalTally {
    gathered: Option<Gathered>,
    tapped: Vec<TappedSample>,
}

impl OptionalTally {
    /// Nothing yet of what is gathered.
    pub fn new(gathering: &Arc<Gathering>) -> Self {
        let gathered = (!gathering.statistics().is_empty()).then(|| Gathered::new(gathering));
        Self { gathered, tapped: Vec::new() }
    }

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
