//! The data every other crate speaks: planar images, estimates with their statistics, frames,
//! references, and mergeable running statistics.
//!
//! Words with one meaning each:
//!
//! * **mean**: the noisy pixel value, linear scene-referred radiance, unbounded, per channel.
//! * **variance**: always the variance *of the mean*, see [`Variance`]; the constructors say where
//!   it came from, so that a factor of `n` or 2 cannot be lost.
//! * **half buffers**: means of two disjoint and mutually independent sets of the samples.
//! * **reference**: a high-sample-count estimate from other random numbers, made of independent parts.
//!
//! This crate opens no file, reads no clock and spawns no thread.

mod error;
mod estimate;
mod feature;
mod feature_hit;
mod finding;
mod frame;
mod hygiene;
mod image;
mod inspect;
mod integrator;
mod optional;
mod photons;
mod provenance;
mod reference;
mod running;
mod samples;
mod unit_range;

pub use error::FrameError;
pub use estimate::{Estimate, Variance};
pub use feature::FeatureId;
pub use feature_hit::FeatureHit;
pub use finding::{Finding, FindingKind, Severity, sorted_findings};
pub use frame::{Flash, Frame, Sampling};
pub use hygiene::{Hygiene, MOST_UNKNOWN};
pub use image::{Image, luminance};
pub use inspect::Fidelity;
pub use integrator::Integrator;
pub use optional::{
    Block, BoxCox, BoxCoxMoments, FourParts, Gathered, Gathering, Optional, Row, Statistic,
    TABLE as OPTIONAL_STATISTICS, Tapped, TappedSample,
};
pub use photons::{Maps, PhotonSettings};
pub use provenance::{Camera, PixelFilter, Provenance, RoundsTaken};
pub use reference::{Reference, SquaredError};
pub use running::{BLOCK_SAMPLES, BlockTree, Moments, Partial};
pub use samples::{Counts, Samples};
pub use unit_range::{Far, UnitRange};
