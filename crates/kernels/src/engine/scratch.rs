//! A worker's memory, kept from tile to tile.

use super::LINE;

/// Values after the last part: vectors may start on its last ones.
const SLACK: usize = 4 * LINE;

/// Memory whose parts start at cache lines if their sizes are whole lines.
pub(crate) struct Scratch<T = f32> {
    memory: Vec<T>,
    /// Index of the first cache line that starts in `memory`.
    start: usize,
}

impl<T: Copy + Default> Scratch<T> {
    /// Room for parts of `size` values in total.
    pub fn new(size: usize) -> Self {
        let memory = vec![T::default(); size + LINE + SLACK];
        // `align_offset` may give up and say usize::MAX; alignment is for speed only.
        let start = memory.as_ptr().align_offset(64).min(LINE);
        Self { memory, start }
    }

    /// Parts of these sizes, one after the other, with what they hold from before; the last gets the slack too.
    ///
    /// # Panics
    /// If they are more than there is room for.
    pub fn parts<const N: usize>(&mut self, sizes: [usize; N]) -> [&mut [T]; N] {
        let mut rest = &mut self.memory[self.start..];
        let mut left = N;
        sizes.map(|size| {
            left -= 1;
            let end = if left == 0 { rest.len() } else { size };
            assert!(size <= end, "room for all parts");
            let part;
            (part, rest) = std::mem::take(&mut rest).split_at_mut(end);
            part
        })
    }
}
