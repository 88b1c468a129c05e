#![doc = include_str!("../README.md")]

mod algorithm;
mod card;
mod diagnostics;
mod filter;
mod flash;
mod guide;
mod method;
mod params;
mod spread;
mod tolerance;
mod volume;

#[cfg(test)]
mod tests;

pub use card::CITATION;
pub use method::{VirtualFlash, virtual_flash};
pub use params::{GuideKind, Params, SpreadKind, TestKind};

/// What a reader of the method should know: idea, requirements, symbols, deviations, failures, reference; Markdown.
pub const README: &str = include_str!("../README.md");
