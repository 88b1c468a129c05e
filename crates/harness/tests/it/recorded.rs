//! Results that were written by earlier versions stay readable.

use std::path::Path;

use noisefloor_harness::record::Record;
use noisefloor_harness::summary::Summary;

#[test]
fn recorded_studies_are_still_readable() {
    let reports = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reports");
    let (mut summaries, mut records) = (0, 0);
    for folder in std::fs::read_dir(reports).unwrap().map(|entry| entry.unwrap().path()) {
        if let Ok(text) = std::fs::read_to_string(folder.join("summary.json")) {
            let read: Result<Summary, _> = serde_json::from_str(&text);
            read.unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
            summaries += 1;
        }
        for line in std::fs::read_to_string(folder.join("results.jsonl")).unwrap_or_default().lines() {
            let read: Result<Record, _> = serde_json::from_str(line);
            read.unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
            records += 1;
        }
    }
    assert!(summaries >= 4 && records > 100, "{summaries} summaries, {records} records");
}
