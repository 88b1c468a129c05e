//! Why a frame lacks an input.

use noisefloor_frame::{FeatureId, Finding, FindingKind};

use crate::{DenoiseError, Need};

impl DenoiseError {
    /// Those of the findings about a frame that say why it lacks what the method needs.
    #[must_use]
    pub fn because<'a>(&self, findings: &'a [Finding]) -> Vec<&'a Finding> {
        let Self::MissingInputs { missing, .. } = self else { return Vec::new() };
        findings.iter().filter(|finding| missing.iter().any(|need| explains(finding, need))).collect()
    }
}

/// Whether a finding is about the layer of a need and says that it, or a statistic of it, was taken away.
fn explains(finding: &Finding, need: &Need) -> bool {
    let layer = finding.subject.split('.').next().unwrap_or_default();
    let name = match need {
        Need::ColorVariance | Need::ColorHalves => "color",
        Need::Feature(id) | Need::FeatureVariance(id) | Need::FeatureHalves(id) => FeatureId::name(id),
        Need::Flash | Need::FlashVariance => "flash",
        Need::Samples(_) | Need::IndependentSamples | Need::ThirdMoment | Need::Extremes => return false,
    };
    let same = match name {
        "color" => ["", "color"].contains(&layer),
        "flash" => layer.starts_with("flash"),
        name => layer == name,
    };
    match finding.kind {
        FindingKind::VarianceDropped => {
            same && matches!(need, Need::ColorVariance | Need::FeatureVariance(_) | Need::FlashVariance)
        }
        FindingKind::HalvesDropped => same && matches!(need, Need::ColorHalves | Need::FeatureHalves(_)),
        FindingKind::InvalidFeature | FindingKind::LayerLeftOut => same,
        FindingKind::UnreadLayer => {
            let pointed = |name: &str| finding.text.contains(&format!("`{name}`"));
            match need {
                Need::ColorVariance => pointed("variance"),
                Need::ColorHalves => pointed("halfA") || pointed("halfB"),
                _ => pointed(name),
            }
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_is_explained_by_what_was_taken_away() {
        let of = |kind, subject| Finding::new(kind, subject, "told");
        let findings = [
            of(FindingKind::VarianceDropped, ""),
            of(FindingKind::VarianceDropped, "albedo"),
            of(FindingKind::InvalidFeature, "flashLight"),
            of(FindingKind::LayerLeftOut, "normal.variance"),
        ];
        let because = |need| {
            let error =
                DenoiseError::MissingInputs { method: "m".into(), missing: vec![need], ways_out: vec![] };
            error.because(&findings).into_iter().map(|f| f.subject.as_str()).collect::<Vec<_>>()
        };
        assert_eq!(because(Need::ColorVariance), [""]);
        assert_eq!(because(Need::FeatureVariance(FeatureId::Albedo)), ["albedo"]);
        assert_eq!(because(Need::Flash), ["flashLight"]);
        assert_eq!(because(Need::FeatureVariance(FeatureId::Normal)), ["normal.variance"]);
        assert_eq!(because(Need::ColorHalves), [""; 0]);
    }
}
