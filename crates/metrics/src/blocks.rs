//! Square blocks of an image, whose pixels are taken together.

/// Side of the square blocks that are resampled together, in pixels: neighbouring pixels share their error
/// after denoising.
pub const BLOCK_SIDE: usize = 32;

/// Pixels of each block that pass `keep`; blocks without any are left out. The sides are as near to
/// [`BLOCK_SIDE`] as an even division of the image allows.
pub(crate) fn blocks(width: usize, height: usize, keep: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
    let count = |size: usize| ((size + BLOCK_SIDE / 2) / BLOCK_SIDE).max(1);
    let (columns, rows) = (count(width), count(height));
    let mut blocks = vec![Vec::new(); columns * rows];
    for y in 0..height {
        for x in 0..width {
            let block = (y * rows / height) * columns + x * columns / width;
            if keep(y * width + x) {
                blocks[block].push(y * width + x);
            }
        }
    }
    blocks.retain(|block| !block.is_empty());
    blocks
}
