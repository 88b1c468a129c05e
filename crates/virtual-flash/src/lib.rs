#![doc = include_str!("../README.md")]

mod card;
mod diagnostics;
mod flash;
mod guide;
mod method;
mod params;
mod spread;
mod tolerance;

#[cfg(test)]
mod tests;

pub use card::CITATION;
pub use method::{ENTRY, VirtualFlash};
pub use params::{GuideKind, Params, SpreadKind, TestKind};
