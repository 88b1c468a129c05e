//! What all verbs share: the registry, threads, memory, output folders.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Context as _;
use noisefloor_denoiser::{Factory, Registry};

/// Shared by the verbs.
#[derive(Debug)]
pub struct Context {
    /// Built-in and extra methods.
    pub registry: Registry,
}

impl Context {
    pub fn new(extra: impl IntoIterator<Item = Arc<dyn Factory>>) -> Self {
        Self { registry: noisefloor_registry::registry(extra) }
    }
}

/// Sets the number of threads of the global pool.
pub fn use_threads(threads: Option<u32>) -> anyhow::Result<()> {
    if let Some(n) = threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(n as usize)
            .build_global()
            .with_context(|| format!("starting {n} threads"))?;
    }
    Ok(())
}

/// The cache of rendered frames: `$XDG_CACHE_HOME/noisefloor`, `~/.cache/noisefloor`, or the platform's equivalent.
pub fn default_cache() -> PathBuf {
    let set = |name: &str| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    set("XDG_CACHE_HOME")
        .or_else(|| set("LOCALAPPDATA"))
        .or_else(|| set("HOME").map(|home| home.join(".cache")))
        .unwrap_or_else(std::env::temp_dir)
        .join("noisefloor")
}

/// Peak resident memory of this process in bytes, where the platform tells (Linux).
pub fn measured_peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024)
}
