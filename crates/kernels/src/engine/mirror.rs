//! Border rule of patches.

/// Index of the pixel that stands for position `i` of a line of `n` pixels: mirrored at the border without
/// repeating the edge pixel, as often as needed. `n` is at least 1.
#[must_use]
pub fn mirror(i: isize, n: usize) -> usize {
    if (0..n as isize).contains(&i) {
        return i as usize;
    }
    let last = n as isize - 1;
    if last == 0 {
        return 0;
    }
    let folded = i.rem_euclid(2 * last);
    folded.min(2 * last - folded) as usize
}
