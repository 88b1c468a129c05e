//! `noisefloor report`.

use anyhow::bail;
use noisefloor_report::ReportOptions;

use crate::args::Report;
use crate::exit::Exit;
use crate::out::{Out, say};

pub fn run(args: &Report) -> anyhow::Result<Exit> {
    if !(args.viewer_budget.is_finite() && args.viewer_budget >= 0.0) {
        bail!("--viewer-budget is {}, expected a size in MB from 0", args.viewer_budget);
    }
    let out = args.out.as_deref().unwrap_or(&args.dir);
    let summary = noisefloor_harness::reanalyse_into(&args.dir, out, args.recompute)?;
    let options =
        ReportOptions { image_budget_bytes: (args.viewer_budget * 1e6) as usize, ..ReportOptions::default() };
    let files = noisefloor_report::write_report_into(&args.dir, out, &summary, &options)?;
    say!(Out::Stdout, "report: {}", files.index.display())?;
    Ok(Exit::Done)
}
