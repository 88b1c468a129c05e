use std::fmt;

use crate::Violation;

/// What came of a method and a recipe.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It keeps what the recipe asks.
    Kept {
        /// Frames that it was run on.
        frames: usize,
        /// Of these: frames that it refused and may: by a need or a caveat of its card, or where a recipe allows it.
        refused: usize,
    },
    /// Its card declares that it does not keep this.
    Declared {
        /// The reason that the card gives.
        reason: String,
        /// Whether it shows on the recipe's frames; what never shows may be an old declaration.
        seen: bool,
    },
    /// There is nothing to ask, and why: it claims nothing of the kind.
    Idle(&'static str),
    /// It does not keep what the recipe asks, and its card does not say so.
    Broken(Violation),
}

impl Outcome {
    /// A word for lists.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Kept { frames, refused } if *refused > 0 && frames == refused => "refused",
            Self::Kept { .. } => "pass",
            Self::Declared { .. } => "declared",
            Self::Idle(_) => "-",
            Self::Broken(_) => "FAIL",
        }
    }

    /// What was broken.
    #[must_use]
    pub fn violation(&self) -> Option<&Violation> {
        match self {
            Self::Broken(violation) => Some(violation),
            _ => None,
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kept { frames: 0, .. } => f.write_str("no frame needed"),
            Self::Kept { frames: 1, refused: 0 } => f.write_str("1 frame"),
            Self::Kept { frames, refused: 0 } => write!(f, "{frames} frames"),
            Self::Kept { frames: 1, refused: 1 } => f.write_str("its frame, as it may"),
            Self::Kept { frames, refused } if frames == refused => {
                write!(f, "all {frames} frames, as it may")
            }
            Self::Kept { frames, refused } => write!(f, "{frames} frames, {refused} refused as they may be"),
            Self::Declared { reason, seen: true } => f.write_str(reason),
            Self::Declared { reason, seen: false } => write!(f, "{reason}; does not show here"),
            Self::Idle(why) => f.write_str(why),
            Self::Broken(violation) => violation.fmt(f),
        }
    }
}
