use noisefloor_study::exhibit::Forest;
use noisefloor_study::summary::{CellSummary, Interval};

/// Smallest and largest end of the ratios to plain Monte Carlo, with one in between.
pub(super) fn range(cells: &[&CellSummary], metric: &str) -> Option<(f64, f64)> {
    let ends = cells
        .iter()
        .filter_map(|c| c.ratio_to_mc.get(metric))
        .flat_map(|i| [Some(i.value), i.low, i.high])
        .flatten()
        .filter(|v| *v > 0.0 && v.is_finite());
    let (low, high) = ends.fold((1.0f64, 1.0f64), |(low, high), v| (low.min(v), high.max(v)));
    (high > low).then(|| (low / 1.1, high * 1.1))
}

/// Positions of a ratio in a range that all rows of a table share.
pub(super) fn forest(i: &Interval, (low, high): (f64, f64)) -> Option<Forest> {
    // `high > low > 0` by construction of the range.
    let place = |v: f64| {
        let share = (v.max(low) / low).ln() / (high / low).ln();
        (share.clamp(0.0, 1.0) * 1000.0).round() / 10.0
    };
    (i.value > 0.0 && i.value.is_finite()).then(|| {
        let (from, to) = (place(i.low.unwrap_or(i.value)), place(i.high.unwrap_or(i.value)));
        let width = ((to - from).max(0.0) * 10.0).round() / 10.0;
        Forest { one: place(1.0), at: place(i.value), low: from, width }
    })
}
