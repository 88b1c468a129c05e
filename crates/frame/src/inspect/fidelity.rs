//! How exactly the numbers of a file are known.

/// What compression did to the numbers of a file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Fidelity {
    /// Every number is the one that was written, rounded to the format's precision at most.
    #[default]
    Rounded,
    /// A lossy compression changed them, so that only gross contradictions can be told from its errors.
    Lossy,
}
