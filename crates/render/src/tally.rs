//! Statistics of one pixel.

use noisefloor_frame::{BLOCK_SAMPLES, BlockTree, Moments};

use crate::optional::OptionalTally;

/// Values that are accumulated side by side.
pub const LANES: usize = 4;

/// Moments of the values of a sample in the fixed tree of sample blocks, means of the even and of the odd samples, and
/// what is kept of the first sample alone.
#[derive(Debug, Clone)]
pub struct Tally {
    groups: Vec<Group>,
    counts: [u32; 2],
    first: Box<[f32]>,
    /// Optional statistics, if some are asked for.
    optional: Option<Box<OptionalTally>>,
}

/// Of [`LANES`] values.
#[derive(Debug, Clone, Default)]
struct Group {
    leaf: Moments<LANES>,
    tree: BlockTree<Moments<LANES>>,
    /// Appended ranges that do not fit into the tree.
    loose: Option<Box<Moments<LANES>>>,
    sums: [[f64; LANES]; 2],
}

/// What a tally comes to: values of all kinds behind each other, so that one number names any of them.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Samples.
    pub samples: u64,
    /// Means of the accumulated values, variances of these means, means of the even and of the odd samples (each of
    /// these four parts as long as the first; variances 0 below 2 samples), then what the first sample had, then room
    /// for more.
    pub values: Vec<f64>,
}

impl Tally {
    /// Nothing seen yet of samples with `all` values, of which the first `accumulated` are, a multiple of [`LANES`].
    pub fn new(accumulated: usize, all: usize, optional: Option<OptionalTally>) -> Self {
        let groups = vec![Group::default(); accumulated / LANES];
        let (first, optional) = (vec![0.0; all - accumulated].into(), optional.map(Box::new));
        Self { groups, counts: [0; 2], first, optional }
    }

    /// Optional statistics, if some are asked for.
    #[inline]
    pub fn optional(&self) -> Option<&OptionalTally> {
        self.optional.as_deref()
    }

    /// The same, to add to: samples go there beside [`Tally::extend`].
    #[inline]
    pub fn optional_mut(&mut self) -> Option<&mut OptionalTally> {
        self.optional.as_deref_mut()
    }

    /// Bytes that it takes on the heap apart from optional statistics, for up to 256 samples.
    pub fn bytes(&self) -> usize {
        // Subtrees of 1, 2, 4 and 8 blocks.
        let group = size_of::<Group>() + 4 * size_of::<Moments<LANES>>();
        self.groups.len() * group + self.first.len() * size_of::<f32>()
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        for group in &mut self.groups {
            group.leaf = Moments::default();
            group.tree.clear();
            group.loose = None;
            group.sums = [[0.0; LANES]; 2];
        }
        self.counts = [0; 2];
        if let Some(optional) = &mut self.optional {
            optional.clear();
        }
    }

    /// Adds samples of consecutive indices from `index` on, all of one block: blocks end where the next index is a
    /// multiple of their size. `samples` has all values of one sample, then of the next.
    #[inline]
    pub fn extend(&mut self, index: u32, samples: &[f32]) {
        let accumulated = self.groups.len() * LANES;
        let all = accumulated + self.first.len();
        let end = index + (samples.len() / all) as u32;
        if self.counts == [0; 2] {
            self.first.copy_from_slice(&samples[accumulated..all]);
        }
        self.counts[0] += end.div_ceil(2) - index.div_ceil(2);
        self.counts[1] += end / 2 - index / 2;
        for (g, group) in self.groups.iter_mut().enumerate() {
            // Copies, so that nothing goes through memory from sample to sample.
            let mut leaf = group.leaf;
            let (mut own, mut other) = (group.sums[index as usize & 1], group.sums[(index as usize + 1) & 1]);
            for sample in samples.chunks_exact(all) {
                let lanes: [f64; LANES] = std::array::from_fn(|lane| f64::from(sample[g * LANES..][lane]));
                leaf.push(lanes);
                for (sum, value) in own.iter_mut().zip(lanes) {
                    *sum += value;
                }
                std::mem::swap(&mut own, &mut other);
            }
            (group.sums[end as usize & 1], group.sums[(end as usize + 1) & 1]) = (own, other);
            group.leaf = leaf;
            if end.is_multiple_of(BLOCK_SAMPLES) {
                group.tree.push(leaf);
                group.leaf = Moments::default();
            }
        }
    }

    /// Writes what was seen.
    #[inline]
    pub fn summarise(&self, out: &mut Summary) {
        let accumulated = self.groups.len() * LANES;
        out.samples = self.counts.iter().map(|count| u64::from(*count)).sum();
        let (statistics, first) = out.values.split_at_mut(4 * accumulated);
        for (g, group) in self.groups.iter().enumerate() {
            let total = group.total();
            let variance = total.mean_variance().unwrap_or([0.0; LANES]);
            let [even, odd] = [0, 1].map(|half| over(group.sums[half], self.counts[half].max(1)));
            for (part, lanes) in [total.mean(), variance, even, odd].iter().enumerate() {
                statistics[part * accumulated + g * LANES..][..LANES].copy_from_slice(lanes);
            }
        }
        for (out, value) in first.iter_mut().zip(&self.first) {
            *out = f64::from(*value);
        }
    }

    /// Adds the samples of a range that went on where this one ended. Moments have the bits of one run if the range is
    /// made of whole aligned blocks (4 ranges of 2^k blocks are); else, like the half means always, they agree to the
    /// rounding of `f64`.
    pub fn append(&mut self, next: &Self) {
        for (group, next) in self.groups.iter_mut().zip(&next.groups) {
            group.append(next);
        }
        for (count, more) in self.counts.iter_mut().zip(next.counts) {
            *count += more;
        }
        if let (Some(optional), Some(next)) = (&mut self.optional, &next.optional) {
            optional.append(next);
        }
    }
}

/// Quotients by a count; by a power of two as products, which are the same and quicker.
#[inline]
fn over(sums: [f64; LANES], count: u32) -> [f64; LANES] {
    let count_f64 = f64::from(count);
    if count.is_power_of_two() {
        let inverse = 1.0 / count_f64;
        sums.map(|sum| sum * inverse)
    } else {
        sums.map(|sum| sum / count_f64)
    }
}

impl Group {
    /// Moments of all samples.
    #[inline]
    fn total(&self) -> Moments<LANES> {
        let mut total = self.tree.total_with(self.leaf);
        if let Some(loose) = &self.loose {
            total.merge(loose);
        }
        total
    }

    fn append(&mut self, next: &Self) {
        if self.leaf.count() == 0 && self.loose.is_none() && self.tree.append(&next.tree) {
            self.leaf = next.leaf;
            self.loose.clone_from(&next.loose);
        } else {
            self.loose.get_or_insert_default().merge(&next.total());
        }
        for (sums, next) in self.sums.iter_mut().zip(next.sums) {
            for (sum, more) in sums.iter_mut().zip(next) {
                *sum += more;
            }
        }
    }
}

impl Summary {
    /// For a tally of samples with `all` values, of which `accumulated` are accumulated, and for so many more values.
    pub fn new(accumulated: usize, all: usize, more: usize) -> Self {
        Self { samples: 0, values: vec![0.0; 3 * accumulated + all + more] }
    }
}
