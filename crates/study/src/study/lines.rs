//! Where each part of a study stands in its file, for messages.

use crate::error::Place;
use crate::study::limits::LONGEST_NAME;

/// Where each part of a study stands in its file.
#[derive(Debug, Default)]
pub(super) struct Lines<'a> {
    /// File, or the name of a study that came from no file.
    pub file: String,
    /// Its text; empty if it came from no file.
    pub text: &'a str,
    /// Lines of the scene tables.
    pub scenes: Vec<usize>,
    /// Lines of the comparisons with the source work.
    pub compare: Vec<usize>,
}

impl Lines<'_> {
    pub(super) fn place(&self, line: Option<usize>) -> Place {
        Place { file: self.file.clone(), line }
    }

    /// The line where a table begins, in either notation.
    pub(super) fn of_table(&self, name: &str) -> Option<usize> {
        let header = format!("[{name}]");
        let found = self.text.lines().position(|line| line.trim() == header).map(|index| index + 1);
        found.or_else(|| self.of_key(name))
    }

    /// The first line that sets this key.
    pub(super) fn of_key(&self, key: &str) -> Option<usize> {
        let sets = |line: &str| {
            line.trim_start().strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='))
        };
        self.text.lines().position(sets).map(|index| index + 1)
    }
}

/// For messages; of a long text its beginning.
pub(super) fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("`{}…`", &text[..end]),
        None => format!("`{text}`"),
    }
}
