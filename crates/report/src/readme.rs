//! Tables of a study inside a README: what stands between two markers is made from the study.
//!
//! `<!-- noisefloor:table KIND key=value … -->` begins a block and `<!-- /noisefloor -->` ends it. Kinds and keys are
//! known to who makes tables; a value with spaces stands in double quotes. Everything outside is the author's.

use std::collections::{BTreeMap, BTreeSet};

use noisefloor_study::exhibit::Document;

use crate::error::ReportError;

const START: &str = "<!-- noisefloor:";
const END: &str = "<!-- /noisefloor -->";

/// A marker's words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Directive {
    /// `table` or `panel`.
    pub verb: String,
    /// What follows without a key.
    pub kind: String,
    /// Keys with their values.
    pub keys: BTreeMap<String, String>,
}

impl Directive {
    /// The value of a key, split at `;` and trimmed; empty without the key.
    #[must_use]
    pub fn list(&self, key: &str) -> Vec<&str> {
        self.keys.get(key).map_or_else(Vec::new, |text| text.split(';').map(str::trim).collect())
    }

    /// Reads what stands in a marker behind `noisefloor:`.
    ///
    /// # Errors
    /// A clause for people if a quote is not closed or a second word has no key.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut words = words(text)?.into_iter();
        let verb = words.next().unwrap_or_default();
        let mut out = Self { verb, kind: String::new(), keys: BTreeMap::new() };
        for word in words {
            match word.split_once('=') {
                Some((key, value)) => {
                    out.keys.insert(key.to_owned(), value.to_owned());
                }
                None if out.kind.is_empty() => out.kind = word,
                None => return Err(format!("`{word}` is neither the kind nor a key")),
            }
        }
        Ok(out)
    }
}

/// Words at spaces; double quotes hold one together.
fn words(text: &str) -> Result<Vec<String>, String> {
    let (mut out, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for c in text.trim().chars() {
        match c {
            '"' => quoted = !quoted,
            c if c.is_whitespace() && !quoted => {
                if !word.is_empty() {
                    out.push(std::mem::take(&mut word));
                }
            }
            c => word.push(c),
        }
    }
    if quoted {
        return Err("a double quote is not closed".into());
    }
    out.extend((!word.is_empty()).then_some(word));
    Ok(out)
}

/// The README with every block made anew; `make` gives nothing to leave one as it is.
pub(crate) fn spliced(
    readme: &str,
    mut make: impl FnMut(&Directive) -> Result<Option<String>, String>,
) -> Result<String, ReportError> {
    let mut out = String::with_capacity(readme.len());
    let mut rest = readme;
    while let Some(at) = rest.find(START) {
        let line = || readme[..readme.len() - rest.len() + at].matches('\n').count() + 1;
        let wrong = |message: String| ReportError::Readme { line: line(), message };
        let (head, marked) = (&rest[..at], &rest[at + START.len()..]);
        let (text, body) = marked.split_once("-->").ok_or_else(|| wrong("the marker has no end".into()))?;
        let (old, after) = body.split_once(END).ok_or_else(|| wrong(format!("no `{END}` follows")))?;
        if old.contains(START) {
            return Err(wrong(format!("another marker comes before `{END}`")));
        }
        let directive = Directive::parse(text).map_err(wrong)?;
        let made = make(&directive).map_err(wrong)?;
        out.push_str(head);
        out.push_str(&rest[at..at + START.len() + text.len() + "-->".len()]);
        match made {
            Some(made) => out.push_str(&format!("\n{}\n", made.trim_end())),
            None => out.push_str(old),
        }
        out.push_str(END);
        rest = after;
    }
    out.push_str(rest);
    Ok(out)
}

/// Names of the plots that a README shows: of `plots/NAME.svg`.
pub(crate) fn embedded_plots(readme: &str) -> BTreeSet<String> {
    let names = readme.split("plots/").skip(1).filter_map(|rest| rest.split_once(".svg"));
    let plain = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    names.map(|(name, _)| name).filter(|name| plain(name)).map(str::to_owned).collect()
}

/// A README to begin with.
pub(crate) fn skeleton(document: &Document) -> String {
    let block = |kind: &str| format!("{START}table {kind} -->\n{END}\n");
    format!(
        "# {}\n\n{}\n\n```sh\n{}\n```\n\n{}\n{}\n{}",
        document.title,
        document.question,
        document.command,
        block("answers"),
        block("methods"),
        block("machine")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marker_has_a_kind_and_keys() {
        let directive = Directive::parse(" table levels metric=rmse rows=\"a b; c=1\" ").unwrap();
        assert_eq!((directive.verb.as_str(), directive.kind.as_str()), ("table", "levels"));
        assert_eq!(directive.list("rows"), ["a b", "c=1"]);
        assert!(directive.list("spp").is_empty());
        assert!(Directive::parse("table a b").is_err() && Directive::parse("table \"a").is_err());
    }

    #[test]
    fn embedded_plots_are_found_by_their_path() {
        let readme = "![a](plots/one-two.svg) text plots/ and (plots/x y.svg) ![](plots/three_mse.svg)";
        assert_eq!(embedded_plots(readme).into_iter().collect::<Vec<_>>(), ["one-two", "three_mse"]);
    }
}
