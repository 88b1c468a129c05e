use super::by_t::ByT;
use super::critical::Tails;

/// Share of α that a two-sided interval leaves above its upper end; the rest lies below the lower one.
///
/// Rendered samples are skewed to the right: where a t-interval misses, the truth lies above it in 85 to 100 % of cases.
/// One tenth above gives back nine tenths of the other tail, which is hardly used.
const SHARE_ABOVE: f64 = 0.1;

/// From x̄ − t(0.9·α)·s/√n to x̄ + t(0.1·α)·s/√n: the t-interval with unequal tails, exact for independent normal samples as
/// the other.
pub(super) static ASYMMETRIC_T: ByT = ByT {
    id: "asymmetric-t",
    name: "t with unequal tails",
    source: "Student, The probable error of a mean, Biometrika 6(1), 1908; the split of the tails, 1 to 9, is ours",
    tails: |level| Tails::split(level, SHARE_ABOVE),
    limit: false,
};
