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

const TWELVE: &str = r#"
name = "twelve"
spp = [2, 4, 8]
replicates = 2
width = 40
height = 30
timing = { warmup = 0, runs = 1 }

[[scene]]
id = "steps"
synthetic = { image = "edges", law = "exponential" }

[[method]]
id = "mc"

[[method]]
id = "geometric-corrected"
"#;

/// Starts a program on the study in `folder`.
fn run_with(program: &Path, folder: &Path) -> Child {
    let mut command = Command::new(program);
    command.args(["run", "study.toml", "--quiet", "--threads", "1", "--out", "out", "--cache", "cache"]);
    command.current_dir(folder).stdout(Stdio::null()).stderr(Stdio::piped());
    loop {
        match command.spawn() {
            Ok(child) => return child,
            // A test beside this one was being forked while the program was written.
            Err(busy) if busy.kind() == std::io::ErrorKind::ExecutableFileBusy => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(error) => panic!("{}: {error}", program.display()),
        }
    }
}

#[test]
fn a_changed_study_that_is_killed_and_a_program_that_is_built_again_lose_no_record() {
    let folder = tempfile::tempdir().unwrap();
    let write = |text: &str| std::fs::write(folder.path().join("study.toml"), text).unwrap();
    let ours = Path::new(env!("CARGO_BIN_EXE_noisefloor"));
    write(TWELVE);
    finish(run_with(ours, folder.path()));
    let first = whole_lines(folder.path(), "out");
    assert_eq!(first.len(), 12);

    // Another width, killed at several moments, until it is done.
    for milliseconds in [0, 20, 60, 150, 400] {
        write(&TWELVE.replace("width = 40", "width = 41"));
        let mut child = run_with(ours, folder.path());
        std::thread::sleep(Duration::from_millis(milliseconds));
        child.kill().unwrap();
        child.wait().unwrap();
        write(TWELVE);
        finish(run_with(ours, folder.path()));
        // Bit for bit, times included: nothing ran again.
        assert_eq!(whole_lines(folder.path(), "out"), first, "killed after {milliseconds} ms");
    }

    // The same program with one byte more, and the first one again.
    let rebuilt = folder.path().join("rebuilt");
    let mut bytes = std::fs::read(ours).unwrap();
    bytes.push(0);
    std::fs::write(&rebuilt, bytes).unwrap();
    std::fs::set_permissions(&rebuilt, std::fs::metadata(ours).unwrap().permissions()).unwrap();
    for program in [rebuilt.as_path(), ours] {
        finish(run_with(program, folder.path()));
        assert_eq!(whole_lines(folder.path(), "out"), first);
    }

    // What the other program adds stands beside them, and the report says so.
    write(&TWELVE.replace("replicates = 2", "replicates = 3"));
    finish(run_with(&rebuilt, folder.path()));
    assert_eq!(whole_lines(folder.path(), "out").len(), 18);
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    assert!(summary.contains("rows come from 2 builds of the program"));
    write(TWELVE);
    finish(run_with(ours, folder.path()));
    assert_eq!(whole_lines(folder.path(), "out"), first);
}
