//! What a reader must know before the numbers.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Kinds of warnings, most serious first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum WarningKind {
    /// An output left an interval that its method claims never to leave.
    Enclosure,
    /// Rows that ended in an error.
    Failed,
    /// Nobody knows how many cells the study asks for.
    UnknownPlan,
    /// There are more replicates than when the study was looked at before.
    Looked,
    /// Rows that take no part in the ranking.
    NotRanked,
    /// No row is plain Monte Carlo.
    NoBaseline,
    /// A row claims an estimate of its error and gave none.
    NoEstimate,
    /// The reference has few samples, or an unknown number of them.
    ShortReference,
    /// Coverage and bounds mean nothing on these frames, or could not be counted.
    NoIntervals,
    /// One replicate per level.
    OneReplicate,
    /// Input pixels that are no numbers, or errors over fewer pixels than the image has.
    FewerPixels,
    /// Plain Monte Carlo does not obey its law.
    Law,
    /// Times say nothing.
    Times,
    /// Something that takes images could not be measured.
    NotMeasured,
    /// Rows come from several builds of the program.
    Builds,
    /// Of an earlier program, which kept the sentence alone.
    Other,
}

/// A statement that a reader must see first.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Kept")]
pub struct Warning {
    /// What kind it is.
    pub kind: WarningKind,
    /// Scene, row or sequence that it is about; empty if it is about the study.
    pub subject: String,
    /// The statement, without the subject.
    pub text: String,
}

/// As it is on disk; earlier programs wrote the sentence alone.
#[derive(Deserialize)]
#[serde(untagged)]
enum Kept {
    Sentence(String),
    Warning { kind: WarningKind, subject: String, text: String },
}

impl From<Kept> for Warning {
    fn from(kept: Kept) -> Self {
        match kept {
            Kept::Sentence(text) => Self { kind: WarningKind::Other, subject: String::new(), text },
            Kept::Warning { kind, subject, text } => Self { kind, subject, text },
        }
    }
}

impl Warning {
    /// About the whole study.
    #[must_use]
    pub fn new(kind: WarningKind, text: impl Into<String>) -> Self {
        Self { kind, subject: String::new(), text: text.into() }
    }

    /// About a scene, a row or a sequence.
    #[must_use]
    pub fn about(kind: WarningKind, subject: impl Into<String>, text: impl Into<String>) -> Self {
        Self { kind, subject: subject.into(), text: text.into() }
    }

    /// Those that say the same of several subjects, as one; in the order in which they come.
    #[must_use]
    pub fn merged(warnings: &[Self]) -> Vec<(Vec<&str>, &Self)> {
        let mut groups: Vec<(Vec<&str>, &Self)> = Vec::new();
        for warning in warnings {
            let same = |(subjects, known): &&mut (Vec<&str>, &Self)| {
                !warning.subject.is_empty() && !subjects.is_empty() && known.text == warning.text
            };
            match groups.iter_mut().find(same) {
                Some((subjects, _)) => subjects.push(&warning.subject),
                None if warning.subject.is_empty() => groups.push((Vec::new(), warning)),
                None => groups.push((vec![&warning.subject], warning)),
            }
        }
        groups
    }
}

/// `subject: text`.
impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.subject.as_str() {
            "" => f.write_str(&self.text),
            subject => write!(f, "{subject}: {}", self.text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_warning_for_three_scenes_is_one() {
        let about = |subject: &str, text: &str| Warning::about(WarningKind::ShortReference, subject, text);
        let given = [about("a", "short"), about("", "alone"), about("b", "short"), about("b", "long")];
        let merged: Vec<(Vec<&str>, &str)> =
            Warning::merged(&given).into_iter().map(|(of, w)| (of, w.text.as_str())).collect();
        assert_eq!(merged, [(vec!["a", "b"], "short"), (vec![], "alone"), (vec!["b"], "long")]);
    }

    #[test]
    fn sentences_of_earlier_programs_are_read() {
        let old: Warning = serde_json::from_str("\"a: the reference is short\"").unwrap();
        assert_eq!((old.kind, old.to_string().as_str()), (WarningKind::Other, "a: the reference is short"));
        let new = Warning::about(WarningKind::Law, "a", "b");
        let text = serde_json::to_string(&new).unwrap();
        assert_eq!(serde_json::from_str::<Warning>(&text).unwrap(), new);
        assert_eq!(new.to_string(), "a: b");
    }
}
