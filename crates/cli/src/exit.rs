//! Exit codes: what a script can tell from them.

use std::fmt;
use std::process::ExitCode;

use noisefloor_denoiser::BuildError;
use noisefloor_harness::HarnessError;
use noisefloor_scenes::UnknownScene;
use noisefloor_study::StudyError;

/// How a verb ended. The numbers are a contract with scripts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Everything that was asked for is done.
    Done,
    /// Something went wrong; standard error says what.
    Failed,
    /// The command line asks for something that does not exist or does not fit together; nothing was done.
    Usage,
    /// A report was written, but of a study that is not finished, or of which cells ended in an error.
    Unfinished,
    /// A gate found something that is worse.
    Worse,
    /// The two results of a gate are not of the same inputs.
    NotComparable,
    /// A strict gate could not tell whether something changed.
    Untold,
    /// Stopped by Ctrl-C.
    Interrupted,
}

impl Exit {
    /// All, by their number.
    pub const ALL: [Self; 8] = [
        Self::Done,
        Self::Failed,
        Self::Usage,
        Self::Unfinished,
        Self::Worse,
        Self::NotComparable,
        Self::Untold,
        Self::Interrupted,
    ];

    /// The number that the shell sees.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Failed => 1,
            Self::Usage => 2,
            Self::Unfinished => 3,
            Self::Worse => 4,
            Self::NotComparable => 5,
            Self::Untold => 6,
            // 128 + SIGINT, as a shell reports a program that the signal ended.
            Self::Interrupted => 130,
        }
    }

    /// What it means, for help texts.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "an error, told on standard error",
            Self::Usage => "wrong usage, nothing was done",
            Self::Unfinished => {
                "a report was written, of a study that is not finished or in which cells failed"
            }
            Self::Worse => "gate: an error is worse, or a cell does not run any more",
            Self::NotComparable => "gate: the two results are not of the same inputs",
            Self::Untold => "gate --strict: of something it cannot be told whether it changed",
            Self::Interrupted => "stopped by Ctrl-C",
        }
    }

    /// The code that fits an error.
    pub fn of(error: &anyhow::Error) -> Self {
        if let Some(ended) = error.downcast_ref::<Ended>() {
            return ended.exit;
        }
        // Names on the command line that nothing has; in a study file they are an error of the file.
        let unknown = error.is::<BuildError>()
            || error.is::<UnknownScene>()
            || matches!(error.downcast_ref(), Some(StudyError::UnknownStudy { .. }))
            || matches!(error.downcast_ref(), Some(HarnessError::NoRow { .. }));
        if unknown { Self::Usage } else { Self::Failed }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        exit.code().into()
    }
}

/// The table of exit codes as lines of a help text.
pub fn help() -> String {
    let lines: Vec<String> =
        Exit::ALL.iter().map(|exit| format!("  {:>3}  {}", exit.code(), exit.meaning())).collect();
    format!("Exit codes:\n{}", lines.join("\n"))
}

/// An error with an exit code of its own.
#[derive(Debug)]
pub struct Ended {
    exit: Exit,
    text: String,
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Ended {}

/// The command line asks for what cannot be: ends with [`Exit::Usage`].
pub fn usage(text: impl Into<String>) -> anyhow::Error {
    Ended { exit: Exit::Usage, text: text.into() }.into()
}

/// Two results of other inputs: ends with [`Exit::NotComparable`].
pub fn not_comparable(text: impl Into<String>) -> anyhow::Error {
    Ended { exit: Exit::NotComparable, text: text.into() }.into()
}

/// Stopped by Ctrl-C: ends with [`Exit::Interrupted`].
pub fn interrupted(text: impl Into<String>) -> anyhow::Error {
    Ended { exit: Exit::Interrupted, text: text.into() }.into()
}

/// An error and its causes in one line, each once: a message that quotes its cause is not followed by the same words.
pub fn told(error: &anyhow::Error) -> String {
    let mut whole = String::new();
    for cause in error.chain() {
        let text = cause.to_string();
        if whole.is_empty() {
            whole = text;
        } else if !whole.contains(&text) {
            whole = format!("{whole}: {text}");
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use anyhow::Context as _;

    use super::*;

    #[test]
    fn every_code_is_in_the_help() {
        let help = help();
        for exit in Exit::ALL {
            assert!(help.contains(&format!("{:>3}  {}", exit.code(), exit.meaning())), "{help}");
        }
        assert_eq!(Exit::ALL.map(Exit::code), [0, 1, 2, 3, 4, 5, 6, 130]);
    }

    #[test]
    fn an_error_keeps_its_code_under_any_context() {
        let error: anyhow::Result<()> = Err(usage("no such thing"));
        let error = error.context("reading the command line").unwrap_err();
        assert_eq!(Exit::of(&error), Exit::Usage);
        assert_eq!(told(&error), "reading the command line: no such thing");
        assert_eq!(Exit::of(&interrupted("stopped")), Exit::Interrupted);
        assert_eq!(Exit::of(&anyhow::anyhow!("anything")), Exit::Failed);
    }

    #[test]
    fn a_cause_that_the_message_quotes_is_not_told_again() {
        let cause = std::io::Error::other("the disk is full");
        let quoting = anyhow::Error::new(cause).context("cannot write a.exr: the disk is full");
        assert_eq!(told(&quoting), "cannot write a.exr: the disk is full");
    }
}
