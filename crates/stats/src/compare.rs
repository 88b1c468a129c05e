//! All rows of one scene × spp × metric against each other.

use serde::{Deserialize, Serialize};

use crate::interval::mean_and_variance;
use crate::{Effect, Level, ReferenceShare, holm_adjusted, paired_effect};

/// Which values are better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Errors: smaller is better, compared by ratio where all are positive.
    LowerIsBetter,
    /// Scores such as PSNR: larger is better, compared by difference.
    HigherIsBetter,
}

/// Which pairs are compared.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Every pair.
    #[default]
    AllPairs,
    /// Each row with the best one. The best is chosen from the same data, which the adjustment does not
    /// account for: with several equally good rows it finds a difference more often than the level says.
    WithBest,
}

impl Family {
    /// Name in summaries.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::AllPairs => "all-pairs",
            Self::WithBest => "with-best",
        }
    }
}

/// One method's values by replicate; all rows in the same order of replicates, `None` where it did not run. A value that is
/// not finite counts as missing.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// Values by replicate.
    pub values: &'a [Option<f64>],
    /// What the reference contributes to their mean.
    pub reference: &'a ReferenceShare,
}

/// Two rows, by index.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// The better one by mean.
    pub a: usize,
    /// The other.
    pub b: usize,
    /// a against b.
    pub effect: Effect,
    /// Holm-adjusted p-value within the family.
    pub p_adjusted: f64,
    /// Whether the adjusted p-value is at most α.
    pub distinguishable: bool,
}

/// Which rows can be told apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Row indices from best to worst by mean over their replicates; rows without any value are absent.
    pub ranking: Vec<usize>,
    /// Rows that the replicates cannot tell from the best, which comes first.
    pub best_group: Vec<usize>,
    /// Pairs compared.
    pub pairs: Vec<Pair>,
}

/// Ranks the rows and compares pairs of them on the same replicates, Holm-adjusted within the family, at a
/// two-sided `level`.
///
/// Errors are compared by their log ratio, or by their difference where a corrected error is not positive.
/// Pairs with fewer than two common replicates cannot be told apart; replicates where either value is not finite are
/// left out and counted.
#[must_use]
pub fn compare(rows: &[Row<'_>], direction: Direction, family: Family, level: Level) -> Comparison {
    let mut ranked: Vec<(usize, f64)> = rows
        .iter()
        .enumerate()
        .filter_map(|(i, row)| {
            let values: Vec<f64> = row.values.iter().copied().flatten().filter(|v| v.is_finite()).collect();
            mean_and_variance(&values).map(|(mean, _)| (i, mean))
        })
        .collect();
    ranked.sort_by(|a, b| match direction {
        Direction::LowerIsBetter => a.1.total_cmp(&b.1),
        Direction::HigherIsBetter => b.1.total_cmp(&a.1),
    });
    let ranking: Vec<usize> = ranked.iter().map(|r| r.0).collect();
    let firsts = match family {
        Family::AllPairs => ranking.len(),
        Family::WithBest => ranking.len().min(1),
    };
    let mut pairs = Vec::new();
    for (rank, &a) in ranking[..firsts].iter().enumerate() {
        for &b in &ranking[rank + 1..] {
            let common = [rows[a].reference, rows[b].reference];
            let ratio = direction == Direction::LowerIsBetter;
            if let Some(effect) = paired_effect(rows[a].values, rows[b].values, common, ratio, level) {
                pairs.push(Pair { a, b, effect, p_adjusted: effect.p, distinguishable: false });
            }
        }
    }
    let adjusted = holm_adjusted(&pairs.iter().map(|pair| pair.effect.p).collect::<Vec<_>>());
    for (pair, p) in pairs.iter_mut().zip(adjusted) {
        pair.p_adjusted = p;
        // A single pair has no spread and p = 1, which no level may call a difference.
        pair.distinguishable = pair.effect.interval.n >= 2 && p <= level.alpha();
    }
    let told_from_best =
        |row: usize| pairs.iter().any(|pair| (pair.a, pair.b) == (ranking[0], row) && pair.distinguishable);
    let best_group = ranking.iter().copied().filter(|&row| !told_from_best(row)).collect();
    Comparison { ranking, best_group, pairs }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Normals;

    static NONE: ReferenceShare = ReferenceShare { standard_error: 0.0, parts: Vec::new(), product: 0.0 };

    fn rows(values: &[Vec<Option<f64>>]) -> Vec<Row<'_>> {
        values.iter().map(|v| Row { values: v, reference: &NONE }).collect()
    }

    #[test]
    fn clear_differences_are_found_and_the_rest_is_grouped() {
        let some = |v: [f64; 4]| v.map(Some).to_vec();
        let values = [
            some([2.0, 2.1, 1.9, 2.0]),
            some([1.0, 1.1, 0.9, 1.0]),
            some([1.02, 1.07, 0.93, 0.99]),
            vec![None; 4],
        ];
        let c = compare(&rows(&values), Direction::LowerIsBetter, Family::AllPairs, Level::TWO_SIDED_95);
        assert_eq!(c.ranking, [1, 2, 0]);
        assert_eq!(c.best_group, [1, 2]);
        assert_eq!(c.pairs.len(), 3);
        let up = compare(&rows(&values), Direction::HigherIsBetter, Family::WithBest, Level::TWO_SIDED_95);
        assert_eq!((up.ranking, up.best_group, up.pairs.len()), (vec![0, 2, 1], vec![0], 2));
    }

    #[test]
    fn equally_good_rows_are_rarely_told_apart() {
        let mut normals = Normals::new(5);
        let (trials, mut any) = (2000, 0);
        for _ in 0..trials {
            let values: Vec<Vec<Option<f64>>> =
                (0..4).map(|_| (0..5).map(|_| Some((0.1 * normals.next()).exp())).collect()).collect();
            let c = compare(&rows(&values), Direction::LowerIsBetter, Family::AllPairs, Level::TWO_SIDED_95);
            any += u32::from(c.pairs.iter().any(|p| p.distinguishable));
        }
        // Holm keeps the family-wise rate at 5 % or below; four standard errors above.
        let limit = 0.05 + 4.0 * crate::rate_standard_error(0.05, trials);
        assert!(f64::from(any) / trials as f64 <= limit, "{any} of {trials}");
    }

    #[test]
    fn a_value_that_is_not_finite_is_a_missing_replicate() {
        let some = |v: &[f64]| v.iter().copied().map(Some).collect::<Vec<_>>();
        let level = Level::TWO_SIDED_95;
        let with = |a: &[f64], b: &[f64]| {
            compare(&rows(&[some(a), some(b)]), Direction::LowerIsBetter, Family::AllPairs, level)
        };
        let c = with(&[1.0, f64::NAN], &[100.0, 101.0]);
        assert!(!c.pairs[0].distinguishable && c.pairs[0].effect.not_finite == 1, "{c:?}");
        assert_eq!((c.ranking.clone(), c.best_group), (vec![0, 1], vec![0, 1]));
        let c = with(&[1.0, f64::NAN, 1.1, 0.9], &[100.0, 99.0, 101.0, 100.0]);
        assert!(c.pairs[0].distinguishable && c.pairs[0].effect.interval.n == 3);
        let c = with(&[f64::NAN, f64::INFINITY], &[100.0, 99.0]);
        assert_eq!((c.ranking, c.pairs.len()), (vec![1], 0), "a row without a finite value takes no part");
    }

    #[test]
    fn one_replicate_tells_nothing_apart() {
        let values = [vec![Some(1.0)], vec![Some(100.0)]];
        let c = compare(&rows(&values), Direction::LowerIsBetter, Family::AllPairs, Level::TWO_SIDED_95);
        assert_eq!(c.best_group, [0, 1]);
        assert_eq!(c.pairs[0].p_adjusted, 1.0);
    }
}
