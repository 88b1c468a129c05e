//! `noisefloor record`.

use std::path::Path;

use anyhow::bail;
use noisefloor_questions::{Asked, Block, document, readme_table};
use noisefloor_study::exhibit::Document;

use crate::args::Record;
use crate::exit::Exit;
use crate::out::{Out, note, say};

/// Most bytes of a recording that a repository should carry.
const MOST_BYTES: u64 = 800_000;

pub fn run(args: &Record) -> anyhow::Result<Exit> {
    if args.to.join("results.jsonl").is_file() && args.to.join("study.json").is_file() {
        bail!("{} is the folder of a study that was run; record it into another one", args.to.display());
    }
    let with_images = noisefloor_harness::analysis_of(&args.dir)?;
    noisefloor_harness::record_study(&args.dir, &args.to)?;
    let summary = noisefloor_harness::analysis_of(&args.to)?;
    // A panel is of the images of the study; the numbers are those of the recording.
    let recording = document(&summary);
    let shown = Document { gallery: document(&with_images).gallery, ..recording };
    let made = noisefloor_report::write_recording(&args.to, &shown, Some(&args.dir), &|directive| {
        let asked = Asked { kind: directive.kind.clone(), keys: directive.keys.clone() };
        let markdown = |block: Block| match block {
            Block::Text(text) => text,
            Block::Table(table) => noisefloor_report::markdown(&table),
        };
        let blocks = readme_table(&summary, &asked)?.into_iter().map(markdown);
        Ok(blocks.map(|block| block.trim_end().to_owned()).collect::<Vec<_>>().join("\n\n"))
    })?;
    for name in &made.absent {
        note!("noisefloor: {} shows plots/{name}.svg, which the study does not have", made.readme.display());
    }
    let size = size_of(&args.to)?;
    say!(Out::Stdout, "recorded: {} ({} KB)", args.to.display(), size.div_ceil(1000))?;
    if size > MOST_BYTES {
        note!(
            "noisefloor: {} takes {} KB, more than the {} that a recording should have",
            args.to.display(),
            size.div_ceil(1000),
            MOST_BYTES / 1000
        );
    }
    Ok(Exit::Done)
}

/// Bytes of the files in a recording and of its plots.
fn size_of(folder: &Path) -> std::io::Result<u64> {
    let mut sum = 0;
    for folder in [folder.to_owned(), folder.join("plots")] {
        if folder.is_dir() {
            for entry in std::fs::read_dir(folder)? {
                let about = entry?.metadata()?;
                sum += if about.is_file() { about.len() } else { 0 };
            }
        }
    }
    Ok(sum)
}
