//! Paths inside a study's folder.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::HarnessError;
use crate::store::sweep::sweep;

/// Paths inside a study's folder.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    root: PathBuf,
}

impl Layout {
    pub(crate) fn new(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Finished cells, one JSON object per line.
    pub(crate) fn records(&self) -> PathBuf {
        self.root.join("results.jsonl")
    }

    /// Records that an earlier version of the study, a method or the metrics made, one JSON object per line.
    pub(crate) fn superseded(&self) -> PathBuf {
        self.root.join("results.superseded.jsonl")
    }

    /// Lines of the records that could not be read.
    pub(crate) fn damaged(&self) -> PathBuf {
        self.root.join("results.damaged.jsonl")
    }

    /// The same in a recorded study, compressed.
    pub(crate) fn packed_records(&self) -> PathBuf {
        self.root.join("results.jsonl.gz")
    }

    /// What was measured over all replicates of levels, in a recorded study, compressed.
    pub(crate) fn packed_levels(&self) -> PathBuf {
        self.root.join("levels.jsonl.gz")
    }

    /// The study as it was resolved.
    pub(crate) fn study(&self) -> PathBuf {
        self.root.join("study.json")
    }

    /// Rows and machine, as the analysis needs them.
    pub(crate) fn context(&self) -> PathBuf {
        self.root.join("context.json")
    }

    /// Everything that a run means to do, one JSON object per line.
    pub(crate) fn plan(&self) -> PathBuf {
        self.root.join("plan.jsonl")
    }

    /// When the study was analysed with how many replicates, one JSON object per line.
    pub(crate) fn looks(&self) -> PathBuf {
        self.root.join("looks.jsonl")
    }

    /// The analysis.
    pub(crate) fn summary(&self) -> PathBuf {
        self.root.join("summary.json")
    }

    /// Removes what killed processes left half written in the folders of a study, and nothing in others that stand beside
    /// them; for whoever holds the lock.
    pub(crate) fn sweep(&self) {
        let folders = [
            ("", 0),
            ("reference", 0),
            ("images", 2),
            ("diagnostics", 2),
            ("maps", 2),
            ("logs", 2),
            ("report", 1),
        ];
        for (folder, depth) in folders {
            sweep(&self.root.join(folder), depth, Duration::ZERO);
        }
    }

    /// Absolute path of a relative one, its folder made if need be.
    pub(crate) fn ready(&self, relative: &str) -> Result<PathBuf, HarnessError> {
        let path = self.root.join(relative);
        let folder = path.parent().unwrap_or(&self.root);
        std::fs::create_dir_all(folder).map_err(HarnessError::io("make folder", folder))?;
        Ok(path)
    }
}
