//! A study that is killed at any moment continues, and its records are those of an undisturbed run except for times.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::Value;

const STUDY: &str = r#"
name = "tiny"
spp = [2, 4, 8]
replicates = 2
width = 20
height = 15
depth = 3
timing = { warmup = 0, runs = 1 }
reference = { spp = 64 }

[[scene]]
id = "steps"
synthetic = { image = "edges", law = "exponential", width = 20, height = 15 }

[[scene]]
id = "cornell"

[[method]]
id = "mc"

[[method]]
id = "geometric-corrected"

[[method]]
id = "guarded(geometric-corrected)"
"#;

const CELLS: usize = 2 * 3 * 2 * 3;

fn start(folder: &Path, out: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_noisefloor"))
        .args(["run", "study.toml", "--quiet", "--threads", "2", "--out", out, "--cache"])
        .arg(format!("cache-of-{out}"))
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Lines that end in a line feed; what follows is torn.
fn whole_lines(folder: &Path, out: &str) -> Vec<String> {
    let bytes = std::fs::read(folder.join(out).join("results.jsonl")).unwrap_or_default();
    let end = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |last| last + 1);
    String::from_utf8(bytes[..end].to_vec()).unwrap().lines().map(str::to_owned).collect()
}

/// Records without what a clock or the memory of the moment decides.
fn timeless(lines: &[String]) -> Vec<Value> {
    let mut records: Vec<Value> = lines.iter().map(|line| serde_json::from_str(line).unwrap()).collect();
    for record in &mut records {
        let object = record.as_object_mut().unwrap();
        object.remove("seconds");
        object.remove("peak_memory_bytes");
    }
    records
}

fn finish(child: Child) {
    let ended = child.wait_with_output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
}

#[test]
fn a_killed_study_continues_and_loses_at_most_the_cell_it_was_at() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("study.toml"), STUDY).unwrap();
    finish(start(folder.path(), "whole"));
    let whole = whole_lines(folder.path(), "whole");
    assert_eq!(whole.len(), CELLS);

    let mut kept: Vec<String> = Vec::new();
    let mut stopped_midway = 0;
    // Kills at the moment when a number of cells is finished, and at moments between.
    for (goal, extra) in
        [(0, 0), (0, 7), (1, 0), (4, 1), (5, 3), (13, 0), (18, 0), (18, 11), (25, 2), (35, 0)]
    {
        let mut child = start(folder.path(), "killed");
        while whole_lines(folder.path(), "killed").len() < goal && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(extra));
        child.kill().unwrap(); // SIGKILL on Unix
        child.wait().unwrap();
        let now = whole_lines(folder.path(), "killed");
        // Bit for bit, times included: nothing that was finished ran again.
        assert_eq!(now[..kept.len()], kept[..], "after {goal} cells and {extra} ms");
        stopped_midway += usize::from(!now.is_empty() && now.len() < CELLS);
        kept = now;
    }
    assert!(stopped_midway >= 3, "only {stopped_midway} kills hit a study that had begun and not ended");
    finish(start(folder.path(), "killed"));
    let lines = whole_lines(folder.path(), "killed");
    assert_eq!(lines[..kept.len()], kept[..]);
    assert_eq!(timeless(&lines), timeless(&whole));

    // The images, too.
    for record in timeless(&whole) {
        let image = record["image"].as_str().unwrap();
        let read = |out: &str| std::fs::read(folder.path().join(out).join(image)).unwrap();
        assert!(read("whole") == read("killed"), "{image} differs");
    }
}
