//! Citations in the source of a method, so that its tests can hold them to the paper.

/// Numbers that a text cites after `words`, in their order: "7" as 7, "5-8" as 5 to 8; a plural is read as well.
///
/// ```
/// use noisefloor_conformance::cited;
///
/// let text = "as Alg. 1, line 7 and Alg. 1, lines 9-11 say; line 3";
/// assert_eq!(cited(text, "Alg. 1, line"), [7, 9, 10, 11]);
/// assert_eq!(cited("Eq. 3, Eq. 12. Equation 4", "Eq."), [3, 12]);
/// ```
pub fn cited(text: &str, words: &str) -> Vec<u32> {
    let number = |text: &str| -> Option<u32> {
        text.split(|c: char| !c.is_ascii_digit()).next().and_then(|digits| digits.parse().ok())
    };
    let range = |(at, _): (usize, &str)| {
        let after = &text[at + words.len()..];
        let after = after.strip_prefix('s').unwrap_or(after).strip_prefix(' ')?;
        let first = number(after)?;
        let rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
        let last = rest.strip_prefix('-').and_then(number).unwrap_or(first);
        Some(first..=last)
    };
    text.match_indices(words).filter_map(range).flatten().collect()
}
