//! Ctrl-C: the first lets the work stop in order, the second ends at once.

use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context as _;

use crate::exit::Exit;
use crate::out::note;

static PRESSED: AtomicBool = AtomicBool::new(false);

/// Catches Ctrl-C from now on.
pub fn catch() -> anyhow::Result<()> {
    let handler = || {
        if PRESSED.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted.code().into());
        }
        note!("\nnoisefloor: stopping when the current cell is finished; Ctrl-C again stops at once");
    };
    ctrlc::set_handler(handler).context("catching Ctrl-C")
}

/// Whether it was pressed.
pub fn pressed() -> bool {
    PRESSED.load(Ordering::Relaxed)
}
