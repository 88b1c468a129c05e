//! What the authors' programs do beside the printed formulas: each a switch, off by default.
//!
//! The printed filter needs one pixel's patch at a time. These rules look at the weights of a whole offset, so that the engine runs
//! them in a second form, map by map, which is slower.

/// The rules of a call. [`WeightRules::default`] is the printed filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WeightRules {
    /// Whether and how widely weights of the guide are smoothed. Not together with a derivative by the guide.
    pub smoothing: Smoothing,
    /// Whether opposite neighbours share a weight.
    pub pairs: Pairs,
    /// What windows see beyond the image.
    pub border: Border,
    /// What patches see beyond the image.
    pub taps: Taps,
}

/// Box filter of each offset's map of guide weights w_c: the mean over the pixels of the box that lie in the image. Weights
/// of features are not smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Smoothing {
    /// None, as printed.
    #[default]
    None,
    /// Radius f − 1, at least 0, with f that of the pass: the program of rousselle2013rdfc for every filter but the
    /// candidates.
    BelowPatch,
    /// Radius f: the program of Rousselle, Knaus and Zwicker 2012.
    Patch,
}

impl Smoothing {
    /// Box radius in pixels of a pass of this patch radius.
    #[must_use]
    pub fn radius(self, patch: usize) -> usize {
        match self {
            Self::None => 0,
            Self::BelowPatch => patch.saturating_sub(1),
            Self::Patch => patch,
        }
    }
}

/// Weights of the opposite neighbours q₁ = p + d and q₂ = p − d, of which the weight w_s of their mean says more than either
/// alone: in a gradient each differs from p and their mean does not.
///
/// ```text
/// d²_s, Φ²_s  as d² and Φ², with u(p) − ½(u(q₁)+u(q₂)),
///             noise v(p) + ¼(min(v(p),v(q₁)) + min(v(p),v(q₂))) and ¼(v(q₁)+v(q₂)) for v(q) in the denominator
/// a         = clamp(w_s/(w₁+w₂) − 1, 0, 1), 0 if all are 0
/// w_i       ← a·w_s + (1−a)·w_i
/// ```
///
/// The guide and each feature share for themselves, and the smallest weight counts as ever. With [`Border::Clipped`] nothing is
/// shared where one of the two lies beyond the image. Frames beside the target share within themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pairs {
    /// Each neighbour by itself, as printed.
    #[default]
    None,
    /// Before smoothing: the program of Rousselle, Knaus and Zwicker 2012.
    Raw,
    /// After smoothing of all three weights, where both neighbours are nearer than [`PAIR_LIMIT`]: the program of
    /// rousselle2013rdfc.
    Near,
}

/// Distances d² and Φ² from which on [`Pairs::Near`] leaves neighbours alone: the program's.
pub const PAIR_LIMIT: f32 = 25.0;

/// What a window sees beyond the image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Border {
    /// Nothing: it is cut.
    #[default]
    Clipped,
    /// The mirrored pixels (index −i reads i): every window has (2r+1)² pixels and a pixel near the border may meet itself. Both
    /// authors' programs.
    Mirrored,
}

/// What the patch around p sees beyond the image. That around q always reads mirrored pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Taps {
    /// The mirrored pixels.
    #[default]
    Mirrored,
    /// Nothing: d² is the mean over the taps that remain. Both authors' programs.
    Clipped,
}
