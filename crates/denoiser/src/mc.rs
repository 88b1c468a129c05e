use serde::{Deserialize, Serialize};

use crate::{Citation, DenoiseError, Denoiser, Entry, Input, MethodCard, Output, build_with};

/// Plain Monte Carlo: returns the noisy mean itself. The baseline of every plot.
#[derive(Debug, Clone, Copy, Default)]
pub struct MonteCarlo;

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct NoParams {}

/// Registry entry of [`MonteCarlo`].
pub const MC_ENTRY: Entry = Entry {
    id: "mc",
    summary: "plain Monte Carlo: the noisy input itself, every plot's baseline",
    params: &[],
    defaults: || serde_json::Value::Object(serde_json::Map::new()),
    build: |overrides| build_with("mc", &[], overrides, |_: NoParams| Ok(MonteCarlo)),
};

impl Denoiser for MonteCarlo {
    fn card(&self) -> MethodCard {
        let mut card = MethodCard::new(
            "mc",
            "Monte Carlo (input)",
            Citation { key: "kajiya1986", text: "J. T. Kajiya, The rendering equation, SIGGRAPH 1986" },
        );
        card.claims.consistent = true;
        card
    }

    fn denoise(&self, input: &Input<'_>) -> Result<Output, DenoiseError> {
        input.check(&self.card())?;
        Ok(Output::from_image(input.target.color.mean.clone()))
    }
}
