//! What may stand in for an input that a frame lacks, and why it lacks it.

use std::borrow::Cow;
use std::fmt;

use noisefloor_frame::{FeatureId, Finding, FindingKind, Frame};
use serde_json::Value;

use crate::{DenoiseError, MethodCard, Need};

/// A parameter with a value, as a study or a command line sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Name of the parameter.
    pub parameter: Cow<'static, str>,
    /// Value.
    pub value: Value,
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            Value::String(word) => write!(f, "{}={word}", self.parameter),
            value => write!(f, "{}={value}", self.parameter),
        }
    }
}

/// A setting under which a method does without some of its needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// The setting.
    pub setting: Setting,
    /// Needs that it takes away.
    pub lifts: Vec<Need>,
    /// Needs that it brings.
    pub asks: Vec<Need>,
}

impl Alternative {
    /// A setting that takes needs away and brings none.
    #[must_use]
    pub fn new(
        parameter: impl Into<Cow<'static, str>>,
        value: impl Into<Value>,
        lifts: impl Into<Vec<Need>>,
    ) -> Self {
        let setting = Setting { parameter: parameter.into(), value: value.into() };
        Self { setting, lifts: lifts.into(), asks: Vec::new() }
    }

    /// The same with needs of its own.
    #[must_use]
    pub fn asking(self, asks: impl Into<Vec<Need>>) -> Self {
        Self { asks: asks.into(), ..self }
    }
}

impl MethodCard {
    /// Settings, each sufficient, under which the method would run on a frame that lacks some of its needs. Empty if
    /// nothing is missing or nothing helps.
    #[must_use]
    pub fn ways_out(&self, frame: &Frame) -> Vec<Vec<Setting>> {
        self.ways_out_where(|need| need.is_met(frame))
    }

    /// As [`MethodCard::ways_out`], where `met` says which needs are.
    #[must_use]
    pub fn ways_out_where(&self, met: impl Fn(&Need) -> bool) -> Vec<Vec<Setting>> {
        let missing: Vec<Need> = self.needs.iter().filter(|need| !met(need)).cloned().collect();
        let usable = || {
            let helps = |a: &&Alternative| a.asks.iter().all(&met);
            self.alternatives.iter().filter(helps)
        };
        let lifts = |a: &Alternative, needs: &[Need]| needs.iter().all(|need| a.lifts.contains(need));
        if missing.is_empty() {
            return Vec::new();
        }
        let alone: Vec<Vec<Setting>> =
            usable().filter(|a| lifts(a, &missing)).map(|a| vec![a.setting.clone()]).collect();
        if !alone.is_empty() {
            return alone;
        }
        // Several together: the first that helps for each need.
        let mut together: Vec<&Alternative> = Vec::new();
        for need in &missing {
            let covered = together.iter().any(|a| a.lifts.contains(need));
            match usable().find(|a| a.lifts.contains(need)) {
                _ if covered => {}
                Some(alternative) => together.push(alternative),
                None => return Vec::new(),
            }
        }
        vec![together.into_iter().map(|a| a.setting.clone()).collect()]
    }
}

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
        Need::Samples(_) | Need::IndependentSamples => return false,
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
    use noisefloor_frame::{Estimate, Image, Samples, Sampling, Variance};

    use super::*;
    use crate::{Citation, Input};

    fn frame(variance: bool) -> Frame {
        let mean = Image::new(4, 3, 3);
        let variance = variance.then(|| Variance::of_mean(mean.clone()));
        let color = Estimate { mean, variance, halves: None };
        Frame::from_color(color, Samples::uniform(4), Sampling::Independent)
    }

    fn card(needs: &[Need]) -> MethodCard {
        let mut card = MethodCard::new("needy", "Needy", Citation::new("none", "none"));
        card.needs = needs.to_vec();
        card.alternatives = vec![
            Alternative::new("guide", "color", [Need::Flash]).asking([Need::ColorVariance]),
            Alternative::new("guide", "none", [Need::Flash]),
            Alternative::new("ids", false, [Need::Feature(FeatureId::Material)]),
        ];
        card
    }

    fn ways(frame: &Frame, needs: &[Need]) -> Vec<String> {
        let words = |way: Vec<Setting>| way.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        card(needs).ways_out(frame).into_iter().map(words).collect()
    }

    #[test]
    fn ways_out_are_the_settings_that_suffice_on_this_frame() {
        let material = Need::Feature(FeatureId::Material);
        assert_eq!(ways(&frame(true), &[Need::Flash]), ["guide=color", "guide=none"]);
        assert_eq!(ways(&frame(false), &[Need::Flash]), ["guide=none"], "the other asks for a variance");
        assert_eq!(ways(&frame(true), &[Need::Flash, material.clone()]), ["guide=color ids=false"]);
        assert_eq!(
            ways(&frame(true), &[Need::Flash, Need::ColorHalves]),
            [""; 0],
            "nothing lifts the halves"
        );
        assert_eq!(ways(&frame(true), &[]), [""; 0]);
        let frame = frame(true);
        let error = Input::new(&frame).check(&card(&[material])).unwrap_err();
        assert_eq!(error.to_string(), "needy needs feature `material`; it does without with ids=false");
    }

    #[test]
    fn a_named_feature_must_mean_something_or_be_there() {
        let mut frame = frame(true);
        let mut card = card(&[]);
        card.named_features = vec!["albedo".into(), "curvature".into()];
        let error = Input::new(&frame).check(&card).unwrap_err();
        assert!(matches!(&error, DenoiseError::UnknownFeature { feature, .. } if feature == "curvature"));
        frame.features.insert(FeatureId::Extra("curvature".into()), Estimate::from_mean(Image::new(4, 3, 1)));
        assert_eq!(Input::new(&frame).check(&card), Ok(()));
        card.named_features = vec!["Albedo".into()];
        let error = Input::new(&frame).check(&card).unwrap_err().to_string();
        assert!(error.starts_with("needy: there is no feature `Albedo`; nearest: albedo"), "{error}");
    }

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
