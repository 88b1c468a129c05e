#![doc = include_str!("../README.md")]

mod buffer;
mod denoiser;
mod params;
mod process;
mod template;
mod version;

pub use denoiser::{Command, command};
pub use params::Params;

/// How to bring a program: Markdown.
pub const README: &str = include_str!("../README.md");
