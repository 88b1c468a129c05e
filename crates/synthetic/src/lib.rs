//! Synthetic frames with exactly known truth and a chosen sample law.
//!
//! A [`SyntheticScene`] is a mean image (flats, ramps, edges, texture) and the law that its samples follow.
//! [`SyntheticScene::render`] draws real samples and keeps the statistics a renderer would keep, so that
//! every statistical claim can be tested in seconds against an exact truth ([`SyntheticScene::truth`]).
//!
//! Random numbers come from a counter: the same seed gives the same bits for any number of threads, and a
//! frame of n samples is made of the first n samples of a larger one.
//!
//! [`hard_cases`] are such frames with something broken.
//!
//! ```
//! use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};
//!
//! let scene = SyntheticScene::new(MeanImage::of(ImageKind::Edges), SampleLaw::Exponential, 32, 24)?;
//! let frame = scene.render(16, 1);
//! assert_eq!((frame.width(), frame.height(), frame.samples.at(0)), (32, 24, 16));
//! assert_eq!(scene.truth().mean().get(0, 0, 0), 0.5);
//! # Ok::<(), noisefloor_synthetic::SyntheticError>(())
//! ```

mod broken;
mod classes;
mod error;
mod features;
mod hard;
mod law;
mod mean;
mod random;
mod render;
mod sampled;
mod scene;
mod statistics;

pub use classes::Classes;
pub use error::SyntheticError;
pub use hard::{HardCase, hard_case, hard_cases};
pub use law::SampleLaw;
pub use mean::{ImageKind, MeanImage};
pub use scene::{Guides, SyntheticScene, SyntheticSpec};
