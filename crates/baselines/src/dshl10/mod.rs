#![doc = include_str!("README.md")]

mod algorithm;
mod params;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use noisefloor_denoiser::{
    Caveat, Citation, Cost, DenoiseError, Denoiser, Entry, Factory, Input, Invariance, MethodCard, Need, Output, ParamError, Parameters, Published, StageTimer,
};
use noisefloor_frame::FeatureId;

use algorithm::filter;
pub use params::{Halving, Params};

const ID: &str = "dshl10";

/// The source work.
pub const CITATION: Citation = Citation::with_entry(
    "dammertz2010",
    "H. Dammertz, D. Sewtz, J. Hanika, H. P. A. Lensch, Edge-Avoiding À-Trous Wavelet Transform for fast Global \
     Illumination Filtering, High Performance Graphics 2010",
    Entry {
        authors: "Holger Dammertz and Daniel Sewtz and Johannes Hanika and Hendrik P. A. Lensch",
        title: "Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering",
        published: Published::Proceedings { name: "High Performance Graphics" },
        year: 2010,
        pages: "",
        doi: "",
    },
);

/// The edge-avoiding à-trous filter: see the module documentation.
#[derive(Debug, Clone, Default)]
pub struct ATrous {
    params: Params,
}

impl ATrous {
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn new(params: Params) -> Result<Self, ParamError> {
        params.check()?;
        Ok(Self { params })
    }
}

/// Factory of [`ATrous`].
#[must_use]
pub fn method() -> Arc<dyn Factory> {
    let summary = "five passes of 5×5 taps with growing gaps, stopped at edges of colour, normal and depth";
    noisefloor_denoiser::method(ID, summary, Some(include_str!("README.md")), ATrous::new)
}

impl Denoiser for ATrous {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(ID, "Edge-avoiding à-trous", CITATION);
        card.needs = vec![Need::Feature(FeatureId::Normal), Need::Feature(FeatureId::Depth)];
        if self.params.demodulate {
            card.needs.push(Need::Feature(FeatureId::Albedo));
        }
        card.cost = Cost::Second;
        card.notes.push("depth in place of position".into());
        if self.params.color_from_level < self.params.levels {
            let width = "the width for the colour is meant at a mean luminance".to_owned();
            card.varies_with.push((Invariance::ChannelOrder, width));
        }
        if self.params.demodulate {
            let noise = "the noise of the albedo is divided out of neighbours and multiplied in".to_owned();
            card.caveats.push((Caveat::Level, noise));
            card.notes.push("albedo below 0.001 counts as that".into());
        }
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        let mut timer = StageTimer::start();
        DenoiseError::refuse(ID, "a value is not finite", &input.target.color.mean, f32::is_finite)?;
        let mut output = Output::from_image(filter(input.target, &self.params));
        timer.finish("filter");
        output.stages = timer.into_stages();
        Ok(output)
    }
}
