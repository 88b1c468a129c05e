//! Settings under which a method runs on a frame that lacks some of its inputs.

use noisefloor_frame::Frame;

use crate::{Alternative, MethodCard, Need, Setting};

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

#[cfg(test)]
mod tests {
    use noisefloor_frame::{Estimate, FeatureId, Image, Samples, Sampling, Variance};

    use super::*;
    use crate::{Citation, DenoiseError, Input};

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
}
