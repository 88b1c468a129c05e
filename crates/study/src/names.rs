//! Names with a meaning everywhere.

/// The id of the baseline: the input itself.
pub const BASELINE: &str = "mc";

/// The three names closest to `given`, closest first.
pub(crate) fn nearest<'a>(given: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    // The time that a comparison takes grows with the product of both lengths.
    let given = given.char_indices().nth(100).map_or(given, |(end, _)| &given[..end]);
    let mut ranked: Vec<(f64, &str)> = names.map(|n| (strsim::jaro_winkler(given, n), n)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    ranked.into_iter().take(3).map(|(_, n)| n.to_owned()).collect()
}
