//! Where the planes of a tile's working copies lie in memory.

/// Values per cache line.
pub(crate) const LINE: usize = 16;

/// Planes of one kind.
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
    /// Distance between rows of one plane.
    pub pitch: usize,
    /// Distance between planes.
    pub plane: usize,
}

impl Grid {
    /// One plane after the other.
    pub fn new(left: usize, above: usize, columns: usize, rows: usize) -> Self {
        // So that the rows of a column of vectors fall into different cache sets.
        let pitch = odd_lines(columns);
        // Planes start 5 lines apart modulo a page, so that equal places of them do not share a cache set.
        let plane = (rows * pitch).next_multiple_of(64 * LINE) + 5 * LINE;
        Self { left, above, columns, rows, pitch, plane }
    }

    /// `planes` planes row by row: what belongs to one row of pixels lies together. A step over a row then stays within a few
    /// pages of memory, however many planes it reads.
    pub fn interleaved(
        planes: usize,
        (left, above): (usize, usize),
        (columns, rows): (usize, usize),
    ) -> Self {
        let plane = odd_lines(columns);
        Self { left, above, columns, rows, pitch: odd_lines(planes * plane), plane }
    }

    /// Values of all planes of an interleaved grid.
    pub fn interleaved_size(&self) -> usize {
        self.rows * self.pitch
    }

    /// Index of the tile's first pixel within a plane.
    pub fn origin(&self) -> usize {
        self.above * self.pitch + self.left
    }
}

/// Room for some values in an odd number of cache lines.
fn odd_lines(values: usize) -> usize {
    (values.div_ceil(LINE) | 1) * LINE
}
