//! What the method needs and what may be said of it.

use noisefloor_denoiser::{Alternative, Citation, Cost, Entry, MethodCard, Need, Published};
use noisefloor_frame::FeatureId;

use crate::{Params, VarianceKind};

/// Its id.
pub(crate) const ID: &str = "robust-first-order";

/// The source work.
pub const CITATION: Citation = Citation::with_entry(
    "liu2018robust",
    "Y. Liu, C. Zheng, H. Yuan, Denoising Monte Carlo Renderings based on a Robust High-order Function, 13th International Joint \
     Conference on Computer Vision, Imaging and Computer Graphics Theory and Applications (GRAPP), 2018",
    Entry {
        authors: "Yu Liu and Changwen Zheng and Hongliang Yuan",
        title: "Denoising Monte Carlo Renderings based on a Robust High-order Function",
        published: Published::Proceedings {
            name: "13th International Joint Conference on Computer Vision, Imaging and Computer Graphics Theory and \
                   Applications, volume 1: GRAPP",
        },
        year: 2018,
        pages: "288-294",
        doi: "10.5220/0006650602880294",
    },
);

/// Features that it takes, where they are there.
pub(crate) const FEATURES: [FeatureId; 3] = [FeatureId::Depth, FeatureId::Normal, FeatureId::Albedo];

pub(crate) fn card(params: &Params) -> MethodCard {
    let mut card = MethodCard::new(ID, "First-order models at few centres", CITATION);
    card.cost = Cost::TenSeconds;
    card.needs = vec![Need::ColorVariance, Need::Samples(2)];
    if params.variance == VarianceKind::Residual {
        card.needs.push(Need::ColorHalves);
        card.alternatives = vec![Alternative::new("variance", "raw", [Need::ColorHalves])];
    }
    for feature in FEATURES {
        card.uses.push(Need::Feature(feature.clone()));
        card.uses.push(Need::FeatureVariance(feature));
    }
    card.claims.estimates_error = true;
    card.notes = vec![
        "no bound is claimed; the error estimate is of the image refitted from the prefiltered colour, whose bias it does not see"
            .into(),
        "meant for depth, normal and albedo; with fewer features its models are positions alone".into(),
        "fine caustics that are in no feature are blurred, at 64 samples to more than the input's error; in plain MSE glints are too"
            .into(),
    ];
    if params.coverage == 0.0 {
        card.notes.push(
            "models predict pixels that they do not look like, as printed: the image is often useless".into(),
        );
    }
    card
}
