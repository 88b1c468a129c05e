use serde_json::{Map, Value};

use crate::entry::{nearest, shown};
use crate::{BuildError, Denoiser, Entry, Guarded};

/// A method ready to run, with the parameters that made it.
pub struct Method {
    /// Id as asked for, such as `guarded(virtual-flash)`.
    pub id: String,
    /// All parameters, defaults included.
    pub params: Value,
    /// The method.
    pub denoiser: Box<dyn Denoiser>,
}

impl std::fmt::Debug for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Method").field("id", &self.id).field("params", &self.params).finish_non_exhaustive()
    }
}

/// The methods that a program knows: built-in entries chained with a user's own.
#[derive(Debug, Clone, Default)]
pub struct Registry {
    entries: Vec<Entry>,
}

impl Registry {
    /// Entries in display order; a later entry with the same id replaces an earlier one, so a user may
    /// bring a variant of a built-in method.
    #[must_use]
    pub fn new(builtin: &[Entry], extra: &[Entry]) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for entry in builtin.iter().chain(extra) {
            match entries.iter_mut().find(|e| e.id == entry.id) {
                Some(old) => *old = *entry,
                None => entries.push(*entry),
            }
        }
        Self { entries }
    }

    /// The entries in display order.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Builds `id` with overrides of its defaults. `guarded(ID)` wraps any method; its own parameter is
    /// `guard_level`, the rest goes to the inner method.
    ///
    /// # Errors
    /// [`BuildError`] naming the nearest methods or parameters and the allowed range; [`BuildError::Nesting`] for more
    /// than [`Guarded::MOST_LEVELS`] of them in each other.
    pub fn build(&self, id: &str, overrides: &Map<String, Value>) -> Result<Method, BuildError> {
        let levels = Guarded::levels(id);
        if levels > Guarded::MOST_LEVELS {
            return Err(BuildError::Nesting { id: shown(id), levels, most: Guarded::MOST_LEVELS });
        }
        self.build_levels(id, overrides)
    }

    /// [`Registry::build`] with a limited number of levels.
    fn build_levels(&self, id: &str, overrides: &Map<String, Value>) -> Result<Method, BuildError> {
        if let Some(inner) = id.strip_prefix("guarded(").and_then(|rest| rest.strip_suffix(')')) {
            let mut rest = overrides.clone();
            let level = rest.remove(Guarded::PARAM.name);
            let inner = self.build_levels(inner, &rest).map_err(offer_guard_level)?;
            return Guarded::from_parts(id, inner, level);
        }
        let Some(entry) = self.entries.iter().find(|e| e.id == id) else {
            let nearest = nearest(id, self.entries.iter().map(|e| e.id));
            return Err(BuildError::UnknownMethod { id: shown(id), nearest });
        };
        let denoiser = (entry.build)(overrides)?;
        let mut params = (entry.defaults)();
        for (name, value) in overrides {
            params[name] = value.clone();
        }
        Ok(Method { id: id.into(), params, denoiser })
    }
}

/// Adds the combinator's own parameter to the names offered for one that the inner method does not know.
fn offer_guard_level(error: BuildError) -> BuildError {
    match error {
        BuildError::UnknownParameter { method, parameter, mut nearest } => {
            let own = format!("{} ({})", Guarded::PARAM.name, Guarded::PARAM.range);
            if !nearest.contains(&own) {
                nearest.push(own);
            }
            BuildError::UnknownParameter { method, parameter, nearest }
        }
        other => other,
    }
}
