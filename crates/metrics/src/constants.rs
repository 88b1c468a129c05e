//! Constants of the formulas.

/// ε of the relative metrics, squared radiance.
pub const EPSILON: f64 = 0.01;

/// Share of the pixels that trimmed metrics leave out, rounded up to whole pixels.
pub const TRIMMED_SHARE: f64 = 0.001;

/// Weights of Rec. 709 luma.
pub(crate) const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];
