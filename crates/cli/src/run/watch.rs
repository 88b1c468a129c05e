//! What a run tells while it goes, and what is kept when it stops.

use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use noisefloor_harness::{HarnessError, Observer, Stage, Workload};
use noisefloor_study::record::{Outcome, Record};

use crate::exit::{interrupted, told};
use crate::interrupt;
use crate::progress::Progress;

/// A cell counts as this many camera samples of progress: about what it costs on small images.
const SAMPLES_PER_CELL: u64 = 300_000;

/// Shows one progress over everything: rendered samples and finished cells, in one unit.
pub struct Watcher {
    progress: Progress,
    quiet: bool,
    /// Set when the work begins.
    planned: OnceLock<Workload>,
    finished: AtomicU64,
}

impl Watcher {
    pub fn new(quiet: bool) -> Self {
        Self {
            progress: Progress::new(0, quiet),
            quiet,
            planned: OnceLock::new(),
            finished: AtomicU64::new(0),
        }
    }

    /// The end of the run, whichever it is.
    pub fn finish(&self) {
        self.progress.finish();
    }

    /// An error that ended the run, with what is kept and how to go on, where a new run does go on.
    pub fn explain(&self, error: HarnessError, out: &Path) -> anyhow::Error {
        let kept = self.planned.get().map(|work| {
            let finished = work.kept + self.finished.load(Ordering::Relaxed);
            (finished, work.kept + work.cells)
        });
        let cancelled = error.is_cancelled();
        let error = anyhow::Error::new(error);
        match kept {
            _ if cancelled => {
                let (finished, all) = kept.unwrap_or_default();
                interrupted(format!(
                    "stopped by Ctrl-C; {finished} of {all} cells are finished and kept in {}, and the same command \
                     continues there",
                    out.display()
                ))
            }
            Some((finished @ 1.., all)) => anyhow::anyhow!(
                "{}\n{finished} of {all} cells are finished and kept in {}; once this is mended, the same command \
                 continues there",
                told(&error),
                out.display()
            ),
            _ => error,
        }
    }
}

impl Observer for Watcher {
    fn planned(&self, work: &Workload) {
        let _ = self.planned.set(*work);
        self.progress.begin(work.samples + work.cells * SAMPLES_PER_CELL);
        if work.kept > 0 && !self.quiet {
            self.progress.tell(format_args!("continuing: {} cells are finished already", work.kept));
        }
    }

    fn stage(&self, stage: &Stage) {
        let (topic, text) = match stage {
            Stage::Reference { scene, part, parts } => {
                (scene.as_str(), format!("{scene}: reference, part {} of {parts}", part + 1))
            }
            Stage::Frame { scene, spp, replicate } => {
                (scene.as_str(), format!("{scene}: {spp} samples per pixel, replicate {replicate}"))
            }
            Stage::Denoise { scene, spp, label, .. } => {
                (scene.as_str(), format!("{scene}: {label} at {spp}"))
            }
            Stage::Analysis => ("", "analysis".to_owned()),
            _ => ("", String::new()),
        };
        self.progress.stage(topic, text);
    }

    fn rendered(&self, samples: u64) {
        self.progress.advance(samples);
    }

    fn cell(&self, _: &Record, _: &Outcome) {
        self.finished.fetch_add(1, Ordering::Relaxed);
        self.progress.advance(SAMPLES_PER_CELL);
    }

    fn warning(&self, text: &str) {
        if !self.quiet {
            self.progress.tell(format_args!("warning: {text}"));
        }
    }

    fn cancelled(&self) -> bool {
        interrupt::pressed()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full() -> HarnessError {
        HarnessError::Io { action: "write", path: "a".into(), source: std::io::ErrorKind::StorageFull.into() }
    }

    #[test]
    fn only_a_run_that_keeps_cells_says_that_a_new_one_continues() {
        let out = Path::new("results");
        let said = |watcher: &Watcher, error| watcher.explain(error, out).to_string();
        let watcher = Watcher::new(true);
        // Before any work, as for a locked folder.
        let locked = || HarnessError::Locked { path: out.into() };
        assert!(!said(&watcher, locked()).contains("continues"));
        watcher.planned(&Workload { samples: 0, cells: 4, kept: 0 });
        assert!(!said(&watcher, full()).contains("continues"), "nothing is kept yet");
        watcher.finished.store(3, Ordering::Relaxed);
        let text = said(&watcher, full());
        assert!(text.contains("3 of 4 cells") && text.contains("continues there"), "{text}");
        assert_eq!(text.matches("no storage space").count(), 1, "{text}");
        let text = said(&watcher, HarnessError::Cancelled);
        assert!(
            text.contains("Ctrl-C") && text.contains("3 of 4 cells") && text.contains("results"),
            "{text}"
        );
    }
}
