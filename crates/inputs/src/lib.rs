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
mod brightness;
mod chance;
mod check;
mod dependence;
mod equal;
mod median;
mod number;
mod picture;
mod seeds;
mod sketch;
mod sums;
mod variance;

pub use against::Against;
pub use among::among;
pub use brightness::Brightness;
pub use chance::{ALPHA, SCENE_ALPHA};
pub use check::{FrameCheck, Mean};
pub use equal::Planes;
pub use seeds::{Origin, SharedSeed, shared_seed};
pub use sketch::Sketch;
