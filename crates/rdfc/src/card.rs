//! What the method needs and what may be said of it.

use noisefloor_denoiser::{Citation, Cost, Entry, MethodCard, Need, Published, Role};
use noisefloor_frame::FeatureId;

use crate::params::Profile;
use crate::selection::Choice;
use crate::settings::Settings;
use crate::{Params, SecondPass};

/// The source work.
pub const CITATION: Citation = Citation::with_entry(
    "rousselle2013rdfc",
    "F. Rousselle, M. Manzi, M. Zwicker, Robust Denoising using Feature and Color Information, Computer Graphics \
           Forum 32(7), 2013",
    Entry {
        authors: "Fabrice Rousselle and Marco Manzi and Matthias Zwicker",
        title: "Robust Denoising using Feature and Color Information",
        published: Published::Journal { name: "Computer Graphics Forum", volume: "32", number: "7" },
        year: 2013,
        pages: "121-130",
        doi: "10.1111/cgf.12219",
    },
);

pub(crate) fn card(id: &str, only: Option<Choice>, params: &Params) -> MethodCard {
    let mut name = String::from(match only {
        None => "Robust denoising from features and colour",
        Some(Choice::First) => "FIRST candidate: colour, small patches",
        Some(Choice::Second) => "SECOND candidate: colour, large patches",
        Some(Choice::Third) => "THIRD candidate: features alone",
    });
    name.push_str(match params.profile {
        Profile::Paper => ", as printed",
        Profile::Authors => ", the authors' program",
        Profile::Best => "",
    });
    let mut card = MethodCard::new(id, name, CITATION);
    card.cost = Cost::TenSeconds;
    if only.is_some() {
        card.role = Role::Part;
        card.unbiased_estimate = true;
    }
    card.needs = vec![Need::ColorVariance, Need::ColorHalves, Need::Samples(2)];
    for name in &params.features {
        card.uses.push(Need::Feature(FeatureId::from_name(name)));
        card.uses.push(Need::FeatureVariance(FeatureId::from_name(name)));
        card.uses.push(Need::FeatureHalves(FeatureId::from_name(name)));
    }
    card.named_features.clone_from(&params.features);
    card.neighbors = params.neighbors;
    card.claims.estimates_error = true;
    card.notes = vec![
        "no bound is claimed; the error estimate is unbiased for normal noise of known variance and a fixed filter, elsewhere \
         it is as good as measured"
            .into(),
    ];
    if only.is_none() && Settings::new(params).second_pass != SecondPass::Off {
        card.notes.push("the error estimate is that of the combination, before the second pass".into());
    }
    card
}
