//! Square blocks of pixels: units that are nearly independent where neighbouring pixels are not.

/// Blocks of an image, row by row; those at the right and lower border may be smaller.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Blocks {
    width: usize,
    height: usize,
    edge: usize,
    columns: usize,
}

/// Fewest blocks from which a spread is estimated.
const LEAST: usize = 48;

impl Blocks {
    /// Blocks of an image of `width` × `height` pixels with sides of `edge` pixels. An image without width has one column,
    /// an edge of 0 is one of 1.
    #[must_use]
    pub fn with_edge(width: usize, height: usize, edge: usize) -> Self {
        let (width, edge) = (width.max(1), edge.max(1));
        Self { width, height, edge, columns: width.div_ceil(edge) }
    }

    /// The largest edge of 8, 4 and 2 pixels that leaves at least 48 blocks.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        let of = |edge: usize| Self::with_edge(width, height, edge);
        [8, 4].into_iter().map(of).find(|blocks| blocks.count() >= LEAST).unwrap_or_else(|| of(2))
    }

    /// Side of a block, pixels.
    #[must_use]
    pub fn edge(&self) -> usize {
        self.edge
    }

    /// Number of blocks.
    #[must_use]
    pub fn count(&self) -> usize {
        self.columns * self.height.div_ceil(self.edge)
    }

    /// Number of pixels of the image.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// The block of a pixel, counted row by row.
    #[must_use]
    pub fn of(&self, pixel: usize) -> usize {
        (pixel / self.width / self.edge) * self.columns + (pixel % self.width) / self.edge
    }

    /// First column and row of a block.
    #[must_use]
    pub fn corner(&self, block: usize) -> (usize, usize) {
        (block % self.columns * self.edge, block / self.columns * self.edge)
    }
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
