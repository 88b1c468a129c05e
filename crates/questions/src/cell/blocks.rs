//! Uncertainty within one image, where there is no second replicate.

use noisefloor_metrics::BLOCK_SIDE;
use noisefloor_stats::{Groups, ShapeError};

/// Blocks that are told apart at a time: group numbers are bytes, and one stands for "not now".
const AT_ONCE: usize = 250;

/// A division of an image into blocks of about 32×32 pixels.
#[derive(Debug)]
pub(crate) struct Blocks {
    of_pixel: Vec<usize>,
    count: usize,
}

impl Blocks {
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let along = |size: usize| ((size + BLOCK_SIDE / 2) / BLOCK_SIDE).max(1);
        let (columns, rows) = (along(width), along(height));
        let block = |p: usize| (p / width * rows / height) * columns + p % width * columns / width;
        Self { of_pixel: (0..width * height).map(block).collect(), count: columns * rows }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Block of a row-major pixel.
    pub(crate) fn of(&self, pixel: usize) -> usize {
        self.of_pixel[pixel]
    }

    /// One tally per block; `count` gives that of everything, then those of the groups. `None` if the shapes disagree,
    /// which the same count over classes has already told.
    pub(crate) fn tallies<T>(
        &self,
        count: impl Fn(Groups<'_>) -> Result<Vec<T>, ShapeError>,
    ) -> Option<Vec<T>> {
        let mut out = Vec::with_capacity(self.count);
        for first in (0..self.count).step_by(AT_ONCE) {
            let here = AT_ONCE.min(self.count - first);
            let group = |&block: &usize| match block.checked_sub(first) {
                Some(index) if index < here => index as u8,
                _ => u8::MAX,
            };
            let of_pixel: Vec<u8> = self.of_pixel.iter().map(group).collect();
            out.extend(count(Groups { of_pixel: &of_pixel, count: here }).ok()?.into_iter().skip(1));
        }
        Some(out)
    }
}

/// Standard error of Σhits/Σtotals: the spread of block sums about the common rate, the linear form of a bootstrap
/// over the blocks. `None` with fewer than 2 blocks that have anything.
pub(crate) fn within_se<T>(tallies: &[T], hits_and_total: impl Fn(&T) -> (u64, u64)) -> Option<f64> {
    let blocks: Vec<(f64, f64)> = tallies
        .iter()
        .map(hits_and_total)
        .filter(|(_, total)| *total > 0)
        .map(|(hits, total)| (hits as f64, total as f64))
        .collect();
    if blocks.len() < 2 {
        return None;
    }
    let total: f64 = blocks.iter().map(|b| b.1).sum(); // positive: every block kept has some
    let rate = blocks.iter().map(|b| b.0).sum::<f64>() / total;
    let spread: f64 = blocks.iter().map(|b| (b.0 - rate * b.1).powi(2)).sum();
    let correction = blocks.len() as f64 / (blocks.len() - 1) as f64;
    Some((spread * correction).sqrt() / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn independent_hits_have_the_binomial_error() {
        // 40 blocks of 500 hits decided by a hash; the estimate itself varies by 1/√(2·39) = 11 %.
        let hit = |k: u64| u64::from(blake3::hash(&k.to_le_bytes()).as_bytes()[0] < 64);
        let tallies: Vec<(u64, u64)> =
            (0..40u64).map(|b| ((0..500).map(|k| hit(b * 500 + k)).sum(), 500)).collect();
        let se = within_se(&tallies, |t| *t).unwrap();
        let binomial = (0.25f64 * 0.75 / 20_000.0).sqrt();
        assert!((se / binomial - 1.0).abs() < 4.0 * 0.11, "{se} against {binomial}");
        assert_eq!(within_se(&tallies[..1], |t| *t), None);
    }

    #[test]
    fn every_block_is_counted_once_even_if_there_are_more_than_bytes() {
        let blocks = Blocks::new(32 * 30, 32 * 20);
        let sizes = blocks
            .tallies(|groups| {
                let mut out = vec![0usize; 1 + groups.count];
                groups
                    .of_pixel
                    .iter()
                    .filter(|&&g| usize::from(g) < groups.count)
                    .for_each(|&g| out[1 + usize::from(g)] += 1);
                Ok(out)
            })
            .unwrap();
        assert_eq!(sizes, vec![32 * 32; 600]);
    }
}
