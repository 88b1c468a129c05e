use thiserror::Error;

use crate::ShapeError;

/// Images of which no bias and variance can be made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum BiasVarianceError {
    /// Fewer than two replicates: no variance.
    #[error("{got} replicates, at least 2 are needed")]
    TooFewReplicates {
        /// Replicates given.
        got: usize,
    },
    /// Slices that do not belong together.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}
