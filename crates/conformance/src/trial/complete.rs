use std::borrow::Cow;

use noisefloor_denoiser::{MethodCard, Need};
use noisefloor_frame::{Counts, Estimate, FeatureId, Frame, Image, Samples, Variance};

use crate::case::SPP;

/// Most samples that a frame is said to have because a method asks for them.
const MOST_SAMPLES: u32 = 1 << 20;

/// The frame with what this method alone asks for and no synthetic scene has: features of other kinds and names where there
/// are any features, and more samples where there is the usual number.
pub(crate) fn completed<'a>(frame: &'a Frame, card: &MethodCard) -> Cow<'a, Frame> {
    let mut frame = Cow::Borrowed(frame);
    for id in features(card) {
        if !frame.features.is_empty() && frame.feature(&id).is_none() && !is_synthetic(&id) {
            let added = like_albedo(&frame, &id);
            frame.to_mut().features.insert(id, added);
        }
    }
    let asked = card.needs.iter().filter_map(|need| match need {
        Need::Samples(n) => Some(*n),
        _ => None,
    });
    let usual = matches!(frame.samples.total(), Counts::Uniform(n) if *n == SPP);
    if let Some(n) = asked.max().filter(|n| usual && (SPP..=MOST_SAMPLES).contains(n)) {
        frame.to_mut().samples = Samples::uniform(n);
    }
    frame
}

/// Features that a card names as needs or in parameters.
fn features(card: &MethodCard) -> Vec<FeatureId> {
    let needed = card.needs.iter().filter_map(|need| match need {
        Need::Feature(id) | Need::FeatureVariance(id) | Need::FeatureHalves(id) => Some(id.clone()),
        _ => None,
    });
    needed.chain(card.named_features.iter().map(|name| FeatureId::from_name(name))).collect()
}

/// Whether synthetic scenes have it: its absence is then meant.
fn is_synthetic(id: &FeatureId) -> bool {
    matches!(id, FeatureId::Albedo | FeatureId::Normal | FeatureId::Depth | FeatureId::Material)
}

/// A feature of this kind with the pattern and the noise of the albedo, or of the colour.
fn like_albedo(frame: &Frame, id: &FeatureId) -> Estimate {
    let source = frame.feature(&FeatureId::Albedo).unwrap_or(&frame.color);
    let channels = id.channel_names().map_or(1, <[_]>::len);
    let of = |image: &Image| {
        Image::from_fn(frame.width(), frame.height(), channels, |c, x, y| {
            image.get(c % image.channels(), x, y)
        })
    };
    Estimate {
        mean: of(&source.mean),
        variance: source.variance.as_ref().map(|v| Variance::of_mean(of(v.mean_variance()))),
        halves: source.halves.as_ref().map(|halves| halves.each_ref().map(of)),
    }
}
