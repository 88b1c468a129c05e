use std::fmt;

use serde::{Deserialize, Serialize};

/// Something that was found about an input and that a reader of its numbers must know.
///
/// A finding is a record, not a message: it travels with the numbers, from the reader of a file to the terminal, the
/// records of a study, its summary and its report. `Display` is a sentence for people.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// What kind of thing was found.
    pub kind: FindingKind,
    /// What it is about: a file, a layer, or a scene with level and replicate.
    pub subject: String,
    /// The statistic behind it, where there is one; [`FindingKind`] says what it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// How far the statistic is from what it should be, in its standard errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_errors: Option<f64>,
    /// What was found, for people: a clause without the subject, without a full stop.
    pub text: String,
}

impl Finding {
    /// A finding without a statistic.
    #[must_use]
    pub fn new(kind: FindingKind, subject: impl Into<String>, text: impl Into<String>) -> Self {
        Self { kind, subject: subject.into(), value: None, standard_errors: None, text: text.into() }
    }

    /// With its statistic; a value that is not finite is none.
    #[must_use]
    pub fn with_value(self, value: f64) -> Self {
        Self { value: Some(value).filter(|v| v.is_finite()), ..self }
    }

    /// With its size in standard errors; a size that is not finite is none.
    #[must_use]
    pub fn with_standard_errors(self, size: f64) -> Self {
        Self { standard_errors: Some(size).filter(|v| v.is_finite()), ..self }
    }

    /// The same finding about something more exactly named: `prefix: subject`.
    #[must_use]
    pub fn within(self, prefix: &str) -> Self {
        let subject = match self.subject.as_str() {
            "" => prefix.to_owned(),
            subject => format!("{prefix}: {subject}"),
        };
        Self { subject, ..self }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.subject.as_str() {
            "" => f.write_str(&self.text),
            subject => write!(f, "{subject}: {}", self.text),
        }
    }
}

/// Kinds of findings, most serious first within a [`Severity`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum FindingKind {
    /// A frame that contradicts itself or has no image in it: no method ran on it.
    RefusedFrame,
    /// The headers of two inputs that must be independent name the same scene, sampler and random seed.
    SharedSeed,
    /// Two inputs that must be independent hold equal planes.
    EqualData,
    /// Frame and reference do not show the same picture. Value: the fitted ratio of brightness, where there is one.
    DifferentPicture,
    /// The mean of the frame differs from that of the reference. Value: z.
    Brightness,
    /// The errors of frame and reference are correlated. Value: z.
    Dependent,
    /// The stated variance disagrees with the half buffers. Value: stated over shown.
    VarianceAgainstHalves,
    /// The stated variance disagrees with the distance to the reference. Value: stated over shown.
    VarianceAgainstReference,
    /// Zero variance where the half buffers differ. Value: pixels.
    ZeroVariance,
    /// Negative variances, taken as unknown. Value: how many.
    NegativeVariance,
    /// A variance that overflowed the half-precision format of its file. Value: pixels.
    VarianceOverflow,
    /// Variances that are unknown and were filled from neighbours. Value: pixels.
    UnknownVariance,
    /// So many variances are unknown that the frame is taken to have none. Value: pixels.
    VarianceDropped,
    /// Half-buffer values that are unknown and were made up so that the halves still average to the mean. Value: pixels.
    UnknownHalves,
    /// So many values of the half buffers are unknown that the frame is taken to have none. Value: pixels.
    HalvesDropped,
    /// Colours that are not finite and were filled from neighbours or left out. Value: pixels.
    InvalidPixels,
    /// Feature or flash values that are not finite. Value: how many.
    InvalidFeature,
    /// A channel or layer that could not be used and was left out.
    LayerLeftOut,
    /// A layer whose channels have other names than its own, taken for them.
    LayerReadAs,
    /// A layer that no method reads, with the name that it may have been meant to have.
    UnreadLayer,
    /// Values of an output that are not finite. Value: how many.
    NonFiniteOutput,
    /// A kept file or record of a study that is not what was written; what needs it is left out.
    DamagedFile,
}

/// What a finding means for the numbers that are made from the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// The inputs contradict each other: numbers made from them cannot be trusted.
    Contradiction,
    /// Some numbers rest on less than they seem to.
    Limitation,
    /// Good to know.
    Notice,
}

impl FindingKind {
    /// How serious it is.
    #[must_use]
    pub fn severity(self) -> Severity {
        match self {
            Self::RefusedFrame
            | Self::SharedSeed
            | Self::EqualData
            | Self::DifferentPicture
            | Self::Brightness
            | Self::Dependent
            | Self::VarianceAgainstHalves
            | Self::VarianceAgainstReference
            | Self::ZeroVariance => Severity::Contradiction,
            Self::NegativeVariance
            | Self::VarianceOverflow
            | Self::UnknownVariance
            | Self::VarianceDropped
            | Self::UnknownHalves
            | Self::HalvesDropped
            | Self::InvalidPixels
            | Self::NonFiniteOutput
            | Self::DamagedFile
            | Self::InvalidFeature => Severity::Limitation,
            Self::LayerLeftOut | Self::LayerReadAs | Self::UnreadLayer => Severity::Notice,
        }
    }
}

/// Sorts findings with the most serious first and drops repetitions.
#[must_use]
pub fn sorted_findings(findings: impl IntoIterator<Item = Finding>) -> Vec<Finding> {
    let mut out: Vec<Finding> = Vec::new();
    for finding in findings {
        if !out.contains(&finding) {
            out.push(finding);
        }
    }
    // Stable: findings of a kind stay in the order in which they were made.
    out.sort_by_key(|finding| (finding.kind.severity(), finding.kind));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_is_a_sentence_and_a_record() {
        let finding = Finding::new(FindingKind::NegativeVariance, "albedo", "3 variances are below zero")
            .with_value(3.0)
            .with_standard_errors(f64::NAN)
            .within("a.exr");
        assert_eq!(finding.to_string(), "a.exr: albedo: 3 variances are below zero");
        let json = serde_json::to_string(&finding).unwrap();
        assert!(json.contains("\"negative-variance\"") && !json.contains("standard_errors"), "{json}");
        assert_eq!(serde_json::from_str::<Finding>(&json).unwrap(), finding);
    }

    #[test]
    fn the_most_serious_comes_first_and_once() {
        let of = |kind| Finding::new(kind, "a", "b");
        let kinds = [FindingKind::UnreadLayer, FindingKind::SharedSeed, FindingKind::UnreadLayer];
        let found = sorted_findings(kinds.map(of));
        assert_eq!(found, [FindingKind::SharedSeed, FindingKind::UnreadLayer].map(of));
    }
}
