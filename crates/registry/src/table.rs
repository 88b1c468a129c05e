use std::fmt::Write;

use noisefloor_denoiser::Entry;
use serde_json::Map;

/// Markdown table of methods: id, what it is, what it needs at its defaults, source.
#[must_use]
pub fn methods_table(entries: &[Entry]) -> String {
    let mut out = String::from("| id | what it is | needs | source |\n| --- | --- | --- | --- |\n");
    for entry in entries {
        // An entry whose defaults do not build is listed all the same, without what only its card knows.
        let card = (entry.build)(&Map::new()).ok().map(|method| method.card());
        let needs = card.as_ref().map_or_else(String::new, |card| {
            card.needs.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
        });
        let needs = if needs.is_empty() { "nothing more".to_owned() } else { needs };
        let source = card.map_or("", |card| card.citation.key);
        line(&mut out, &[&format!("`{}`", entry.id), entry.summary, &needs, source]);
    }
    out
}

/// Markdown table of a method's parameters: name, default, range, purpose. Empty if it takes none.
#[must_use]
pub fn params_table(entry: &Entry) -> String {
    if entry.params.is_empty() {
        return String::new();
    }
    let defaults = (entry.defaults)();
    let mut out = String::from("| parameter | default | range | what it does |\n| --- | --- | --- | --- |\n");
    for param in entry.params {
        let default = defaults.get(param.name).map_or_else(String::new, ToString::to_string);
        line(&mut out, &[&format!("`{}`", param.name), &default, param.range, param.about]);
    }
    out
}

/// One row; a vertical bar inside a cell is escaped.
fn line(out: &mut String, cells: &[&str]) {
    for cell in cells {
        // Writing to a string cannot fail.
        let _ = write!(out, "| {} ", cell.replace('|', "\\|"));
    }
    out.push_str("|\n");
}
