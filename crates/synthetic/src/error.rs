use thiserror::Error;

/// Why a description gives no synthetic scene.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SyntheticError {
    /// A parameter is out of range.
    #[error("synthetic scene: parameter `{parameter}` is {value}; allowed: {allowed}")]
    OutOfRange {
        /// Parameter name as in a study file.
        parameter: &'static str,
        /// Value given.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// A parameter was given that the chosen law or image does not have.
    #[error("synthetic scene: `{parameter}` has no meaning for {choice}")]
    NotApplicable {
        /// Parameter name as in a study file.
        parameter: &'static str,
        /// The law or image it was given with.
        choice: String,
    },
    /// The law needs means that are not negative.
    #[error(
        "synthetic scene: law {law} needs means ≥ 0, but level {level} with contrast {contrast} goes below"
    )]
    NegativeMean {
        /// Name of the law.
        law: &'static str,
        /// Darkest or brightest level.
        level: f64,
        /// Contrast.
        contrast: f64,
    },
}
