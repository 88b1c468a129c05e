//! What killed processes leave behind.

use std::path::Path;
use std::time::{Duration, SystemTime};

/// Removes temporary files of this program from a folder, and from folders in it down to `depth` levels, that nobody has
/// touched for so long. Others' files stay, links are not followed, and what cannot be removed is no reason to stop.
pub(crate) fn sweep(folder: &Path, depth: usize, age: Duration) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.filter_map(Result::ok) {
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir() && depth > 0 {
            sweep(&entry.path(), depth - 1, age);
        } else if kind.is_file() && is_ours(&entry.file_name().to_string_lossy()) {
            let changed = entry.metadata().and_then(|data| data.modified());
            let old = changed.is_ok_and(|at| SystemTime::now().duration_since(at).unwrap_or_default() >= age);
            if old {
                let _ = std::fs::remove_file(entry.path());
            }
        }
    }
}

/// The names of files that are being written: `.tmp` and at least six letters or digits.
fn is_ours(name: &str) -> bool {
    name.strip_prefix(".tmp")
        .is_some_and(|rest| rest.len() >= 6 && rest.chars().all(|c| c.is_ascii_alphanumeric()))
}

#[cfg(test)]
mod tests {
    use super::is_ours;

    #[test]
    fn only_names_of_this_program_are_swept() {
        assert!(is_ours(".tmpa1B2c3") && is_ours(".tmp0123456789abcdef01234567"));
        for others in
            [".tmp", ".tmpa", ".tmp-a1B2c3", "tmpa1B2c3", ".tmpa1B2c3.exr", ".temporary-file", ".lock"]
        {
            assert!(!is_ours(others), "{others}");
        }
    }

    #[test]
    fn the_names_are_those_that_files_have_while_they_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let mut seen = Vec::new();
        noisefloor_io::write_atomically(&folder.path().join("a"), |_| {
            let entries = std::fs::read_dir(folder.path())?;
            seen.extend(entries.filter_map(Result::ok).map(|entry| entry.file_name().into_string()));
            Ok(())
        })
        .unwrap();
        assert!(!seen.is_empty() && seen.iter().all(|name| is_ours(name.as_ref().unwrap())), "{seen:?}");
    }
}
