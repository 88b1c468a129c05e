//! The one list of built-in methods, chained with a user's own.
//!
//! This crate alone depends on every method. To add one: a line in its `Cargo.toml` and a line in [`builtin`].
//!
//! ```
//! let registry = noisefloor_registry::registry([]);
//! let method = registry.build("guarded(mc)", &serde_json::Map::new())?;
//! assert_eq!(method.denoiser.card().id, "guarded(mc)");
//! # Ok::<(), noisefloor_denoiser::BuildError>(())
//! ```

mod table;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use noisefloor_denoiser::{Factory, Registry};

pub use table::params_table;

/// The built-in methods in display order.
#[must_use]
pub fn builtin() -> Vec<Arc<dyn Factory>> {
    let mut methods = vec![noisefloor_denoiser::mc(), noisefloor_virtual_flash::virtual_flash()];
    methods.extend(noisefloor_rdfc::methods());
    methods.push(noisefloor_robust_first_order::method());
    methods.push(noisefloor_geometric::geometric_corrected());
    methods.push(noisefloor_geometric::geometric_as_written());
    methods.extend(noisefloor_baselines::methods());
    methods
}

/// Methods that stand for something outside and need a setting that says what.
#[must_use]
pub fn guests() -> Vec<Arc<dyn Factory>> {
    vec![noisefloor_command::command()]
}

/// The built-in methods, guests, and then `extra`; an extra one with the id of a built-in one replaces it.
#[must_use]
pub fn registry(extra: impl IntoIterator<Item = Arc<dyn Factory>>) -> Registry {
    Registry::new(builtin().into_iter().chain(guests()).chain(extra))
}
