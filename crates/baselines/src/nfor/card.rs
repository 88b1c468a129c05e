//! What the method needs and what may be said of it.

use noisefloor_denoiser::{Caveat, Citation, Cost, Entry, Invariance, MethodCard, Need, Published};
use noisefloor_frame::FeatureId;

use super::params::{Depth, Exposure, Params, Profile};
use super::settings::Settings;

/// Stable id.
pub(super) const ID: &str = "nfor";

/// The source work.
pub const CITATION: Citation = Citation::with_entry(
    "bitterli2016",
    "B. Bitterli, F. Rousselle, B. Moon, J. A. Iglesias-Guitián, D. Adler, K. Mitchell, W. Jarosz, J. Novák, Nonlinearly \
     Weighted First-order Regression for Denoising Monte Carlo Renderings, Computer Graphics Forum 35(4), 2016",
    Entry {
        authors: "Benedikt Bitterli and Fabrice Rousselle and Bochang Moon and José A. Iglesias-Guitián and David Adler and \
                  Kenny Mitchell and Wojciech Jarosz and Jan Novák",
        title: "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings",
        published: Published::Journal { name: "Computer Graphics Forum", volume: "35", number: "4" },
        year: 2016,
        pages: "107-117",
        doi: "10.1111/cgf.12954",
    },
);

pub(super) fn card(params: &Params, settings: &Settings) -> MethodCard {
    let name = match params.profile {
        Profile::Program => "Nonlinearly weighted first-order regression",
        Profile::Paper => "Nonlinearly weighted first-order regression, the pseudo-code",
        Profile::Best => "Nonlinearly weighted first-order regression, by measurement",
    };
    let mut card = MethodCard::new(ID, name, CITATION);
    card.cost = Cost::TenSeconds;
    card.needs = vec![Need::ColorVariance, Need::ColorHalves, Need::Samples(2)];
    for name in &params.features {
        let id = || FeatureId::from_name(name);
        card.uses.extend([Need::Feature(id()), Need::FeatureVariance(id()), Need::FeatureHalves(id())]);
    }
    card.named_features.clone_from(&params.features);
    card.claims.estimates_error = true;
    if settings.exposure == Exposure::AsIs {
        let epsilon = "1e-7 is added to variances whatever the exposure: at a thousandth of the light the error was 2.0 and \
                       2.5 times as large on two frames";
        card.varies_with.push((Invariance::Exposure, epsilon.into()));
    }
    if settings.depth == Depth::Raw && params.features.iter().any(|name| name == FeatureId::Depth.name()) {
        let units = "1e-7 is added to variances of depth, and columns whose norm falls below 1.2e-7 of the largest are dropped, in its unit";
        card.varies_with.push((Invariance::FeatureUnits, units.into()));
    }
    let light = "models of windows with a spike predict its surroundings by unequal weights: one sample of a million times the \
                 others leaves a small frame with 3 % more";
    card.caveats.push((Caveat::Light, light.into()));
    card.notes.push("the error estimate is that of the image before the last regression".into());
    card
}
