use std::borrow::Cow;
use std::fmt::Write as _;

/// Where a method comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Citation {
    /// Short key such as `moon2013flash`.
    pub key: Cow<'static, str>,
    /// Authors, title, venue, year.
    pub text: Cow<'static, str>,
    /// The same for a bibliography; `None` where it is not known in parts.
    pub entry: Option<Entry>,
}

impl Citation {
    /// A source known when the program was written.
    #[must_use]
    pub const fn new(key: &'static str, text: &'static str) -> Self {
        Self { key: Cow::Borrowed(key), text: Cow::Borrowed(text), entry: None }
    }

    /// A source with what a bibliography wants to know of it.
    #[must_use]
    pub const fn with_entry(key: &'static str, text: &'static str, entry: Entry) -> Self {
        Self { key: Cow::Borrowed(key), text: Cow::Borrowed(text), entry: Some(entry) }
    }

    /// The BibTeX entry, in UTF-8; `None` without [`Self::entry`].
    ///
    /// ```
    /// use noisefloor_denoiser::{Citation, Entry, Published};
    ///
    /// let entry = Entry {
    ///     authors: "Ada Lovelace and Charles Babbage",
    ///     title: "Notes & Numbers",
    ///     published: Published::Journal { name: "Memoirs", volume: "3", number: "2" },
    ///     year: 1843,
    ///     pages: "666-731",
    ///     doi: "",
    /// };
    /// let text = Citation::with_entry("lovelace1843", "Notes & Numbers, 1843", entry).bibtex().unwrap();
    /// assert!(text.starts_with("@article{lovelace1843,\n  author = {Ada Lovelace and Charles Babbage},\n"));
    /// assert!(text.contains(r"  title = {{Notes \& Numbers}},") && text.contains("  pages = {666--731},"));
    /// ```
    #[must_use]
    pub fn bibtex(&self) -> Option<String> {
        let entry = self.entry.as_ref()?;
        let (kind, venue) = match &entry.published {
            Published::Journal { name, volume, number } => {
                ("article", vec![("journal", *name), ("volume", *volume), ("number", *number)])
            }
            Published::Proceedings { name } => ("inproceedings", vec![("booktitle", *name)]),
            Published::Otherwise { how } => ("misc", vec![("howpublished", *how)]),
        };
        let pages = entry.pages.replace('-', "--");
        let (year, title) = (entry.year.to_string(), format!("{{{}}}", escaped(entry.title)));
        let mut out = format!("@{kind}{{{},\n", self.key);
        let mut field = |name: &str, value: &str| {
            if !value.is_empty() {
                let _ = writeln!(out, "  {name} = {{{value}}},");
            }
        };
        field("author", &escaped(entry.authors));
        // Twice in braces: capitals stay.
        field("title", &title);
        venue.into_iter().for_each(|(name, value)| field(name, &escaped(value)));
        field("year", &year);
        field("pages", &pages);
        field("doi", entry.doi);
        out.push_str("}\n");
        Some(out)
    }
}

/// What a bibliography holds of a source. Texts that are not known are empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// Names in the order given, joined by ` and `; empty where nobody is named.
    pub authors: &'static str,
    /// Title.
    pub title: &'static str,
    /// Where it appeared.
    pub published: Published,
    /// When.
    pub year: u16,
    /// First and last page, `139-151`.
    pub pages: &'static str,
    /// Digital object identifier, without `https://doi.org/`.
    pub doi: &'static str,
}

/// Where a source appeared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Published {
    /// In a journal.
    Journal {
        /// Its name.
        name: &'static str,
        /// Volume.
        volume: &'static str,
        /// Number in the volume.
        number: &'static str,
    },
    /// In the proceedings of a conference.
    Proceedings {
        /// Their name.
        name: &'static str,
    },
    /// Some other way.
    Otherwise {
        /// Which.
        how: &'static str,
    },
}

impl Entry {
    /// What a complete entry has and this one lacks.
    #[must_use]
    pub fn missing(&self) -> Vec<&'static str> {
        let (venue, journal) = match &self.published {
            Published::Journal { name, volume, .. } => (*name, !volume.is_empty()),
            Published::Proceedings { name } | Published::Otherwise { how: name } => (*name, true),
        };
        // Slides and pages often name nobody.
        let anonymous = matches!(self.published, Published::Otherwise { .. });
        let parts = [
            ("authors", anonymous || !self.authors.is_empty()),
            ("title", !self.title.is_empty()),
            ("venue", !venue.is_empty()),
            ("volume", journal),
            ("year", self.year > 0),
        ];
        parts.into_iter().filter(|(_, there)| !there).map(|(what, _)| what).collect()
    }
}

/// Characters that TeX takes for commands.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if "&%#_$".contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_says_what_it_lacks_and_leaves_out_what_is_empty() {
        let slides = Entry {
            authors: "",
            title: "100 % of $1",
            published: Published::Otherwise { how: "slides" },
            year: 2020,
            pages: "",
            doi: "",
        };
        assert!(slides.missing().is_empty());
        let text = Citation::with_entry("a2020", "", slides).bibtex().unwrap();
        let expected =
            "@misc{a2020,\n  title = {{100 \\% of \\$1}},\n  howpublished = {slides},\n  year = {2020},\n}\n";
        assert_eq!(text, expected);
        let published = Published::Journal { name: "J", volume: "", number: "1" };
        assert_eq!(Entry { published, year: 0, ..slides }.missing(), ["authors", "volume", "year"]);
        assert_eq!(Citation::new("mine", "unpublished").bibtex(), None);
    }
}
