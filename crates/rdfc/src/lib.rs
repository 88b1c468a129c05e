#![doc = include_str!("../README.md")]

mod algorithm;
mod candidates;
mod card;
mod density;
mod diagnostics;
mod features;
mod first_pass;
mod kernel;
mod method;
mod params;
mod prepare;
mod second_pass;
mod selection;
mod settings;
mod sure;

#[cfg(test)]
mod tests;

pub use card::CITATION;
pub use method::{Rdfc, methods};
pub use params::{
    CenterWeight, ColorDenominator, Density, DepthRange, DerivativeRule, FeatureDenominator, Gradient,
    Params, PatchTaps, Profile, SecondPass, Ties, VarianceScaling, WindowBorder,
};
pub use selection::{Choice, select};

/// What a reader of the method should know: idea, requirements, symbols, deviations, failures, reference; Markdown.
pub const README: &str = include_str!("../README.md");
