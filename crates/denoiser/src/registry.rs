//! Methods by name.

use std::sync::Arc;

use serde_json::{Map, Value};

use crate::param::{nearest, shown};
use crate::{BuildError, Factory, Guarded, Method, factory};

/// The methods that a program knows.
#[derive(Debug, Clone, Default)]
pub struct Registry {
    factories: Vec<Arc<dyn Factory>>,
}

impl Registry {
    /// Methods in display order; a later one with the same id replaces an earlier one, so a user may bring a variant of a
    /// built-in method.
    #[must_use]
    pub fn new(methods: impl IntoIterator<Item = Arc<dyn Factory>>) -> Self {
        let mut registry = Self::default();
        registry.extend(methods);
        registry
    }

    /// The methods in display order.
    #[must_use]
    pub fn factories(&self) -> &[Arc<dyn Factory>] {
        &self.factories
    }

    /// The method of this id, combinators not included.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<&dyn Factory> {
        self.factories.iter().find(|factory| factory.id() == id).map(AsRef::as_ref)
    }

    /// Builds `id` with overrides of its defaults. `guarded(ID)` wraps any method; its own parameters are
    /// `guard_level` and `guard_interval`, the rest goes to the inner method.
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
            let own = Guarded::take_own(&mut rest);
            let inner = self.build_levels(inner, &rest).map_err(offer_guards)?;
            return Guarded::from_parts(id, inner, own);
        }
        let Some(factory) = self.find(id) else {
            let nearest = nearest(id, self.factories.iter().map(|f| f.id()));
            return Err(BuildError::UnknownMethod { id: shown(id), nearest });
        };
        let denoiser = factory.build(overrides)?;
        let mut params = factory.defaults();
        params.extend(overrides.clone());
        Ok(Method {
            id: id.into(),
            params: Value::Object(params),
            version: factory.version(overrides),
            denoiser,
        })
    }
}

impl Extend<Arc<dyn Factory>> for Registry {
    fn extend<I: IntoIterator<Item = Arc<dyn Factory>>>(&mut self, methods: I) {
        for factory in methods {
            match self.factories.iter_mut().find(|known| known.id() == factory.id()) {
                Some(old) => *old = factory,
                None => self.factories.push(factory),
            }
        }
    }
}

/// Adds the combinator's own parameters to the names offered for one that the inner method does not know.
fn offer_guards(error: BuildError) -> BuildError {
    match error {
        BuildError::UnknownParameter { method, parameter, mut nearest } => {
            for own in Guarded::params().iter().map(factory::offer) {
                if !nearest.contains(&own) {
                    nearest.push(own);
                }
            }
            BuildError::UnknownParameter { method, parameter, nearest }
        }
        other => other,
    }
}
