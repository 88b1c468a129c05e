//! The comparison for people: one column for each image.

use noisefloor_metrics::{METRICS, Measurer};

use super::Compared;
use crate::table::{aligned, number};

pub fn describe(measurer: &Measurer<'_>, all: &[Compared<'_>]) -> String {
    let mut out = String::new();
    for finding in all.iter().flat_map(|one| &one.findings) {
        out.push_str(&format!("! {finding}\n"));
    }
    if all.iter().any(|one| one.measured.pixels != all[0].measured.pixels) {
        out.push_str("! the images are measured over different pixels: their numbers do not compare\n");
    }
    out.push_str(&format!("reference noise: {}\n", measurer.correction()));

    let mut head = vec!["metric".to_owned()];
    head.extend(names(all));
    head.push("better".to_owned());
    let mut rows = vec![head];
    for metric in measurer.metrics() {
        let cell = |one: &Compared<'_>| match one.measured.values.get(metric.id).copied().flatten() {
            None => "not finite".to_owned(),
            Some(_) if one.upper_limits().contains_key(metric.id) => {
                format!("< {}", number(one.upper_limits()[metric.id]))
            }
            Some(value) => {
                let unit = if metric.unit.is_empty() { String::new() } else { format!(" {}", metric.unit) };
                let error = one.measured.reference_se.get(metric.id);
                let error = error.map_or(String::new(), |error| format!(" ± {}", number(*error)));
                format!("{}{error}{unit}", number(value))
            }
        };
        rows.push(row(metric.id, all, cell, &metric.better.to_string()));
    }
    let pixels = |metric: &'static str| {
        move |one: &Compared<'_>| format!("{} of {}", one.pixels(metric), one.image.pixels())
    };
    for metric in METRICS.iter().filter(|m| all.iter().any(|one| one.bias().contains_key(m.id))) {
        let cell = |one: &Compared<'_>| one.bias().get(metric.id).map_or("–".into(), |bias| number(*bias));
        rows.push(row(&format!("  bias of {}", metric.id), all, cell, ""));
    }
    rows.push(row("pixels", all, pixels(METRICS[0].id), ""));
    rows.push(row("  of relmse_trimmed", all, pixels("relmse_trimmed"), ""));
    out.push_str(&aligned(&rows));

    if all.iter().any(|one| !one.measured.reference_se.is_empty()) {
        out.push_str("± is the standard error that the reference's own noise contributes\n");
    }
    if all.iter().any(|one| !one.bias().is_empty()) {
        out.push_str(&format!(
            "the reference's noise biases relative errors; taken out: the above, by a {}\n",
            measurer.bias_correction()
        ));
    }
    if all.iter().any(|one| !one.upper_limits().is_empty()) {
        out.push_str(
            "< is an upper limit: the reference is so noisy that what is left of the bias is in doubt\n",
        );
    }
    for map in all.iter().filter_map(|one| one.map.as_ref()) {
        out.push_str(&format!("wrote {}: {}\n", map.path.display(), map.note()));
    }
    out
}

fn row(name: &str, all: &[Compared<'_>], cell: impl Fn(&Compared<'_>) -> String, end: &str) -> Vec<String> {
    let cells = all.iter().map(cell);
    std::iter::once(name.to_owned()).chain(cells).chain([end.to_owned()]).collect()
}

/// File names; whole paths where two are equal.
fn names(all: &[Compared<'_>]) -> Vec<String> {
    let short = |one: &Compared<'_>| {
        one.path.file_name().unwrap_or(one.path.as_os_str()).to_string_lossy().into_owned()
    };
    let shorts: Vec<String> = all.iter().map(short).collect();
    let twice = |name: &String| shorts.iter().filter(|other| *other == name).count() > 1;
    shorts
        .iter()
        .zip(all)
        .map(|(name, one)| if twice(name) { one.path.display().to_string() } else { name.clone() })
        .collect()
}
