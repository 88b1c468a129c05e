//! A method with its parameters.

use serde_json::Value;

use crate::Denoiser;

/// A method ready to run, with the parameters that made it.
pub struct Method {
    /// Id as asked for, such as `guarded(virtual-flash)`.
    pub id: String,
    /// All parameters, defaults included.
    pub params: Value,
    /// What its results depend on beside them, see [`crate::Factory::version`].
    pub version: Option<String>,
    /// The method.
    pub denoiser: Box<dyn Denoiser>,
}

impl std::fmt::Debug for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Method").field("id", &self.id).field("params", &self.params).finish_non_exhaustive()
    }
}
