//! Where the planes of a tile's working copies lie in memory.

/// Values per cache line.
pub(crate) const LINE: usize = 16;

/// One kind of plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// Columns left of the tile.
    pub left: usize,
    /// Rows above the tile.
    pub above: usize,
    /// Columns in use, from the leftmost.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Distance between rows.
    pub pitch: usize,
    /// Distance between planes.
    pub plane: usize,
}

impl Grid {
    pub fn new(left: usize, above: usize, columns: usize, rows: usize) -> Self {
        // An odd number of lines, so that the rows of a column of vectors fall into different cache sets.
        let pitch = (columns.div_ceil(LINE) | 1) * LINE;
        // Planes start 5 lines apart modulo a page, so that equal places of them do not share a cache set.
        let plane = (rows * pitch).next_multiple_of(64 * LINE) + 5 * LINE;
        Self { left, above, columns, rows, pitch, plane }
    }

    /// Index of the tile's first pixel within a plane.
    pub fn origin(&self) -> usize {
        self.above * self.pitch + self.left
    }
}
