//! Cuts images into tiles and hands each to a worker thread, with its own part of the output to write.
//!
//! The only module of the crate that starts parallel work. A tile's result may depend on nothing but the inputs,
//! never on which worker ran it or what it ran before; then the output is the same for any number of threads.

use rayon::prelude::*;

/// Tile of the window filters, (width, height) in pixels: its working copies stay in the second cache.
pub(crate) const TILE: (usize, usize) = (64, 16);

/// A rectangle of pixels that lies inside the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Column of its first pixel.
    pub x: usize,
    /// Row of its first pixel.
    pub y: usize,
    /// Columns, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
}

/// One tile's part of one output plane: a mutable slice for each of its rows.
pub type TileRows<'a> = Vec<&'a mut [f32]>;

/// Calls `body` once for each tile of at most `tile_size` (width, height), in parallel on the current rayon pool.
///
/// `outputs` are planes of `width` values per row; `body` gets its tile's rows of each. `scratch` makes the
/// working memory that a worker keeps from tile to tile.
pub fn for_each_tile<'a, S>(
    width: usize,
    tile_size: (usize, usize),
    outputs: impl IntoIterator<Item = &'a mut [f32]>,
    scratch: impl Fn() -> S + Sync + Send,
    body: impl Fn(&mut S, Tile, Vec<TileRows<'_>>) + Sync + Send,
) {
    let mut tiles: Vec<(Tile, Vec<TileRows<'_>>)> = Vec::new();
    for (plane, values) in outputs.into_iter().enumerate() {
        let mut next = 0;
        for (band, rows) in values.chunks_mut(width * tile_size.1).enumerate() {
            let first = next;
            for row in rows.chunks_mut(width) {
                next = first;
                for (column, part) in row.chunks_mut(tile_size.0).enumerate() {
                    if next == tiles.len() {
                        let (x, y) = (column * tile_size.0, band * tile_size.1);
                        let tile = Tile { x, y, width: part.len(), height: 0 };
                        tiles.push((tile, Vec::new()));
                    }
                    let (tile, parts) = &mut tiles[next];
                    if parts.len() == plane {
                        parts.push(Vec::new());
                    }
                    parts[plane].push(part);
                    tile.height = parts[plane].len();
                    next += 1;
                }
            }
        }
    }
    tiles.into_par_iter().for_each_init(scratch, |scratch, (tile, rows)| body(scratch, tile, rows));
}

/// Calls `body` once for each tile of at most `tile_size` (width, height) of an image, in parallel on the current rayon
/// pool, and gives what it gives: tiles row by row. `scratch` makes the working memory that a worker keeps from tile to tile.
pub(crate) fn map_tiles<S, T: Send>(
    (width, height): (usize, usize),
    tile_size: (usize, usize),
    scratch: impl Fn() -> S + Sync + Send,
    body: impl Fn(&mut S, Tile) -> T + Sync + Send,
) -> Vec<T> {
    let across = width.div_ceil(tile_size.0);
    (0..across * height.div_ceil(tile_size.1))
        .into_par_iter()
        .map_init(scratch, |scratch, i| {
            let (x, y) = (i % across * tile_size.0, i / across * tile_size.1);
            let (width, height) = (tile_size.0.min(width - x), tile_size.1.min(height - y));
            body(scratch, Tile { x, y, width, height })
        })
        .collect()
}

/// Index of the first value that is not `ok`, searched in parallel on the current rayon pool.
pub fn first_bad(values: &[f32], ok: impl Fn(f32) -> bool + Sync) -> Option<usize> {
    // Whole chunks without an early exit inside, so that the usual case, all well, runs at the speed of memory.
    const CHUNK: usize = 1 << 14;
    let bad = |chunk: &[f32]| !chunk.iter().fold(true, |all, &v| all & ok(v));
    let start = CHUNK * values.par_chunks(CHUNK).position_first(bad)?;
    values[start..].iter().position(|&v| !ok(v)).map(|i| start + i)
}
