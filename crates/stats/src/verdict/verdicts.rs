use super::judge::Judged;
use super::word::Verdict;
use crate::holm_adjusted;

/// All verdicts of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdicts {
    /// One per claim, in their order: a refutation counts only if it stands beside all the others.
    pub verdicts: Vec<Verdict>,
    /// p-values adjusted by Holm's rule (Holm 1979); none for claims without an interval.
    pub adjusted: Vec<Option<f64>>,
    /// Claims that have an interval.
    pub tested: usize,
    /// Of those: refuted if each is taken alone.
    pub refuted_alone: usize,
    /// As many as that would be by chance if all claims held at the edge of their regions.
    pub by_chance: f64,
}

impl Verdicts {
    /// α of the family.
    pub const ALPHA: f64 = 0.05;

    /// Adjusts the refutations. What is shown stays shown: another claim makes no interval wider than what it says of its
    /// own.
    #[must_use]
    pub fn of(claims: &[Judged]) -> Self {
        let known: Vec<f64> = claims.iter().filter_map(|claim| claim.p).collect();
        let mut adjusted = holm_adjusted(&known).into_iter();
        let adjusted: Vec<Option<f64>> =
            claims.iter().map(|claim| claim.p.and_then(|_| adjusted.next())).collect();
        let verdict = |(claim, p): (&Judged, &Option<f64>)| match claim.alone {
            Verdict::Refuted if p.is_none_or(|p| p > Self::ALPHA) => Verdict::NotShown,
            alone => alone,
        };
        Self {
            verdicts: claims.iter().zip(&adjusted).map(verdict).collect(),
            adjusted,
            tested: known.len(),
            refuted_alone: claims.iter().filter(|claim| claim.alone == Verdict::Refuted).count(),
            by_chance: Self::ALPHA * known.len() as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Needed;

    #[test]
    fn a_refutation_counts_only_beside_all_other_claims() {
        let claim = |alone, p| Judged { alone, p, needed: Needed::Nothing };
        let weak = claim(Verdict::Refuted, Some(0.04));
        assert_eq!(Verdicts::of(&[weak]).verdicts, [Verdict::Refuted]);
        let held = claim(Verdict::Shown, Some(1.0));
        let none = claim(Verdict::NotShown, None);
        let strong = claim(Verdict::Refuted, Some(1e-6));
        let family = Verdicts::of(&[weak, held, none, strong]);
        use Verdict::{NotShown, Refuted, Shown};
        assert_eq!(family.verdicts, [NotShown, Shown, NotShown, Refuted]);
        assert_eq!((family.tested, family.refuted_alone), (3, 2));
        assert!((family.by_chance - 0.15).abs() < 1e-12);
        assert!((family.adjusted[0].unwrap() - 0.08).abs() < 1e-12 && family.adjusted[2].is_none());
    }
}
