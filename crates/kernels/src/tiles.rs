//! Cuts images into tiles and hands each to a worker thread, with its own part of the output to write.
//!
//! The only module of the crate that starts parallel work. A tile's result may depend on nothing but the inputs,
//! never on which worker ran it or what it ran before; then the output is the same for any number of threads.

use rayon::prelude::*;

/// A rectangle of pixels that lies inside the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tile {
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
pub(crate) type TileRows<'a> = Vec<&'a mut [f32]>;

/// Calls `body` once for each tile of at most `tile_size` (width, height), in parallel on the current rayon pool.
///
/// `outputs` are planes of `width` values per row; `body` gets its tile's rows of each. `scratch` makes the
/// working memory that a worker keeps from tile to tile.
pub(crate) fn for_each_tile<'a, S>(
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

/// Index of the first value that is not `ok`, searched in parallel on the current rayon pool.
pub(crate) fn first_bad(values: &[f32], ok: impl Fn(f32) -> bool + Sync) -> Option<usize> {
    // Whole chunks without an early exit inside, so that the usual case, all well, runs at the speed of memory.
    const CHUNK: usize = 1 << 14;
    let bad = |chunk: &[f32]| !chunk.iter().fold(true, |all, &v| all & ok(v));
    let start = CHUNK * values.par_chunks(CHUNK).position_first(bad)?;
    values[start..].iter().position(|&v| !ok(v)).map(|i| start + i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_bad_value_is_found() {
        let mut values = vec![1.0; 100_000];
        assert_eq!(first_bad(&values, |v| v > 0.0), None);
        for bad in [99_999, 70_000, 16_384, 16_383, 0] {
            values[bad] = -1.0;
            assert_eq!(first_bad(&values, |v| v > 0.0), Some(bad));
        }
    }

    #[test]
    fn tiles_cover_every_pixel_of_every_plane_once() {
        for (width, height) in [(1, 1), (64, 16), (65, 17), (130, 5), (3, 40)] {
            let (mut a, mut b) = (vec![0.0f32; width * height], vec![0.0f32; width * height]);
            for_each_tile(
                width,
                (64, 16),
                [a.as_mut_slice(), b.as_mut_slice()],
                || (),
                |(), tile, planes| {
                    assert!(tile.x + tile.width <= width && tile.y + tile.height <= height);
                    for (offset, rows) in [1.0, 2.0].into_iter().zip(planes) {
                        assert_eq!(rows.len(), tile.height);
                        for (j, row) in rows.into_iter().enumerate() {
                            assert_eq!(row.len(), tile.width);
                            for (i, value) in row.iter_mut().enumerate() {
                                *value += offset + ((tile.y + j) * width + tile.x + i) as f32;
                            }
                        }
                    }
                },
            );
            for i in 0..width * height {
                assert_eq!((a[i], b[i]), (1.0 + i as f32, 2.0 + i as f32));
            }
        }
    }
}
