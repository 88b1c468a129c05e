//! What a renderer records for the rows of a study.

use std::collections::BTreeMap;

use noisefloor_denoiser::{MethodCard, Need};
use noisefloor_render::{Keep, Quantity};

/// What a renderer should record so that every row has what it needs and may use.
pub(crate) fn recorded<'a>(cards: impl Iterator<Item = &'a MethodCard>) -> BTreeMap<Quantity, Keep> {
    let mut out = BTreeMap::new();
    let mut add = |quantity: Option<Quantity>, variance: bool, halves: bool| {
        if let Some(quantity) = quantity {
            let keep = out.entry(quantity).or_insert(Keep::MEAN);
            keep.variance |= variance;
            keep.halves |= halves;
        }
    };
    for need in cards.flat_map(|card| card.needs.iter().chain(&card.uses)) {
        match need {
            Need::Feature(id) => add(Quantity::from_name(id.name()), false, false),
            Need::FeatureVariance(id) => add(Quantity::from_name(id.name()), true, false),
            Need::FeatureHalves(id) => add(Quantity::from_name(id.name()), false, true),
            Need::Flash => add(Some(Quantity::Flash), false, false),
            Need::FlashVariance => add(Some(Quantity::Flash), true, false),
            // The colour always comes with variance and halves; samples are the study's business.
            _ => {}
        }
    }
    out
}
