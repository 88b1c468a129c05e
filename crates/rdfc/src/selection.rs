//! Which candidate a pixel gets (Alg. 1, lines 19-21; Sec. 6).

use crate::params::Ties;

/// A candidate filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Choice {
    /// Sensitive to small detail: colour with patch radius 1, and features.
    First,
    /// Robust to noise: colour with patch radius 3, and features.
    Second,
    /// Features alone.
    Third,
}

impl Choice {
    /// All, in the order of the source.
    pub const ALL: [Self; 3] = [Self::First, Self::Second, Self::Third];

    /// Place in [`Choice::ALL`].
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

/// The candidate of least error estimate. FIRST is none where its mean derivative is not below SECOND's (or not above it,
/// with [`Ties::Program`]): its estimate is then thought to be low by chance (Sec. 6). `errors` and `derivatives` are those of FIRST, SECOND, THIRD.
///
/// Alg. 1, line 21 is printed as e_b < e_r ∧ e_g < e_b for THIRD; e_b < e_r ∧ e_b < e_g is meant, else SECOND
/// and THIRD are chosen together and THIRD never where it is best. A pixel where FIRST is least but no candidate
/// gets the better of the others, as in the authors' program; the printed lines leave it without any.
#[must_use]
pub fn select(errors: [f32; 3], derivatives: [f32; 3], ties: Ties) -> Choice {
    let [first, second, third] = errors;
    // Alg. 1, line 19.
    let filters_more = match ties {
        Ties::Program => derivatives[0] <= derivatives[1],
        Ties::Earlier | Ties::Later => derivatives[0] < derivatives[1],
    };
    if first < second && first < third && filters_more {
        return Choice::First;
    }
    // Alg. 1, line 20 for SECOND; Alg. 1, line 21, as it is meant, for THIRD. Of ties the lines say nothing.
    let third_wins = match ties {
        Ties::Earlier => third < second,
        Ties::Later | Ties::Program => third <= second,
    };
    if third_wins { Choice::Third } else { Choice::Second }
}
