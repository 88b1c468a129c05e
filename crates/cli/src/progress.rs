//! Progress on standard error: a bar if a person is watching, else a plain line now and then.

use std::io::{IsTerminal as _, stderr};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::out::note;

/// Longest silence of a log file.
const EVERY: Duration = Duration::from_secs(30);

/// Tells how far the work is.
pub struct Progress {
    bar: ProgressBar,
    lines: Option<Mutex<Lines>>,
}

impl Progress {
    /// Over `total` units of work; says nothing when quiet.
    pub fn new(total: u64, quiet: bool) -> Self {
        let watched = !quiet && stderr().is_terminal();
        let bar = ProgressBar::new(total);
        bar.set_draw_target(if watched {
            ProgressDrawTarget::stderr_with_hz(5)
        } else {
            ProgressDrawTarget::hidden()
        });
        let style = ProgressStyle::with_template(
            "{bar:32} {percent:>3} %  {elapsed} elapsed, {eta} left  {wide_msg}",
        )
        .unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style);
        let lines = (!quiet && !watched).then(|| Mutex::new(Lines::default()));
        Self { bar, lines }
    }

    /// Begins with this much work.
    pub fn begin(&self, total: u64) {
        self.bar.set_length(total);
        self.bar.reset();
    }

    /// What is being done; a log gets a line at once where `topic` changes.
    pub fn stage(&self, topic: &str, text: String) {
        self.bar.set_message(text.clone());
        self.line(|lines, elapsed| {
            let changed = lines.topic != topic;
            topic.clone_into(&mut lines.topic);
            lines.text = text;
            changed || lines.due(elapsed)
        });
    }

    /// Some units are done.
    pub fn advance(&self, units: u64) {
        self.bar.inc(units);
        self.line(|lines, elapsed| lines.due(elapsed));
    }

    /// A line of its own, above the bar or in the log.
    pub fn tell(&self, text: impl std::fmt::Display) {
        if self.lines.is_some() {
            note!("{text}");
        } else {
            self.bar.suspend(|| note!("{text}"));
        }
    }

    /// Runs `f` without a bar in the way.
    pub fn suspend<R>(&self, f: impl FnOnce() -> R) -> R {
        self.bar.suspend(f)
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn line(&self, wanted: impl FnOnce(&mut Lines, Duration) -> bool) {
        let Some(lines) = &self.lines else { return };
        let mut lines = lines.lock().unwrap_or_else(PoisonError::into_inner);
        let elapsed = lines.start.elapsed();
        if wanted(&mut lines, elapsed) {
            lines.last = elapsed;
            let done = 100.0 * self.bar.position() as f64 / self.bar.length().unwrap_or(0).max(1) as f64;
            note!("{:>5.0} s {:>3.0} %  {}", elapsed.as_secs_f64(), done.floor(), lines.text);
        }
    }
}

/// What a log has been told.
struct Lines {
    start: Instant,
    last: Duration,
    topic: String,
    text: String,
}

impl Default for Lines {
    fn default() -> Self {
        Self { start: Instant::now(), last: Duration::ZERO, topic: String::new(), text: String::new() }
    }
}

impl Lines {
    fn due(&self, elapsed: Duration) -> bool {
        elapsed.saturating_sub(self.last) >= EVERY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_is_never_silent_for_longer_than_half_a_minute() {
        let mut lines = Lines::default();
        let told: Vec<u64> = (0..200)
            .filter(|second| {
                let elapsed = Duration::from_secs(*second);
                let due = lines.due(elapsed);
                if due {
                    lines.last = elapsed;
                }
                due
            })
            .collect();
        assert_eq!(told, [30, 60, 90, 120, 150, 180]);
    }
}
