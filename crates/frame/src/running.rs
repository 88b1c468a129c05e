/// Samples in a leaf of the fixed merge tree, see [`BlockTree`].
pub const BLOCK_SAMPLES: u32 = 16;

/// Inverses of the counts in a leaf, which a division would give as well, later. The first is not used.
const INVERSES: [f64; BLOCK_SAMPLES as usize + 1] = {
    let mut inverses = [0.0; BLOCK_SAMPLES as usize + 1];
    let mut count = 1;
    while count < inverses.len() {
        inverses[count] = 1.0 / count as f64;
        count += 1;
    }
    inverses
};

/// Running count, means and centred second moments of `C` quantities, in `f64`.
///
/// A mergeable monoid: [`Moments::push`] is Welford's update, [`Moments::merge`] that of Chan, Golub and
/// LeVeque (1979). Sums of squares are never subtracted from each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments<const C: usize> {
    count: u64,
    mean: [f64; C],
    m2: [f64; C],
}

impl<const C: usize> Default for Moments<C> {
    fn default() -> Self {
        Self { count: 0, mean: [0.0; C], m2: [0.0; C] }
    }
}

impl<const C: usize> Moments<C> {
    /// Adds one sample.
    #[inline]
    pub fn push(&mut self, sample: [f64; C]) {
        self.count += 1;
        // count ≥ 1 here
        let inverse = match INVERSES.get(self.count as usize) {
            Some(inverse) => *inverse,
            None => 1.0 / self.count as f64,
        };
        #[expect(clippy::needless_range_loop, reason = "zipped iterators are not made into vectors here")]
        for c in 0..C {
            let delta = sample[c] - self.mean[c];
            self.mean[c] += delta * inverse;
            self.m2[c] += delta * (sample[c] - self.mean[c]);
        }
    }

    /// Adds everything the other has seen. Neutral element: [`Moments::default`].
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let total = a + b; // both are at least 1
        for c in 0..C {
            let delta = other.mean[c] - self.mean[c];
            self.mean[c] += delta * (b / total);
            self.m2[c] += other.m2[c] + delta * delta * (a * b / total);
        }
        self.count += other.count;
    }

    /// Samples seen.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Means; zero if nothing was seen.
    #[must_use]
    pub fn mean(&self) -> [f64; C] {
        self.mean
    }

    /// Unbiased variance of one sample, s²; `None` below 2 samples.
    #[must_use]
    pub fn sample_variance(&self) -> Option<[f64; C]> {
        (self.count >= 2).then(|| self.m2.map(|m2| m2 / (self.count - 1) as f64))
    }

    /// Variance of the mean under independent sampling, s²/n; `None` below 2 samples.
    #[must_use]
    pub fn mean_variance(&self) -> Option<[f64; C]> {
        let count = self.count as f64;
        // By a power of two a product is the same, and quicker.
        let inverse = self.count.is_power_of_two().then_some(1.0 / count);
        self.sample_variance().map(|s2| match inverse {
            Some(inverse) => s2.map(|s2| s2 * inverse),
            None => s2.map(|s2| s2 / count),
        })
    }
}

/// What some samples come to, so that two disjoint sets of samples can be put together.
pub trait Partial: Clone + Default {
    /// Adds everything the other has seen. Neutral element: the default.
    fn merge(&mut self, other: &Self);
}

impl<const C: usize> Partial for Moments<C> {
    #[inline]
    fn merge(&mut self, other: &Self) {
        Moments::merge(self, other);
    }
}

/// Merges leaves of [`BLOCK_SAMPLES`] samples in a fixed binary tree, like the carries of a binary counter.
///
/// The result depends only on the sequence of leaves: any aligned run of 2^k leaves, accumulated elsewhere and
/// pushed with [`BlockTree::push_subtree`], gives the same bits as pushing the leaves one by one.
#[derive(Debug, Clone)]
pub struct BlockTree<S> {
    /// Subtree of 2^k leaves at index k, if bit k of `leaves` is set.
    levels: Vec<S>,
    leaves: u64,
}

impl<S> Default for BlockTree<S> {
    fn default() -> Self {
        Self { levels: Vec::new(), leaves: 0 }
    }
}

impl<S: Partial> BlockTree<S> {
    /// Forgets everything, keeping the allocation.
    pub fn clear(&mut self) {
        self.leaves = 0;
    }

    /// Adds the next leaf.
    #[inline]
    pub fn push(&mut self, leaf: S) {
        self.push_subtree(leaf, 0);
    }

    /// Adds a subtree of 2^`height` leaves. The number of leaves so far must be a multiple of that.
    ///
    /// # Panics
    /// If the subtree is not aligned, because then the tree would not be the fixed one.
    pub fn push_subtree(&mut self, mut subtree: S, height: u32) {
        assert!(self.leaves.is_multiple_of(1 << height), "a subtree must start at a multiple of its size");
        let mut level = height as usize;
        while self.leaves >> level & 1 == 1 {
            // What stays behind is not used again.
            self.levels[level].merge(&subtree);
            std::mem::swap(&mut self.levels[level], &mut subtree);
            level += 1;
        }
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, S::default);
        }
        self.levels[level] = subtree;
        self.leaves += 1 << height;
    }

    /// Adds all leaves of a tree that went on where this one ended, if that makes the fixed tree: the leaves so far
    /// must be a multiple of the other's largest subtree. Else nothing changes and the answer is `false`.
    pub fn append(&mut self, next: &Self) -> bool {
        let heights = (0..next.levels.len()).rev().filter(|level| next.leaves >> level & 1 == 1);
        if heights.clone().next().is_some_and(|top| !self.leaves.is_multiple_of(1 << top)) {
            return false;
        }
        for level in heights {
            self.push_subtree(next.levels[level].clone(), level as u32);
        }
        true
    }

    /// Everything pushed so far, smallest subtrees merged first.
    #[must_use]
    pub fn total(&self) -> S {
        self.total_with(S::default())
    }

    /// The same with one more leaf, which may be empty and stays outside: what pushing it first would give, bit for
    /// bit.
    #[must_use]
    pub fn total_with(&self, last: S) -> S {
        let mut total = last;
        for (level, subtree) in self.levels.iter().enumerate() {
            if self.leaves >> level & 1 == 1 {
                let mut left = subtree.clone();
                left.merge(&total);
                total = left;
            }
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SplitMix64, enough for test data.
    fn uniforms(seed: u64, n: usize) -> Vec<f64> {
        let mut state = seed;
        (0..n)
            .map(|_| {
                state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
                let mut z = state;
                z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
                z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
                ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
            })
            .collect()
    }

    fn two_pass(samples: &[f64]) -> (f64, f64) {
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let m2: f64 = samples.iter().map(|x| (x - mean) * (x - mean)).sum();
        (mean, m2 / (samples.len() - 1) as f64)
    }

    fn sequential(samples: &[f64]) -> Moments<1> {
        let mut moments = Moments::default();
        samples.iter().for_each(|&x| moments.push([x]));
        moments
    }

    #[test]
    fn agrees_with_two_passes() {
        for (seed, n) in [(1, 2), (2, 3), (3, 17), (4, 1000), (5, 4096)] {
            let samples: Vec<f64> = uniforms(seed, n).iter().map(|u| u * u * 7.0 - 1.0).collect();
            let (mean, s2) = two_pass(&samples);
            let moments = sequential(&samples);
            assert!((moments.mean()[0] - mean).abs() <= 1e-13 * mean.abs().max(1.0));
            assert!((moments.sample_variance().unwrap()[0] - s2).abs() <= 1e-12 * s2);
        }
    }

    #[test]
    fn survives_cancellation() {
        // Mean 1e6, standard deviation 0.03: E[x²]−E[x]² would lose every digit in f32 and most in f64.
        let samples: Vec<f64> = uniforms(9, 1000).iter().map(|u| 1e6 + (u - 0.5) * 0.1).collect();
        let (mean, s2) = two_pass(&samples);
        let moments = sequential(&samples);
        assert_eq!(moments.mean()[0] as f32, mean as f32);
        assert!((moments.sample_variance().unwrap()[0] - s2).abs() <= 1e-6 * s2);
    }

    #[test]
    fn merge_of_any_split_agrees() {
        let samples = uniforms(11, 300);
        let whole = sequential(&samples);
        for split in [0, 1, 2, 150, 299, 300] {
            let mut left = sequential(&samples[..split]);
            left.merge(&sequential(&samples[split..]));
            assert_eq!(left.count(), 300);
            assert!((left.mean()[0] - whole.mean()[0]).abs() <= 1e-12 * whole.mean()[0]);
            let (a, b) = (left.sample_variance().unwrap()[0], whole.sample_variance().unwrap()[0]);
            assert!((a - b).abs() <= 1e-12 * b);
        }
    }

    #[test]
    fn aligned_pieces_of_the_tree_give_equal_bits() {
        let samples = uniforms(13, 13 * BLOCK_SAMPLES as usize);
        let leaves: Vec<Moments<1>> = samples.chunks(BLOCK_SAMPLES as usize).map(sequential).collect();
        let mut at_once = BlockTree::default();
        leaves.iter().for_each(|leaf| at_once.push(*leaf));
        let mut pieces = BlockTree::default();
        for (height, range) in [(3, 0..8), (2, 8..12), (0, 12..13)] {
            let mut piece = BlockTree::default();
            leaves[range].iter().for_each(|leaf| piece.push(*leaf));
            pieces.push_subtree(piece.total(), height);
        }
        assert_eq!(at_once.total(), pieces.total());
        assert_eq!(at_once.total().count(), samples.len() as u64);
        for count in 0..leaves.len() {
            let mut tree = BlockTree::default();
            leaves[..count].iter().for_each(|leaf| tree.push(*leaf));
            let with = tree.total_with(leaves[count]);
            tree.push(leaves[count]);
            assert_eq!(with, tree.total());
        }
    }

    #[test]
    fn appended_trees_give_equal_bits_or_are_refused() {
        let samples = uniforms(17, 13 * BLOCK_SAMPLES as usize);
        let leaves: Vec<Moments<1>> = samples.chunks(BLOCK_SAMPLES as usize).map(sequential).collect();
        let tree = |range: std::ops::Range<usize>| {
            let mut tree = BlockTree::default();
            leaves[range].iter().for_each(|leaf| tree.push(*leaf));
            tree
        };
        let mut joined = tree(0..4);
        assert!(joined.append(&tree(4..8)) && joined.append(&tree(8..13)));
        assert_eq!(joined.total(), tree(0..13).total());
        let mut short = tree(0..3);
        assert!(!short.append(&tree(3..13)), "8 leaves cannot start at the fourth");
        assert_eq!(short.total(), tree(0..3).total());
        assert!(short.append(&BlockTree::default()));
    }

    #[test]
    fn one_sample_has_no_variance() {
        assert_eq!(sequential(&[3.0]).sample_variance(), None);
        assert_eq!(Moments::<1>::default().mean_variance(), None);
    }
}
