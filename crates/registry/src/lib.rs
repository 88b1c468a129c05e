//! The one slice of built-in methods, chained with a user's own.
//!
//! This crate alone depends on every method. To add one: a line in its `Cargo.toml` and a line in [`builtin`].
//!
//! ```
//! let registry = noisefloor_registry::registry(&[]);
//! let method = registry.build("guarded(mc)", &serde_json::Map::new())?;
//! assert_eq!(method.denoiser.card().id, "guarded(mc)");
//! # Ok::<(), noisefloor_denoiser::BuildError>(())
//! ```

mod table;

#[cfg(test)]
mod tests;

use noisefloor_denoiser::{Entry, MC_ENTRY, Registry};
use noisefloor_geometric::{AS_WRITTEN_ENTRY, CORRECTED_ENTRY};
use noisefloor_rdfc::{
    ENTRY as RDFC_ENTRY, FIRST_ENTRY as RDFC_FIRST_ENTRY, SECOND_ENTRY as RDFC_SECOND_ENTRY,
    THIRD_ENTRY as RDFC_THIRD_ENTRY,
};
use noisefloor_virtual_flash::ENTRY as VIRTUAL_FLASH_ENTRY;

pub use table::{methods_table, params_table};

/// The built-in methods in display order.
#[must_use]
pub fn builtin() -> &'static [Entry] {
    const BUILTIN: &[Entry] = &[
        MC_ENTRY,
        VIRTUAL_FLASH_ENTRY,
        RDFC_ENTRY,
        RDFC_FIRST_ENTRY,
        RDFC_SECOND_ENTRY,
        RDFC_THIRD_ENTRY,
        CORRECTED_ENTRY,
        AS_WRITTEN_ENTRY,
    ];
    BUILTIN
}

/// The page of a built-in method, Markdown; none for the plain input and for a user's own methods.
#[must_use]
pub fn readme(entry: &Entry) -> Option<&'static str> {
    // A user's method may have taken a built-in one's place.
    builtin().iter().find(|own| own.id == entry.id && own.summary == entry.summary)?;
    match entry.id.split('-').next()? {
        "virtual" => Some(noisefloor_virtual_flash::README),
        "rdfc" => Some(noisefloor_rdfc::README),
        "geometric" => Some(noisefloor_geometric::README),
        _ => None,
    }
}

/// The built-in methods followed by `extra`; an extra entry with the id of a built-in one replaces it.
#[must_use]
pub fn registry(extra: &[Entry]) -> Registry {
    Registry::new(builtin(), extra)
}
