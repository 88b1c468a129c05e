use std::sync::Arc;

use crate::{
    Citation, Cost, DenoiseError, Denoiser, Entry, Factory, Input, MethodCard, Output, Published, method,
    parameters,
};

/// Plain Monte Carlo: returns the noisy mean itself. The baseline of every plot.
#[derive(Debug, Clone, Copy, Default)]
pub struct MonteCarlo;

parameters! {
    /// Of methods that take none.
    pub struct NoParams {}
}

/// The source of plain Monte Carlo.
const CITATION: Citation = Citation::with_entry(
    "kajiya1986",
    "J. T. Kajiya, The rendering equation, SIGGRAPH 1986",
    Entry {
        authors: "James T. Kajiya",
        title: "The Rendering Equation",
        published: Published::Proceedings { name: "Proceedings of SIGGRAPH '86" },
        year: 1986,
        pages: "143-150",
        doi: "10.1145/15922.15902",
    },
);

/// Factory of [`MonteCarlo`].
#[must_use]
pub fn mc() -> Arc<dyn Factory> {
    let summary = "plain Monte Carlo: the noisy input itself, every plot's baseline";
    method("mc", summary, None, |_: NoParams| Ok(MonteCarlo))
}

impl Denoiser for MonteCarlo {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new("mc", "Monte Carlo (input)", CITATION);
        card.claims.consistent = true;
        card.cost = Cost::None;
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        Ok(Output::from_image(input.target.color.mean.clone()))
    }
}
