//! `noisefloor export`.

use crate::args::Export;
use crate::exit::Exit;
use crate::out::{Out, say};
use crate::report::unfinished_or_done;

pub fn run(args: &Export) -> anyhow::Result<Exit> {
    let summary = noisefloor_harness::analysis_of(&args.dir)?;
    let out = args.out.clone().unwrap_or_else(|| args.dir.join("export"));
    let files = noisefloor_report::export(&noisefloor_questions::document(&summary), &out)?;
    say!(Out::Stdout, "exported: {} files in {}", files.len(), out.display())?;
    Ok(unfinished_or_done(&summary))
}
