/// Index of the pixel that stands for position `i` of a line of `n` ≥ 1 pixels: mirrored at the border without
/// repeating the edge pixel, as often as needed.
pub(crate) fn mirror(i: isize, n: usize) -> usize {
    let last = n as isize - 1;
    if last <= 0 {
        return 0;
    }
    let folded = i.rem_euclid(2 * last);
    folded.min(2 * last - folded) as usize
}

#[cfg(test)]
mod tests {
    use super::mirror;

    #[test]
    fn short_lines_are_folded_as_often_as_needed() {
        let folded: Vec<usize> = (-5..8).map(|i| mirror(i, 4)).collect();
        assert_eq!(folded, [1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1]);
        assert_eq!((mirror(-3, 1), mirror(-3, 2), mirror(9, 2)), (0, 1, 1));
    }
}
