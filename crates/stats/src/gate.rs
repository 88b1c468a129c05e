//! Two versions of the same rows on the same inputs: which cells changed, and which rows did.

use serde::{Deserialize, Serialize};

use crate::paired::effect;
use crate::{Design, Effect, Level, ReferenceShare, holm_adjusted, paired_effect};

/// An error of one row on one scene at one level, of an old and a new version by replicate.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Which row it is of.
    pub row: usize,
    /// Which reference it is against: what cells with the same one have in common does not average out over them.
    pub truth: usize,
    /// Errors of the old version by replicate; smaller is better.
    pub old: Vec<Option<f64>>,
    /// Errors of the new version on the same replicates.
    pub new: Vec<Option<f64>>,
    /// What the reference contributes to the means of old and new.
    pub reference: [ReferenceShare; 2],
}

impl Change {
    /// Whether all numbers are the same, bit by bit, and there is one.
    #[must_use]
    pub fn is_none(&self) -> bool {
        let bits = |values: &[Option<f64>]| values.iter().map(|v| v.map(f64::to_bits)).collect::<Vec<_>>();
        self.old.iter().any(Option::is_some) && bits(&self.old) == bits(&self.new)
    }

    /// Log ratio new/old by replicate, `None` where one of the two is missing or not finite; no list at all if one is not
    /// positive.
    fn log_ratios(&self) -> Option<Vec<Option<f64>>> {
        let count = self.old.len().max(self.new.len());
        let at =
            |values: &[Option<f64>], r: usize| values.get(r).copied().flatten().filter(|v| v.is_finite());
        (0..count)
            .map(|r| match (at(&self.old, r), at(&self.new, r)) {
                (Some(old), Some(new)) if old <= 0.0 || new <= 0.0 => None,
                // The same to the bit is the same, also where its logarithm is rounded.
                (Some(old), Some(new)) => Some(Some(new.ln() - old.ln())),
                _ => Some(None),
            })
            .collect()
    }
}

/// What is said of a change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// The same numbers, bit by bit.
    Same,
    /// The interval of the ratio is within the margin around 1, whether or not it contains 1.
    WithinMargin,
    /// The new version has a smaller error.
    Better,
    /// Neither a change nor that there is none beyond the margin.
    CannotBeTold,
    /// The new version has a larger error.
    Worse,
}

/// A change with what was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// What is said.
    pub answer: Answer,
    /// New over old, or new minus old where an error is not positive; absent where no replicate has both. Its interval is
    /// at the level 1−α, of this comparison alone.
    pub effect: Option<Effect>,
    /// p-value adjusted for the whole gate; 1 where nothing is tested.
    pub p_adjusted: f64,
    /// Smallest ratio above 1 that would have been told with this spread whatever the other comparisons gave, see
    /// [`Design::half_width`]; absent where there is no ratio with an interval.
    pub smallest_told: Option<f64>,
    /// Cells that are in it.
    pub cells: usize,
}

/// The terms on which a gate answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// Chance of any false "better" or "worse" in the whole gate, 1−α of this level.
    pub level: Level,
    /// Relative change of an error that does not matter, above 0; 0 if every one does.
    pub margin: f64,
}

/// Cells and rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Gate {
    /// In the order given.
    pub cells: Vec<Judgement>,
    /// By the rows' numbers; rows without a cell cannot be told.
    pub rows: Vec<Judgement>,
}

/// Compares two versions of all rows on the same inputs.
///
/// A cell is tested by Student's t on the log ratios of its replicates, as in [`paired_effect`]. A row is tested by
/// Student's t on its mean log ratio over the cells, replicate by replicate: whatever the cells of a replicate have in
/// common is in the spread of those means, and no independence of cells is assumed. What cells with the same
/// reference have in common is taken along the influences of its parts. Cells with an error that is not positive are not
/// in their row.
///
/// The cells are one family, the rows another, each with half of α, adjusted by Holm's rule: by Bonferroni's inequality
/// the chance of a "better" or "worse" anywhere, where nothing changed, is at most α, however cells and rows depend on
/// each other. A cell whose numbers are the same bit by bit is no test: two programs that differ on a cell do not agree
/// to the last bit by chance in every replicate. It is left out of the family, so that a change of one row is looked
/// for among that row's cells alone.
#[must_use]
pub fn gate(changes: &[Change], terms: Terms) -> Gate {
    let alpha = terms.level.alpha();
    let count = changes.iter().map(|change| change.row + 1).max().unwrap_or(0);
    let of_row = |row: usize| changes.iter().filter(|change| change.row == row).collect::<Vec<_>>();
    let rows = (0..count).map(|row| row_effect(&of_row(row), terms.level)).collect();
    let cells = changes.iter().map(|change| Tested {
        same: change.is_none(),
        cells: 1,
        effect: paired_effect(
            &change.new,
            &change.old,
            [&change.reference[1], &change.reference[0]],
            true,
            terms.level,
        ),
    });
    Gate { cells: family(cells.collect(), alpha, terms), rows: family(rows, alpha, terms) }
}

/// A comparison before it is adjusted.
struct Tested {
    same: bool,
    cells: usize,
    effect: Option<Effect>,
}

impl Tested {
    fn is_test(&self) -> bool {
        !self.same && self.effect.is_some_and(|effect| effect.interval.n >= 2)
    }
}

fn row_effect(changes: &[&Change], level: Level) -> Tested {
    let ratios: Vec<(&Change, Vec<Option<f64>>)> =
        changes.iter().filter_map(|change| Some((*change, change.log_ratios()?))).collect();
    let same = !changes.is_empty() && changes.iter().all(|change| change.is_none());
    let cells = ratios.len();
    let replicates = ratios.iter().map(|(_, logs)| logs.len()).min().unwrap_or(0);
    let means: Vec<f64> = (0..replicates)
        .filter_map(|r| {
            let logs: Option<Vec<f64>> = ratios.iter().map(|(_, logs)| logs[r]).collect();
            logs.map(|logs| logs.iter().sum::<f64>() / cells as f64) // no replicate without cells
        })
        .collect();
    let common = common(&ratios);
    let effect = effect(&means, common, level).map(|found| Effect {
        interval: found.interval.exp(),
        is_ratio: true,
        ..found
    });
    Tested { same, cells, effect }
}

/// What the references contribute to the mean log ratio over cells: of each reference along the influences of its
/// parts, of different references as independent.
fn common(ratios: &[(&Change, Vec<Option<f64>>)]) -> f64 {
    let mut truths: Vec<usize> = ratios.iter().map(|(change, _)| change.truth).collect();
    truths.sort_unstable();
    truths.dedup();
    let weight = 1.0 / ratios.len().max(1) as f64;
    truths.iter().fold(0.0f64, |sum, truth| {
        let mut terms = Vec::new();
        for (change, _) in ratios.iter().filter(|(change, _)| change.truth == *truth) {
            let means = [mean_of_both(&change.new, &change.old), mean_of_both(&change.old, &change.new)];
            if let [Some(new), Some(old)] = means {
                // Means of positive values.
                terms.push((weight / new, &change.reference[1]));
                terms.push((-weight / old, &change.reference[0]));
            }
        }
        sum.hypot(ReferenceShare::combined(&terms).standard_error)
    })
}

/// Mean of the values whose replicate has the other, too.
fn mean_of_both(values: &[Option<f64>], other: &[Option<f64>]) -> Option<f64> {
    let finite = |v: &Option<f64>| v.filter(|v| v.is_finite());
    let kept: Vec<f64> =
        values.iter().zip(other).filter_map(|(v, o)| finite(o).and_then(|_| finite(v))).collect();
    (!kept.is_empty()).then(|| kept.iter().sum::<f64>() / kept.len() as f64)
}

/// Adjusts one of the two families and says what was found.
fn family(tested: Vec<Tested>, alpha: f64, terms: Terms) -> Vec<Judgement> {
    let p: Vec<f64> = tested.iter().filter(|t| t.is_test()).filter_map(|t| t.effect.map(|e| e.p)).collect();
    let mut adjusted = holm_adjusted(&p).into_iter();
    // Half of α for each of the two families.
    let design = Level::two_sided(1.0 - 0.5 * alpha).ok().map(|half| Design::new(half, p.len() as u32));
    let out = tested.into_iter().map(|tested| {
        let p_adjusted = match tested.is_test() {
            true => adjusted.next().map_or(1.0, |p| (2.0 * p).min(1.0)),
            false => 1.0,
        };
        let smallest_told = tested.effect.filter(|e| e.is_ratio && !tested.same).and_then(|effect| {
            let interval = effect.interval;
            // The standard error of a ratio is that of its logarithm times the ratio, which is positive.
            let log = interval.standard_error? / interval.value;
            Some((design?.critical(interval.n)? * log).exp()).filter(|ratio| ratio.is_finite())
        });
        let answer = match &tested.effect {
            _ if tested.same => Answer::Same,
            Some(effect) => answer(effect, p_adjusted, alpha, terms.margin),
            None => Answer::CannotBeTold,
        };
        Judgement { answer, effect: tested.effect, p_adjusted, smallest_told, cells: tested.cells }
    });
    out.collect()
}

fn answer(effect: &Effect, p_adjusted: f64, alpha: f64, margin: f64) -> Answer {
    let interval = &effect.interval;
    let within = |low: f64, high: f64| low * (1.0 + margin) >= 1.0 && high <= 1.0 + margin;
    let (Some(low), Some(high)) = (interval.low, interval.high) else { return Answer::CannotBeTold };
    if effect.is_ratio && margin > 0.0 && within(low, high) {
        return Answer::WithinMargin;
    }
    let none = if effect.is_ratio { 1.0 } else { 0.0 };
    match p_adjusted <= alpha {
        true if interval.value > none => Answer::Worse,
        true => Answer::Better,
        false => Answer::CannotBeTold,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paired_ratio;
    use crate::random::Normals;

    const TERMS: Terms = Terms { level: Level::TWO_SIDED_95, margin: 0.0 };

    fn change(row: usize, old: &[f64], new: &[f64]) -> Change {
        let some = |values: &[f64]| values.iter().copied().map(Some).collect();
        Change {
            row,
            truth: 0,
            old: some(old),
            new: some(new),
            reference: [ReferenceShare::default(), ReferenceShare::default()],
        }
    }

    fn answers(judged: &[Judgement]) -> Vec<Answer> {
        judged.iter().map(|v| v.answer).collect()
    }

    #[test]
    fn identical_bits_are_the_same_whatever_the_reference() {
        let mut same = change(0, &[1.0, 2.0], &[1.0, 2.0]);
        same.reference = [0.5.into(), 0.5.into()];
        let found = gate(&[same, change(1, &[1.0], &[1.0])], TERMS);
        assert_eq!(answers(&found.cells), [Answer::Same; 2]);
        assert_eq!(answers(&found.rows), [Answer::Same; 2]);
        let other = gate(&[change(0, &[1.0, 2.0], &[1.0, 2.0_f64.next_up()])], TERMS);
        assert_ne!(other.cells[0].answer, Answer::Same);
        let none = Change { old: vec![None], new: vec![None], ..change(0, &[], &[]) };
        assert_eq!(gate(&[none], TERMS).cells[0].answer, Answer::CannotBeTold);
        assert_eq!(gate(&[], TERMS), Gate { cells: Vec::new(), rows: Vec::new() });
    }

    #[test]
    fn a_cell_is_told_where_its_p_value_is_below_its_share_of_half_of_alpha() {
        let old = [1.0, 1.1, 0.9, 1.2];
        let new: Vec<f64> = old.iter().zip([1.10, 1.11, 1.09, 1.10]).map(|(o, f)| o * f).collect();
        let alone = gate(&[change(0, &old, &new)], TERMS);
        let p = {
            let c = change(0, &old, &new);
            let none = ReferenceShare::default();
            paired_ratio(&c.new, &c.old, [&none, &none], TERMS.level).unwrap().p
        };
        assert!((alone.cells[0].p_adjusted - 2.0 * p).abs() < 1e-15);
        assert!((alone.rows[0].p_adjusted - 2.0 * p).abs() < 1e-9, "one cell: the row is the cell");
        assert_eq!((alone.cells[0].answer, alone.rows[0].answer), (Answer::Worse, Answer::Worse));
        let back = gate(&[change(0, &new, &old)], TERMS);
        assert_eq!(back.cells[0].answer, Answer::Better);
        // Among forty tests it needs a smaller p-value; cells that did not change are no tests.
        let noise = [1.3, 0.8, 1.1, 0.9];
        let wild: Vec<f64> = old.iter().zip(noise).map(|(o, f)| o * f).collect();
        let with = |other: Change| {
            let mut all = vec![change(0, &old, &new)];
            all.extend((0..39).map(|_| other.clone()));
            gate(&all, TERMS).cells[0].clone()
        };
        assert!((with(change(1, &old, &wild)).p_adjusted - 80.0 * p).abs() < 1e-12);
        assert!((with(change(1, &old, &old)).p_adjusted - 2.0 * p).abs() < 1e-15);
    }

    #[test]
    fn what_stays_within_the_margin_is_no_change_although_it_can_be_told() {
        let old = [1.0, 1.1, 0.9, 1.2];
        let new: Vec<f64> = old.iter().zip([1.0030, 1.0031, 1.0029, 1.0030]).map(|(o, f)| o * f).collect();
        let told = gate(&[change(0, &old, &new)], TERMS);
        assert_eq!(told.cells[0].answer, Answer::Worse);
        let wide = gate(&[change(0, &old, &new)], Terms { margin: 0.01, ..TERMS });
        assert_eq!((wide.cells[0].answer, wide.rows[0].answer), (Answer::WithinMargin, Answer::WithinMargin));
        let narrow = gate(&[change(0, &old, &new)], Terms { margin: 0.002, ..TERMS });
        assert_eq!(narrow.cells[0].answer, Answer::Worse);
    }

    #[test]
    fn the_row_sees_a_small_change_that_no_cell_shows() {
        let mut normals = Normals::new(3);
        let cells: Vec<Change> = (0..30)
            .map(|_| {
                let old = [1.0; 4];
                let new: Vec<f64> = old.iter().map(|o| o * (0.02 + 0.03 * normals.next()).exp()).collect();
                change(0, &old, &new)
            })
            .collect();
        let found = gate(&cells, TERMS);
        assert_eq!(found.rows[0].answer, Answer::Worse);
        assert_eq!(found.rows[0].cells, 30);
        assert!(found.cells.iter().all(|cell| cell.answer == Answer::CannotBeTold));
        let [row, cell] = [&found.rows[0], &found.cells[0]].map(|v| v.smallest_told.unwrap());
        assert!(1.0 < row && row < cell, "{row} {cell}");
    }

    #[test]
    fn a_row_is_the_mean_log_ratio_over_cells_replicate_by_replicate() {
        let cells = [change(0, &[1.0, 1.0], &[2.0, 4.0]), change(0, &[1.0, 1.0, 1.0], &[8.0, 1.0, 9.0])];
        let effect = gate(&cells, TERMS).rows[0].effect.unwrap();
        // Means (ln 2 + ln 8)/2 and ln 4/2 over the two replicates that both cells have.
        let (a, b) = (2.0 * 2f64.ln(), 2f64.ln());
        assert!((effect.interval.value - (0.5 * (a + b)).exp()).abs() < 1e-12);
        assert_eq!(effect.interval.n, 2);
        let se = 0.5 * (a - b) * effect.interval.value;
        assert!((effect.interval.standard_error.unwrap() - se).abs() < 1e-12);
        // A cell with a difference instead of a ratio is in no row.
        let negative = [cells[0].clone(), change(0, &[-1.0, 1.0], &[1.0, 1.0])];
        let found = gate(&negative, TERMS);
        assert_eq!((found.rows[0].cells, found.cells[1].effect.unwrap().is_ratio), (1, false));
    }

    #[test]
    fn a_common_reference_adds_up_over_the_cells_of_its_scene_and_averages_out_over_scenes() {
        let share = |l: f64| ReferenceShare { standard_error: l.abs(), parts: vec![l], product: 0.0 };
        let cell = |truth| Change {
            truth,
            reference: [share(0.1), share(-0.1)],
            ..change(0, &[1.0, 1.0], &[1.0 - f64::EPSILON, 1.0 - f64::EPSILON])
        };
        let se = |cells: &[Change]| {
            let interval = gate(cells, TERMS).rows[0].effect.unwrap().interval;
            interval.standard_error.unwrap() / interval.value
        };
        assert!((se(&[cell(0), cell(0)]) - 0.2).abs() < 1e-9);
        assert!((se(&[cell(0), cell(1)]) - 0.2 / 2f64.sqrt()).abs() < 1e-9);
    }

    /// Rates over `pairs` gates of 6 rows with 7 cells and 4 replicates, of which row 0 is changed by the factor
    /// `planted`: any false answer, and row 0 called worse.
    fn rates(pairs: u32, spread: f64, planted: f64, seed: u64) -> (f64, f64) {
        let mut normals = Normals::new(seed);
        let (mut alarms, mut found) = (0, 0);
        for _ in 0..pairs {
            let swap: Vec<bool> = (0..4).map(|_| normals.uniform() < 0.5).collect();
            let mut cells = Vec::new();
            for row in 0..6 {
                // Half of the variance is common to the cells of a row and replicate.
                let common: Vec<f64> = (0..4).map(|_| normals.next()).collect();
                for _ in 0..7 {
                    let old: Vec<f64> = (0..4).map(|_| (0.3 * normals.next()).exp()).collect();
                    let factor = if row == 0 { planted } else { 1.0 };
                    let new: Vec<f64> = (0..4)
                        .map(|r| {
                            let noise = spread * (common[r] + normals.next()) / 2f64.sqrt();
                            old[r] * factor * if swap[r] { (-noise).exp() } else { noise.exp() }
                        })
                        .collect();
                    cells.push(change(row, &old, &new));
                }
            }
            let gate = gate(&cells, TERMS);
            let told = |answer: Answer| matches!(answer, Answer::Better | Answer::Worse);
            let unchanged = |row: usize| planted == 1.0 || row != 0;
            let any = cells.iter().zip(&gate.cells).any(|(c, v)| unchanged(c.row) && told(v.answer))
                || gate.rows.iter().enumerate().any(|(row, v)| unchanged(row) && told(v.answer));
            alarms += u32::from(any);
            found += u32::from(gate.rows[0].answer == Answer::Worse);
        }
        (f64::from(alarms) / f64::from(pairs), f64::from(found) / f64::from(pairs))
    }

    #[test]
    fn of_a_thousand_pairs_without_a_change_at_most_one_in_twenty_raises_an_alarm() {
        let (alarms, _) = rates(1000, 0.02, 1.0, 17);
        let most = 0.05 + 4.0 * (0.05f64 * 0.95 / 1000.0).sqrt();
        assert!(alarms <= most, "{alarms}");
        assert!(alarms > 0.0, "a gate that never tells anything holds no level");
        // Alarms about rows that did not change do not come from one that did.
        let (alarms, found) = rates(300, 0.02, 1.5, 18);
        assert!(alarms <= 0.05 + 4.0 * (0.05f64 * 0.95 / 300.0).sqrt(), "{alarms}");
        assert!(found > 0.95, "{found}");
    }
}
