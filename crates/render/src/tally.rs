//! Statistics of one pixel.

use noisefloor_frame::{BLOCK_SAMPLES, BlockTree, Moments};

/// Moments of `C` values in the fixed tree of sample blocks, and the means of the even and of the odd samples.
#[derive(Debug, Clone)]
pub struct Tally<const C: usize> {
    leaf: Moments<C>,
    tree: BlockTree<C>,
    /// Appended ranges that do not fit into the tree.
    loose: Moments<C>,
    sums: [[f64; C]; 2],
    counts: [u32; 2],
}

impl<const C: usize> Tally<C> {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self {
            leaf: Moments::default(),
            tree: BlockTree::default(),
            loose: Moments::default(),
            sums: [[0.0; C]; 2],
            counts: [0; 2],
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.leaf = Moments::default();
        self.tree.clear();
        if self.loose.count() > 0 {
            self.loose = Moments::default();
        }
        self.sums = [[0.0; C]; 2];
        self.counts = [0; 2];
    }

    /// Adds sample `index` of the run. Leaves end where `index + 1` is a multiple of their size.
    #[inline(always)]
    pub fn push(&mut self, index: u32, values: &[f32; C]) {
        let values = values.map(f64::from);
        self.leaf.push(values);
        let half = (index & 1) as usize;
        let sums = &mut self.sums[half];
        for c in 0..C {
            sums[c] += values[c];
        }
        self.counts[half] += 1;
        if (index + 1).is_multiple_of(BLOCK_SAMPLES) {
            self.close();
        }
    }

    #[inline(never)]
    fn close(&mut self) {
        self.tree.push(self.leaf);
        self.leaf = Moments::default();
    }

    /// Moments of all samples.
    pub fn total(&mut self) -> Moments<C> {
        if self.leaf.count() > 0 {
            self.close();
        }
        let mut total = self.tree.total();
        total.merge(&self.loose);
        total
    }

    /// Adds the samples of a range that went on where this one ended. Moments have the bits of one run if the range is
    /// made of whole aligned blocks (4 ranges of 2^k blocks are); else, like the half means always, they agree to the
    /// rounding of `f64`.
    pub fn append(&mut self, next: &Self) {
        if self.leaf.count() == 0 && self.loose.count() == 0 && self.tree.append(&next.tree) {
            self.leaf = next.leaf;
            self.loose = next.loose;
        } else {
            self.loose.merge(&next.clone().total());
        }
        for half in 0..2 {
            for (sum, more) in self.sums[half].iter_mut().zip(next.sums[half]) {
                *sum += more;
            }
            self.counts[half] += next.counts[half];
        }
    }

    /// Mean of the even samples (`half` 0) or of the odd ones (1); zero if there was none.
    pub fn half_mean(&self, half: usize) -> [f64; C] {
        let count = f64::from(self.counts[half].max(1));
        self.sums[half].map(|sum| sum / count)
    }
}
