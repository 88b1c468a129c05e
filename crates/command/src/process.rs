//! A program with a time limit.

use std::ffi::OsString;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The end of what a program said that is kept, bytes.
const KEPT: u64 = 64 << 10;

/// How a program ended.
#[derive(Debug)]
pub(crate) struct Ended {
    /// What is wrong with it, for people; none if it ended well.
    pub trouble: Option<String>,
    /// What it said on standard output.
    pub stdout: String,
    /// What it said on standard error.
    pub stderr: String,
}

/// Runs a program until it ends or its time is over. Its output goes to files in `folder`: a pipe could be kept open by
/// what it started itself.
pub(crate) fn run(words: &[OsString], folder: &Path, limit: Duration) -> std::io::Result<Ended> {
    let out = folder.join("stdout.txt");
    let err = folder.join("stderr.txt");
    let (program, arguments) = words.split_first().ok_or_else(|| std::io::Error::other("no program"))?;
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).stdout(File::create(&out)?).stderr(File::create(&err)?);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let start = Instant::now();
    let mut child = command.spawn()?;
    let mut pause = Duration::from_millis(1);
    let trouble = loop {
        if let Some(status) = child.try_wait()? {
            break (!status.success()).then(|| told(status));
        }
        if start.elapsed() >= limit {
            stop(&mut child)?;
            break Some(format!("took more than {} s and was stopped", limit.as_secs_f64()));
        }
        // At most a hundredth of what it has taken so far.
        sleep(pause.min(limit.saturating_sub(start.elapsed())));
        pause = (start.elapsed() / 100).clamp(Duration::from_millis(1), Duration::from_millis(50));
    };
    Ok(Ended { trouble, stdout: end_of(&out)?, stderr: end_of(&err)? })
}

/// Stops a program and all that it has started.
fn stop(child: &mut Child) -> std::io::Result<()> {
    #[cfg(unix)]
    if let Some(group) = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw) {
        // It may have ended by itself meanwhile.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    let _ = child.kill();
    child.wait().map(|_| ())
}

fn told(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("was ended by signal {signal}");
    }
    match status.code() {
        Some(code) => format!("ended with code {code}"),
        None => "ended without a code".into(),
    }
}

/// The end of a text file.
fn end_of(path: &Path) -> std::io::Result<String> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    file.seek(SeekFrom::Start(length.saturating_sub(KEPT)))?;
    let mut bytes = Vec::new();
    file.take(KEPT).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The last lines of a text, at most so many, without empty ones.
pub(crate) fn last_lines(text: &str, most: usize) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).filter(|line| !line.is_empty()).collect();
    lines[lines.len().saturating_sub(most)..].join(" | ")
}
