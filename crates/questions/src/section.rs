//! A section as most questions show it.

use noisefloor_study::exhibit::{Chart, Exhibit, Part};

/// Note, charts, then tables under the scenes' names; nothing without a table.
pub(crate) fn section(
    [id, name, title]: [&str; 3],
    note: &str,
    charts: Vec<Chart>,
    tables: Vec<Part>,
) -> Vec<Exhibit> {
    if tables.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![Part::Note(note.into())];
    parts.extend((!charts.is_empty()).then_some(Part::Charts(charts)));
    parts.extend(tables);
    vec![Exhibit { id: id.into(), name: name.into(), title: title.into(), parts }]
}
