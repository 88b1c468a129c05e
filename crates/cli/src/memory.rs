//! How much memory there is to take (Linux; elsewhere nothing is known).

use std::path::{Path, PathBuf};

use noisefloor_render::MAX_MEMORY;

/// Bytes of a GiB.
const GIB: f64 = (1u64 << 30) as f64;

/// The most that images may take: what is asked for, else what is free, else what the renderer allows.
pub fn allowed(asked_gib: Option<f64>) -> u64 {
    match asked_gib {
        // Casts saturate; the number is positive by its parser.
        Some(gib) => (gib * GIB) as u64,
        None => free().unwrap_or(MAX_MEMORY).min(MAX_MEMORY),
    }
}

/// A positive number of GiB.
pub fn parse_gib(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(gib) if gib > 0.0 && gib.is_finite() => Ok(gib),
        _ => Err(format!("`{text}` is not a number of GiB such as 8, above 0")),
    }
}

/// Bytes that this process can still take: free on the machine, and within the limits of its control group and of
/// `ulimit -v`.
fn free() -> Option<u64> {
    let read = |path: &Path| std::fs::read_to_string(path).ok();
    let proc = |name: &str| read(&Path::new("/proc").join(name));
    let machine = proc("meminfo").and_then(|text| kib(&text, "MemAvailable:"));
    let address_space = proc("self/limits").and_then(|text| soft_limit(&text, "Max address space"));
    let used = proc("self/status").and_then(|text| kib(&text, "VmSize:")).unwrap_or(0);
    let own_limit = address_space.map(|limit| limit.saturating_sub(used));
    let group = proc("self/cgroup").and_then(|text| {
        let path = text.lines().find_map(|line| line.strip_prefix("0::/"))?.to_owned();
        let folder = PathBuf::from("/sys/fs/cgroup").join(path);
        let number = |name: &str| read(&folder.join(name))?.trim().parse::<u64>().ok();
        Some(number("memory.max")?.saturating_sub(number("memory.current")?))
    });
    [machine, own_limit, group].into_iter().flatten().min()
}

/// The number of KiB behind a name, in bytes.
fn kib(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse::<u64>().ok()?.checked_mul(1024)
}

/// The soft limit of a line of `/proc/self/limits`, in bytes; nothing if it is unlimited.
fn soft_limit(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_systems_tables_are_read() {
        let text = "MemTotal:  99 kB\nMemAvailable:   1234 kB\n";
        assert_eq!(kib(text, "MemAvailable:"), Some(1234 * 1024));
        assert_eq!(kib(text, "VmSize:"), None);
        let text =
            "Limit     Soft Limit   Hard Limit   Units\nMax address space   6144000000  unlimited  bytes\n";
        assert_eq!(soft_limit(text, "Max address space"), Some(6_144_000_000));
        let unlimited = "Max address space   unlimited  unlimited  bytes\n";
        assert_eq!(soft_limit(unlimited, "Max address space"), None);
    }

    #[test]
    fn what_is_asked_for_counts_and_nonsense_is_refused() {
        assert_eq!(allowed(Some(0.5)), 1 << 29);
        assert!(allowed(None) <= MAX_MEMORY);
        for bad in ["0", "-1", "nan", "inf", "much"] {
            assert!(parse_gib(bad).unwrap_err().contains(bad));
        }
    }
}
