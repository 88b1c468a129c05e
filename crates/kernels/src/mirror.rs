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

#[cfg(test)]
mod tests {
    use super::mirror;

    #[test]
    fn mirroring_reflects_as_often_as_needed() {
        let at = |n| (-7..=8).map(|i| mirror(i, n)).collect::<Vec<_>>();
        assert_eq!(at(1), [0; 16]);
        assert_eq!(at(2), [1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0]);
        assert_eq!(at(4), [1, 0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1, 2]);
    }
}
