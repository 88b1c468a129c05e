use std::fmt;

use serde::{Deserialize, Serialize};

/// How far a study got. A cell is a row on one frame: scene × level × replicate × row.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Completion {
    /// Cells that the study asks for.
    pub planned: u64,
    /// Of those: cells that ended, in a result, skipped for a reason, or with an error.
    pub finished: u64,
    /// Where the others are, in the order of the study.
    pub missing: Vec<Missing>,
}

impl Completion {
    /// Whether every planned cell ended.
    #[must_use]
    pub fn complete(&self) -> bool {
        self.finished == self.planned
    }

    /// Whether every planned cell of a level of a scene ended.
    #[must_use]
    pub fn complete_at(&self, scene: &str, spp: u32) -> bool {
        !self.missing.iter().any(|missing| missing.scene == scene && missing.spp.contains(&spp))
    }
}

/// `12 of 18 cells are finished; missing: …`.
impl fmt::Display for Completion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} cells are finished", self.finished, self.planned)?;
        for (k, missing) in self.missing.iter().enumerate() {
            write!(f, "{}{missing}", if k == 0 { "; missing: " } else { "; " })?;
        }
        Ok(())
    }
}

/// Planned cells that did not end.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Missing {
    /// Scene id.
    pub scene: String,
    /// Samples per pixel concerned.
    pub spp: Vec<u32>,
    /// Whether these are all levels of the scene.
    pub all_levels: bool,
    /// Row labels; all rows if empty.
    pub rows: Vec<String>,
    /// Replicates, from 0; all of the level if empty.
    pub replicates: Vec<u32>,
    /// Number of cells.
    pub cells: u64,
}

/// `scene outdoor`, `toaster at 16 and 64 spp`, `toaster at 16 spp, rdfc, replicate 1`.
impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let whole = self.all_levels && self.rows.is_empty() && self.replicates.is_empty();
        if whole {
            write!(f, "all of scene {}", self.scene)?;
        } else {
            f.write_str(&self.scene)?;
        }
        if !self.all_levels {
            write!(f, " at {} spp", list(&self.spp))?;
        }
        if !self.rows.is_empty() {
            write!(f, ", {}", list(&self.rows))?;
        }
        if !self.replicates.is_empty() {
            // People count from 1.
            let told: Vec<u32> = self.replicates.iter().map(|r| r + 1).collect();
            write!(f, ", replicate{} {}", if told.len() == 1 { "" } else { "s" }, list(&told))?;
        }
        write!(f, " ({} cell{})", self.cells, if self.cells == 1 { "" } else { "s" })
    }
}

fn list<T: ToString>(items: &[T]) -> String {
    let texts: Vec<String> = items.iter().map(T::to_string).collect();
    match texts.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [head @ .., last] => format!("{} and {last}", head.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_reads_like_a_sentence() {
        let all = Missing {
            scene: "outdoor".into(),
            spp: vec![4, 16],
            all_levels: true,
            rows: Vec::new(),
            replicates: Vec::new(),
            cells: 12,
        };
        let part = Missing {
            spp: vec![16],
            all_levels: false,
            rows: vec!["rdfc".into()],
            replicates: vec![1, 2],
            cells: 2,
            ..all.clone()
        };
        let progress = Completion { planned: 30, finished: 16, missing: vec![all, part] };
        assert_eq!(
            progress.to_string(),
            "16 of 30 cells are finished; missing: all of scene outdoor (12 cells); outdoor at 16 spp, rdfc, replicates 2 and \
             3 (2 cells)"
        );
        assert!(
            !progress.complete()
                && !progress.complete_at("outdoor", 16)
                && progress.complete_at("toaster", 16)
        );
    }
}
