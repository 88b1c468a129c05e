//! What the platform tells about this process and machine; `None` where it does not.

use noisefloor_study::summary::Environment;

/// Peak resident memory of the process in bytes since the last [`reset_peak_memory`], or since it began.
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: u64 = line.split_ascii_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024)
}

/// Lowers the peak to the present use, where the kernel allows it.
pub(crate) fn reset_peak_memory() {
    // Refused on other systems; the peak then belongs to the process so far, which is what the record says.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// The machine as it is now.
pub(crate) fn environment(simd: &str) -> Environment {
    Environment {
        version: env!("CARGO_PKG_VERSION").into(),
        cpu: cpu_model().unwrap_or_default(),
        logical_cpus: std::thread::available_parallelism().map_or(0, |n| n.get() as u32),
        threads: rayon::current_num_threads() as u32,
        simd: simd.into(),
        platform: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        load_at_start: load(),
        profile: if cfg!(debug_assertions) { "debug" } else { "release" }.into(),
        date: String::new(),
    }
}

fn cpu_model() -> Option<String> {
    let info = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = info.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn load() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg").ok()?.split_ascii_whitespace().next()?.parse().ok()
}

/// Now in UTC, ISO 8601 to the second.
pub(crate) fn now() -> String {
    let seconds = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(0, |elapsed| elapsed.as_secs());
    utc(seconds)
}

/// Civil date of seconds since 1970 (days-from-civil counted in years that begin in March).
fn utc(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let shifted = days + 719_468; // days since 0000-03-01
    let era = shifted / 146_097;
    let day_of_era = shifted % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = 400 * era + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Hash of the running program, so that results of different builds are never mixed.
pub(crate) fn build_id() -> String {
    static ID: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    ID.get_or_init(|| {
        let program = std::env::current_exe().and_then(std::fs::read);
        match program {
            Ok(bytes) => blake3::hash(&bytes).to_hex()[..16].to_owned(),
            Err(_) => env!("CARGO_PKG_VERSION").to_owned(),
        }
    })
    .clone()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_agree_with_the_calendar() {
        assert_eq!(utc(0), "1970-01-01T00:00:00Z");
        assert_eq!(utc(951_827_696), "2000-02-29T12:34:56Z");
        assert_eq!(utc(1_709_251_199), "2024-02-29T23:59:59Z");
        assert_eq!(utc(1_709_251_200), "2024-03-01T00:00:00Z");
        assert_eq!(utc(4_102_444_799), "2099-12-31T23:59:59Z");
    }
}
