//! How often the checks of the instrument alarm where there is no fault: a small study with every built-in method that
//! promises an unbiased estimate of its error, once per random seed.
//!
//! `clean_self_checks [SEEDS [FIRST]]` runs 200 studies from the seed 1 on, and prints the rate of reports with an alarm,
//! which checks alarmed, and how often each kind of check is below 5 % by its own p-value.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;

use noisefloor::harness::{StudyRun, run};
use noisefloor::questions::{checks, failed_checks};
use noisefloor::stats::rate_standard_error;
use noisefloor::study::Study;
use noisefloor::study::summary::Summary;

type Failure = Box<dyn std::error::Error>;

const STUDY: &str = r#"
name = "clean"
spp = [4, 16]
replicates = 4
timing = { warmup = 0, runs = 1 }
[[scene]]
id = "steps"
synthetic = { image = "edges", law = "exponential", width = 48, height = 36, guides = "none" }
[[method]]
id = "mc"
"#;

fn measured(seed: u64) -> Result<Summary, Failure> {
    let study = Study { seed, ..Study::from_toml(STUDY, Path::new("clean.toml"))? };
    let folder = std::env::temp_dir().join(format!("clean-self-checks-{}-{seed}", std::process::id()));
    let registry = noisefloor::registry::registry([]);
    let summary = run(&StudyRun::new(&study, &registry, &folder.join("out"), &folder.join("cache")));
    std::fs::remove_dir_all(&folder)?;
    Ok(summary?)
}

fn main() -> Result<(), Failure> {
    let mut numbers = std::env::args().skip(1).map(|text| text.parse::<u64>());
    let seeds = numbers.next().transpose()?.unwrap_or(200).max(1);
    let first = numbers.next().transpose()?.unwrap_or(1);
    let mut out = std::io::stdout().lock();
    let mut alarms = 0;
    // Tests, those below 5 % and those that could not tell, by kind.
    let mut kinds: BTreeMap<&str, [u64; 3]> = BTreeMap::new();
    for seed in first..first + seeds {
        let summary = measured(seed)?;
        let failed = failed_checks(&summary);
        alarms += u64::from(!failed.is_empty());
        for text in failed {
            writeln!(out, "seed {seed}: {text}")?;
        }
        for check in checks(&summary) {
            let counts = kinds.entry(check.record.kind.id()).or_default();
            match check.record.found {
                Some(found) => {
                    counts[0] += 1;
                    counts[1] += u64::from(found.p <= 0.05);
                }
                None => counts[2] += 1,
            }
        }
    }
    let rate = alarms as f64 / seeds as f64; // at least one
    writeln!(
        out,
        "{alarms} of {seeds} reports with an alarm: {:.1} %, MCSE at 1 % {:.1} %",
        100.0 * rate,
        100.0 * rate_standard_error(0.01, seeds)
    )?;
    for (kind, [tests, low, silent]) in kinds {
        writeln!(out, "{kind}: p ≤ 0.05 in {low} of {tests}; {silent} could not tell")?;
    }
    Ok(())
}
