//! Names of the files that tables and charts are written to.

use std::collections::BTreeSet;

use noisefloor_study::exhibit::Document;

/// Endings of a table's files.
pub(crate) const TABLE_ENDINGS: [&str; 4] = ["csv", "json", "tex", "md"];

/// Names of the files of a document's tables, in the order of [`Document::tables`].
pub(crate) fn table_names(document: &Document) -> Vec<String> {
    let mut taken = BTreeSet::new();
    document.tables().iter().map(|table| free_name(&table.id, &mut taken)).collect()
}

/// An id as the name of a file: letters, digits, `-`, `_` and `.` inside, and taken by nothing else.
pub(crate) fn free_name(id: &str, taken: &mut BTreeSet<String>) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let name: String = id.chars().map(plain).take(120).collect();
    // No hidden file, no folder above.
    let name = match name.trim_start_matches('.') {
        "" => "unnamed".to_owned(),
        name => name.to_owned(),
    };
    let numbered = (2..).map(|n| format!("{name}-{n}"));
    let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
    let free = free.unwrap_or(name);
    taken.insert(free.clone());
    free
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_id_becomes_a_name_of_its_own_inside_the_folder() {
        let mut taken = BTreeSet::new();
        let names =
            ["cells-4", "cells-4", "../../etc/passwd", "", "ä b", ".."].map(|id| free_name(id, &mut taken));
        assert_eq!(names, ["cells-4", "cells-4-2", "-..-etc-passwd", "unnamed", "--b", "unnamed-2"]);
    }
}
