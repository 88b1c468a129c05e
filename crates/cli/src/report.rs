//! `noisefloor report`.

use std::io::ErrorKind;

use anyhow::{anyhow, bail};
use noisefloor_harness::HarnessError;
use noisefloor_io::IoError;
use noisefloor_report::ReportOptions;
use noisefloor_study::summary::Summary;

use crate::args::Report;
use crate::exit::Exit;
use crate::out::{Out, note, say};
use crate::table::{failed, unfinished};

pub fn run(args: &Report) -> anyhow::Result<Exit> {
    if !(args.viewer_budget.is_finite() && args.viewer_budget >= 0.0) {
        bail!("--viewer-budget is {}, expected a size in MB from 0", args.viewer_budget);
    }
    let out = args.out.as_deref().unwrap_or(&args.dir);
    let summary = noisefloor_harness::reanalyse_into(&args.dir, out, args.recompute)
        .map_err(|error| way_out(error, args.out.is_none()))?;
    let options =
        ReportOptions { image_budget_bytes: (args.viewer_budget * 1e6) as usize, ..ReportOptions::default() };
    let document = noisefloor_questions::document(&summary);
    let files = noisefloor_report::write_report_into(&args.dir, out, &document, &options)?;
    if summary.recorded {
        say!(Out::Stdout, "images are not kept in a recorded study; `{}` makes them", summary.study.command)?;
    }
    say!(Out::Stdout, "report: {}", files.index.display())?;
    fail_on_faults(&summary)?;
    Ok(unfinished_or_done(&summary))
}

/// What a study shows rests on its frames, reference and intervals: if a check of these found a fault, nothing is shown.
pub fn fail_on_faults(summary: &Summary) -> anyhow::Result<()> {
    let faults = noisefloor_questions::failed_checks(summary);
    if faults.is_empty() {
        return Ok(());
    }
    Err(crate::exit::fault(format!("the instrument found a fault:\n  {}", faults.join("\n  "))))
}

/// What a script must know of a report: whether its study is finished and no cell failed. Tells what is missing on
/// standard error.
pub fn unfinished_or_done(summary: &Summary) -> Exit {
    let missing = [unfinished(summary), failed(summary)];
    for line in missing.iter().flatten() {
        note!("noisefloor: {line}");
    }
    if missing.iter().any(Option::is_some) { Exit::Unfinished } else { Exit::Done }
}

/// Names the way out where a study's folder cannot be written.
fn way_out(error: HarnessError, in_place: bool) -> anyhow::Error {
    let cause = match &error {
        HarnessError::Image(IoError::Write { cause, .. }) => Some(cause.kind()),
        HarnessError::Io { source, .. } => Some(source.kind()),
        _ => None,
    };
    let refused = matches!(cause, Some(ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem));
    if refused && in_place {
        return anyhow!("{error}; `--out OTHER` writes summary and report into another folder");
    }
    error.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_cannot_be_written_is_answered_with_the_option_for_another() {
        let error = |kind: ErrorKind| {
            HarnessError::Image(IoError::Write { file: "results/summary.json".into(), cause: kind.into() })
        };
        for kind in [ErrorKind::PermissionDenied, ErrorKind::ReadOnlyFilesystem] {
            assert!(way_out(error(kind), true).to_string().contains("--out OTHER"));
            assert!(!way_out(error(kind), false).to_string().contains("--out OTHER"));
        }
        assert!(!way_out(error(ErrorKind::StorageFull), true).to_string().contains("--out OTHER"));
    }
}
