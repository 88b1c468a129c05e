//! What a README asks for, and what it gets.

use std::collections::BTreeMap;

use noisefloor_study::exhibit::Table;

/// What a README asks for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Asked {
    /// Kind of table, such as `levels`.
    pub kind: String,
    /// What is chosen of the study.
    pub keys: BTreeMap<String, String>,
}

impl Asked {
    /// The value of a key, split at `;` and trimmed; empty without the key.
    #[must_use]
    pub fn list(&self, key: &str) -> Vec<&str> {
        self.keys.get(key).map_or_else(Vec::new, |text| text.split(';').map(str::trim).collect())
    }
}

/// A piece of a README; texts, also those of cells, are Markdown.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A paragraph or a list.
    Text(String),
    /// A table.
    Table(Table),
}
