#![doc = include_str!("../README.md")]

mod algorithm;
mod blend;
mod card;
mod centres;
mod diagnostics;
mod features;
mod gaussian;
mod guided;
mod method;
mod models;
mod params;
mod settings;
mod tile;

#[cfg(test)]
mod tests;

pub use card::CITATION;
pub use method::{RobustFirstOrder, method};
pub use params::{
    Assembled, ColorPrefilter, ErrorKind, FeaturePrefilter, Fit, KSum, Params, Tiling, VarianceKind,
};

/// What a reader of the method should know: idea, requirements, symbols, deviations, failures, reference; Markdown.
pub const README: &str = include_str!("../README.md");
