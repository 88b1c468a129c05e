//! What a choice of statistics has seen of one pixel.

use std::sync::Arc;

use super::rows::Run;
use super::statistic::Statistic;
use crate::running::{BLOCK_SAMPLES, BlockTree, Partial};

/// A choice of statistics, for so many channels.
#[derive(Debug, Default, PartialEq)]
pub struct Gathering {
    statistics: Vec<Statistic>,
    channels: usize,
    start: Vec<f64>,
}

/// Some samples of one pixel, at most [`BLOCK_SAMPLES`], of consecutive indices in one block: blocks end where the next
/// index is a multiple of their size.
#[derive(Debug, Clone, Copy)]
pub struct Block<'a> {
    /// Index of the first sample.
    pub first: u32,
    /// The channels of the first sample, then from `stride` on those of the second, and so on.
    pub values: &'a [f32],
    /// From sample to sample, at least the number of channels.
    pub stride: usize,
    /// Position of each sample in the pixel, right and down, in 0..1: as many as there are samples.
    pub positions: &'a [[f32; 2]],
}

impl Gathering {
    /// Of these statistics.
    #[must_use]
    pub fn new(statistics: Vec<Statistic>, channels: usize) -> Self {
        let channel = |statistic: &Statistic| std::iter::repeat_n(statistic.row().start, channels);
        let start = statistics.iter().flat_map(channel).flatten().copied().collect();
        Self { statistics, channels, start }
    }

    /// The statistics in their order.
    #[must_use]
    pub fn statistics(&self) -> &[Statistic] {
        &self.statistics
    }

    /// Images that a frame has of them, each of as many planes as there are channels.
    #[must_use]
    pub fn images(&self) -> usize {
        self.statistics.iter().map(|statistic| statistic.row().images.len()).sum()
    }

    /// Bytes that one pixel takes on the heap, for up to 256 samples.
    #[must_use]
    pub fn bytes(&self) -> usize {
        // A leaf, and subtrees of 1, 2, 4 and 8 blocks.
        size_of::<Gathered>() + 5 * (size_of::<Seen>() + self.start.len() * size_of::<f64>())
    }
}

/// What some samples come to.
#[derive(Debug, Clone, Default, PartialEq)]
struct Seen {
    of: Arc<Gathering>,
    count: u64,
    /// Of each statistic, of each channel, what its row keeps.
    kept: Vec<f64>,
}

impl Seen {
    fn new(of: &Arc<Gathering>) -> Self {
        Self { of: Arc::clone(of), count: 0, kept: of.start.clone() }
    }

    fn clear(&mut self) {
        self.count = 0;
        self.kept.copy_from_slice(&self.of.start);
    }
}

impl Partial for Seen {
    fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            self.clone_from(other);
            return;
        }
        let counts = [self.count as f64, other.count as f64];
        let mut at = 0;
        for statistic in &self.of.statistics {
            let row = statistic.row();
            for _ in 0..self.of.channels {
                let range = at..at + row.start.len();
                (row.merge)(&mut self.kept[range.clone()], &other.kept[range.clone()], counts);
                at = range.end;
            }
        }
        self.count += other.count;
    }
}

/// What a choice of statistics has seen of one pixel, in the fixed tree of sample blocks: like the mean and the variance
/// of the colour, a pixel has the same bits however its samples were split into ranges of whole aligned blocks, and the
/// same numbers to the rounding of `f64` however they were split otherwise.
#[derive(Debug, Clone)]
pub struct Gathered {
    leaf: Seen,
    tree: BlockTree<Seen>,
    /// Appended ranges that do not fit into the tree.
    loose: Option<Box<Seen>>,
}

impl Gathered {
    /// Nothing seen yet.
    #[must_use]
    pub fn new(of: &Arc<Gathering>) -> Self {
        Self { leaf: Seen::new(of), tree: BlockTree::default(), loose: None }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.leaf.clear();
        self.tree.clear();
        self.loose = None;
    }

    /// Adds samples. Those beyond [`BLOCK_SAMPLES`], or without a value or a position, are not looked at.
    pub fn extend(&mut self, block: &Block<'_>) {
        let Seen { of, count, kept } = &mut self.leaf;
        let mut values = [0.0; BLOCK_SAMPLES as usize];
        let samples = block.positions.len().min(values.len());
        let channels = of.channels;
        for channel in 0..channels {
            for (value, sample) in values.iter_mut().zip(block.values.chunks(block.stride.max(1))) {
                *value = f64::from(sample.get(channel).copied().unwrap_or_default());
            }
            let positions = &block.positions[..samples];
            let run = Run { before: *count, first: block.first, values: &values[..samples], positions };
            let mut at = 0;
            for statistic in &of.statistics {
                let row = statistic.row();
                let length = row.start.len();
                (row.add)(*statistic, &mut kept[at + channel * length..][..length], &run);
                at += channels * length;
            }
        }
        *count += samples as u64;
        if (block.first % BLOCK_SAMPLES) as usize + samples == values.len() {
            let next = Seen::new(&self.leaf.of);
            self.tree.push(std::mem::replace(&mut self.leaf, next));
        }
    }

    /// Adds the samples of a range that went on where this one ended.
    pub fn append(&mut self, next: &Self) {
        if self.leaf.count == 0 && self.loose.is_none() && self.tree.append(&next.tree) {
            self.leaf = next.leaf.clone();
            self.loose.clone_from(&next.loose);
        } else {
            self.loose.get_or_insert_default().merge(&next.total());
        }
    }

    /// Writes the value of each plane of each image, in the order of the statistics and of their images.
    pub fn finish(&self, out: &mut [f64]) {
        let total = self.total();
        let (mut values, mut at, mut first) = ([0.0; 8], 0, 0);
        let channels = total.of.channels;
        for statistic in &total.of.statistics {
            let row = statistic.row();
            let (length, images) = (row.start.len(), row.images.len());
            for channel in 0..channels {
                let kept = &total.kept[at + channel * length..][..length];
                (row.finish)(kept, total.count as f64, &mut values[..images]);
                for (image, value) in values[..images].iter().enumerate() {
                    if let Some(out) = out.get_mut(first + image * channels + channel) {
                        *out = *value;
                    }
                }
            }
            at += channels * length;
            first += channels * images;
        }
    }

    fn total(&self) -> Seen {
        let mut total = self.tree.total_with(self.leaf.clone());
        if let Some(loose) = &self.loose {
            total.merge(loose);
        }
        total
    }
}
