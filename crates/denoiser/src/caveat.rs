use std::fmt;

/// What every method should promise and one may not, each declared on its card with the reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Caveat {
    /// There are frames with all that it needs for which it has no answer: it refuses them with
    /// [`crate::DenoiseError::Undefined`].
    Undefined,
    /// It is no average: an even image does not come out at the level it has.
    Level,
    /// A sample that is brighter than all others by orders of magnitude may leave it with more light than came in.
    Light,
}

impl fmt::Display for Caveat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Undefined => "undefined on some frames",
            Self::Level => "no average",
            Self::Light => "may make light of outliers",
        })
    }
}
