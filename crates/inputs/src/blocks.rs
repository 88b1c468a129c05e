//! Square blocks of pixels: units that are nearly independent where neighbouring pixels are not.

/// Blocks of an image, row by row; those at the right and lower border may be smaller.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Blocks {
    width: usize,
    height: usize,
    edge: usize,
    columns: usize,
}

/// Fewest blocks from which a spread is estimated.
const LEAST: usize = 48;

impl Blocks {
    /// The largest edge of 8, 4 and 2 pixels that leaves enough blocks.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let of = |edge: usize| Self { width, height, edge, columns: width.div_ceil(edge) };
        [8, 4].into_iter().map(of).find(|blocks| blocks.count() >= LEAST).unwrap_or_else(|| of(2))
    }

    pub(crate) fn edge(&self) -> usize {
        self.edge
    }

    pub(crate) fn count(&self) -> usize {
        self.columns * self.height.div_ceil(self.edge)
    }

    /// The block of a pixel.
    pub(crate) fn of(&self, pixel: usize) -> usize {
        (pixel / self.width / self.edge) * self.columns + (pixel % self.width) / self.edge
    }

    /// First column and row of a block.
    pub(crate) fn corner(&self, block: usize) -> (usize, usize) {
        (block % self.columns * self.edge, block / self.columns * self.edge)
    }
}

/// The middle value; `None` of nothing. The order of the values is lost.
pub(crate) fn median(values: &mut [f64]) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let middle = values.len() / 2;
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_every_pixel_once_and_are_many() {
        for (width, height, edge) in [(64, 48, 8), (40, 30, 4), (9, 7, 2), (1, 1, 2)] {
            let blocks = Blocks::new(width, height);
            assert_eq!(blocks.edge(), edge, "{width}×{height}");
            let mut sizes = vec![0; blocks.count()];
            (0..width * height).for_each(|p| sizes[blocks.of(p)] += 1);
            assert!(sizes.iter().all(|&n| n > 0 && n <= edge * edge));
            assert_eq!(blocks.of(width * height - 1), blocks.count() - 1);
        }
        assert_eq!(Blocks::new(64, 48).corner(9), (8, 8));
    }
}
