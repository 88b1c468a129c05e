//! One table of image metrics: id, formula, epsilon, averaging order, direction, non-finite policy.
//!
//! [`METRICS`] says what each number is and how it comes about; [`Measurer`] computes all of them at once for any number of
//! images against one reference, over the image and per pixel class, and says how much of each number's uncertainty
//! is the reference's own. A metric is one entry: its words and its [`Rule`]. Those [on request](ON_REQUEST) are measured
//! where a study lists them; [`add`] puts one of yours among them. Only the correction for the reference's noise is made for
//! single metrics, in `influence.rs` and `reference_noise.rs`.
//!
//! The noise of a reference must not pass for error. Where the formula allows, it is taken out: the product
//! of the residuals to two independent halves is an unbiased squared error; a reference with a variance and
//! no halves has that variance subtracted. Both can give values at or below zero when the error is smaller
//! than the reference can show. The relative error has a noisy denominator too: the bias that this makes is estimated,
//! taken out and told.
//!
//! ```
//! use noisefloor_frame::{Image, Reference};
//! use noisefloor_metrics::Measurer;
//!
//! let truth = Reference::exact(Image::filled(16, 16, 3, 0.5));
//! let measured = Measurer::new(&truth, None)?.measure(&Image::filled(16, 16, 3, 0.75))?;
//! assert_eq!(measured.values["mse"], Some(0.0625));
//! # Ok::<(), noisefloor_metrics::MetricError>(())
//! ```

mod asked;
mod blocks;
mod bootstrap;
mod constants;
mod contribution;
mod error;
mod flip;
mod influence;
mod map;
mod measured;
mod measurer;
mod metric;
mod pixels;
mod reference_noise;
mod relative_bias;
mod rules;
mod ssim;
mod table;
mod tone;
mod trimmed;
mod truth;
mod weight;

pub use blocks::BLOCK_SIDE;
pub use bootstrap::block_bootstrap;
pub use constants::{EPSILON, TRIMMED_SHARE};
pub use contribution::Contribution;
pub use error::MetricError;
pub use map::{ErrorKind, error_map};
pub use measured::{Classes, Measured, Values};
pub use measurer::Measurer;
pub use metric::{Better, Metric, Rule};
pub use pixels::Pixels;
pub use table::{METRICS, ON_REQUEST, add, metric, on_request};
pub use tone::{srgb_curve, tone_map};
pub use trimmed::trimmed_count;
