//! Checks of inputs against each other: does a frame show the same picture as its reference, is its stated variance the
//! one that its distance to the reference shows, and are frames, reference and parts drawn from different random
//! numbers?
//!
//! Numbers in, [`Finding`](noisefloor_frame::Finding)s out: no files, no printing. Everything is one pass over the
//! image, deterministic, and the same for any number of threads.
//!
//! | question | file |
//! | --- | --- |
//! | Do headers prove that two inputs share random numbers? | [`shared_seed`] |
//! | Do two inputs hold equal planes? | [`Planes`] |
//! | Is the mean of a frame that of the reference? | `brightness.rs` |
//! | Is the variance that which the distance to the reference shows? | `variance.rs` |
//! | Are the errors of frame and reference independent? | `dependence.rs` |
//! | Is it the same picture at all, and if not, what makes it fit? | `picture.rs` |
//! | Are the frames of a scene independent of each other? | [`among`] |
//!
//! Single tests alarm at [`ALPHA`], so that a study of a thousand of them raises a false alarm in one of a thousand runs.
//! A test that cannot tell says so ([`Brightness::TooFew`]) instead of staying silent for a good reason and a bad one
//! alike.

mod against;
mod among;
mod blocks;
mod brightness;
mod dependence;
mod equal;
mod picture;
mod seeds;
mod sketch;
mod sums;
mod variance;

pub use against::{Against, FrameCheck, Mean};
pub use among::among;
pub use brightness::Brightness;
pub use equal::Planes;
pub use seeds::{Origin, SharedSeed, shared_seed};
pub use sketch::Sketch;

/// Two-sided chance of a false alarm of one test of a sound input.
pub const ALPHA: f64 = 1e-6;

/// Two-sided chance of a false alarm of the one test of all frames of a scene together, of which a study has few.
pub const SCENE_ALPHA: f64 = 5e-5;

/// Two-sided p-value of a size in standard errors; 1 of what is no number.
fn p_value(z: f64, freedom: u64) -> f64 {
    if z.is_nan() { 1.0 } else { noisefloor_stats::t_two_sided_p(z, freedom.max(1)) }
}
