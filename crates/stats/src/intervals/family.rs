//! What every family of intervals can be asked.

use super::planes::{IntervalPlanes, SamplePlanes};
use crate::{Level, ShapeError};

/// What a family needs beside means, variances of the means and counts of samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntervalNeed {
    /// Third central moments.
    ThirdMoment,
    /// Least and greatest samples.
    Extremes,
    /// Nothing more of the frame, but whole planes: a pixel's interval depends on its neighbours.
    Neighbours,
}

/// One way to make intervals for the means of pixels.
///
/// A two-sided level of 1−α leaves α outside, shared out between the two ends as the family says; an upper level leaves α
/// above the upper end, and there is no lower one. Families with one end alone, `lower-t` and `upper-t`, read of a level
/// nothing but 1−α: all of α lies beyond that end.
pub trait IntervalFamily: std::fmt::Debug + Send + Sync {
    /// Stable id, such as `pooled-t`.
    fn id(&self) -> &'static str;

    /// Name for people.
    fn name(&self) -> &'static str;

    /// Citation; `none: …` with the reason where no theorem is known that gives the level.
    fn source(&self) -> &'static str;

    /// Whether a two-sided level limits both ends.
    fn has_both_ends(&self) -> bool {
        true
    }

    /// Whether it promises to cover at least as often as its level says, instead of as often: a limit on one side. Being wide
    /// without a theorem is no such promise.
    fn at_least(&self) -> bool {
        false
    }

    /// What it needs beside means, variances and counts.
    fn needs(&self) -> &'static [IntervalNeed];

    /// Intervals of all pixels and channels; `None` if the planes lack something that the family needs.
    ///
    /// # Errors
    /// [`ShapeError`] if the planes do not belong together.
    fn intervals(
        &self,
        planes: &SamplePlanes<'_>,
        level: Level,
    ) -> Result<Option<IntervalPlanes>, ShapeError>;
}
