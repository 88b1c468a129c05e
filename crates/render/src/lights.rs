//! Light sources: sampling them, and the density with which a direction that was sampled otherwise would have been.

mod build;
mod emit;
mod sample;
mod source;

pub use build::LightsBuilder;
pub use emit::Ball;
pub use sample::LightSample;
pub use source::{Lights, SunDisc};
