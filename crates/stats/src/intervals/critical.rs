//! Critical values of the two ends of intervals.

use std::collections::BTreeMap;

use crate::observed::SampleCounts;
use crate::student::{normal_beyond, t_beyond};
use crate::{Level, Sides, TTable};

/// Probabilities that an interval leaves outside; no end where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tails {
    /// That the truth lies below the lower end.
    pub below: Option<f64>,
    /// That the truth lies above the upper end.
    pub above: Option<f64>,
}

impl Tails {
    /// α/2 outside on either side; of an upper level α above and no lower end.
    pub fn equal(level: Level) -> Self {
        Self {
            below: (level.sides() == Sides::Two).then(|| level.upper_tail()),
            above: Some(level.upper_tail()),
        }
    }

    /// Of α this share above, the rest below; of an upper level as [`Tails::equal`].
    pub fn split(level: Level, share_above: f64) -> Self {
        match level.sides() {
            Sides::Two => Self {
                below: Some((1.0 - share_above) * level.alpha()),
                above: Some(share_above * level.alpha()),
            },
            Sides::Upper => Self::equal(level),
        }
    }
}

/// Student's critical values of each count of samples that occurs.
#[derive(Debug)]
pub(super) struct Critical {
    below: BTreeMap<u32, f64>,
    above: BTreeMap<u32, f64>,
}

impl Critical {
    pub fn new(tails: Tails, counts: SampleCounts<'_>) -> Self {
        let of = |tail: Option<f64>| {
            let mut known = BTreeMap::new();
            let mut add = |n: u32| {
                known
                    .entry(entry(n))
                    .or_insert_with_key(|&n| tail.map_or(f64::INFINITY, |tail| t_at(tail, n)));
            };
            match counts {
                SampleCounts::Uniform(n) => add(n),
                SampleCounts::PerPixel(map) => map.iter().copied().for_each(add),
            }
            known
        };
        Self { below: of(tails.below), above: of(tails.above) }
    }

    /// Critical values of the lower and the upper end for a count that occurs; infinite where there is no end.
    pub fn at(&self, n: u32) -> [f64; 2] {
        [&self.below, &self.above].map(|known| known.get(&entry(n)).copied().unwrap_or(f64::INFINITY))
    }
}

/// All counts beyond the table share the normal quantile.
fn entry(n: u32) -> u32 {
    n.min(TTable::LARGEST + 1)
}

fn t_at(tail: f64, n: u32) -> f64 {
    match n {
        0 | 1 => f64::INFINITY,
        n if n > TTable::LARGEST => normal_beyond(tail),
        n => t_beyond(tail, u64::from(n) - 1),
    }
}

/// Critical value times spread, infinite without a critical value, whatever the spread.
pub(super) fn reach(critical: f64, spread: f64) -> f64 {
    if critical.is_finite() { critical * spread } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn critical_values_are_those_of_the_table() {
        let counts = [0, 1, 2, 5, 64, TTable::LARGEST, TTable::LARGEST + 1, u32::MAX];
        for level in [Level::TWO_SIDED_95, Level::TWO_SIDED_998, Level::upper(0.9).unwrap()] {
            let critical = Critical::new(Tails::equal(level), SampleCounts::PerPixel(&counts));
            let table = TTable::new(level, 64);
            for n in counts {
                let [below, above] = critical.at(n);
                assert_eq!(above, table.at(n), "{n}");
                assert_eq!(below, if level.sides() == Sides::Two { above } else { f64::INFINITY });
            }
        }
    }

    #[test]
    fn what_is_outside_is_shared_out_and_adds_up() {
        let tails = Tails::split(Level::TWO_SIDED_95, 0.1);
        let (below, above) = (tails.below.unwrap(), tails.above.unwrap());
        assert!((below + above - 0.05).abs() < 1e-15 && (above - 0.005).abs() < 1e-15);
        let upper = Level::upper(0.95).unwrap();
        assert_eq!(Tails::split(upper, 0.1), Tails { below: None, above: Some(upper.alpha()) });
    }
}
