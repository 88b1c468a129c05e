//! How many replicates there were whenever a study was analysed.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::record::{Outcome, Record};

/// Scene to level to a number of replicates.
pub type Counts = BTreeMap<String, BTreeMap<u32, u32>>;

/// An analysis of a study with numbers of replicates at which it had not been analysed before.
///
/// An interval for a fixed number of replicates covers as often as it says where that number does not depend on the data.
/// Who looks, and makes more because of what was seen, has other intervals.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Look {
    /// When, in UTC.
    pub date: String,
    /// Cells that had ended.
    pub cells: u64,
    /// Replicates of which some row was finished.
    pub replicates: Counts,
    /// Replicates that the study asked for at that time.
    pub planned: Counts,
}

impl Look {
    /// The analysis of these records of a study that asks for `planned` replicates.
    #[must_use]
    pub fn of(planned: Counts, records: &[Record], date: String) -> Self {
        let mut seen: BTreeMap<(&str, u32), BTreeSet<u32>> = BTreeMap::new();
        for record in records.iter().filter(|record| record.outcome == Outcome::Done) {
            seen.entry((&record.scene, record.spp)).or_default().insert(record.replicate);
        }
        let mut replicates = Counts::new();
        for ((scene, spp), found) in seen {
            replicates.entry(scene.to_owned()).or_default().insert(spp, found.len() as u32);
        }
        Self { date, cells: records.len() as u64, replicates, planned }
    }

    /// The numbers of replicates seen here, ascending, that were fewer than `now`, unless `now` has exactly what was
    /// planned at this time: that number was fixed before the look.
    #[must_use]
    pub fn outgrown(&self, now: &Self) -> BTreeSet<u32> {
        let levels =
            self.replicates.iter().flat_map(|(scene, l)| l.iter().map(move |(spp, n)| (scene, spp, *n)));
        let at =
            |counts: &Counts, scene: &str, spp: u32| counts.get(scene).and_then(|l| l.get(&spp)).copied();
        levels
            .filter(|(scene, spp, seen)| {
                let there = at(&now.replicates, scene, **spp);
                there.is_some_and(|n| n > *seen) && there != at(&self.planned, scene, **spp)
            })
            .map(|(_, _, seen)| seen)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(replicates: u32, planned: u32) -> Look {
        let counts = |n: u32| Counts::from([("a".to_owned(), BTreeMap::from([(4, n)]))]);
        Look { date: String::new(), cells: 0, replicates: counts(replicates), planned: counts(planned) }
    }

    #[test]
    fn a_number_outgrows_a_look_unless_it_was_planned_before_it() {
        const NONE: [u32; 0] = [];
        let outgrown = |then: Look, now: Look| then.outgrown(&now).into_iter().collect::<Vec<_>>();
        assert_eq!(outgrown(look(4, 4), look(8, 8)), [4]);
        assert_eq!(outgrown(look(4, 4), look(4, 4)), NONE);
        assert_eq!(outgrown(look(2, 4), look(4, 4)), NONE, "stopped, looked at, and finished as planned");
        assert_eq!(outgrown(look(2, 16), look(5, 16)), [2], "stopped at a number that nobody planned");
        assert_eq!(outgrown(look(8, 8), look(4, 4)), NONE, "fewer are no growth");
        let elsewhere = Look { replicates: Counts::new(), ..look(1, 1) };
        assert_eq!(outgrown(elsewhere, look(8, 8)), NONE, "that scene had not been seen");
    }
}
