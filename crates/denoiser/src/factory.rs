//! How a method is found by name and built from parameters.

use std::fmt;
use std::sync::Arc;

use serde_json::{Map, Value};
use thiserror::Error;

use crate::Denoiser;
use crate::param::{Param, ParamError, Parameters, check, defaults, nearest, shown};

/// Makes a method from its parameters. What a program knows at compile time comes from [`method`]; what it learns at run
/// time (a command, a script) implements the trait itself.
pub trait Factory: Send + Sync {
    /// Stable id.
    fn id(&self) -> &str;

    /// One line for lists.
    fn summary(&self) -> &str;

    /// The parameter table.
    fn params(&self) -> &[Param];

    /// Builds the method from overrides of the defaults.
    ///
    /// # Errors
    /// As [`BuildError`] says.
    fn build(&self, overrides: &Map<String, Value>) -> Result<Box<dyn Denoiser>, BuildError>;

    /// The method's page, Markdown.
    fn readme(&self) -> Option<&str> {
        None
    }

    /// What its results depend on beside its parameters, for methods that do not compute here: a hash of the program that
    /// does. None for all others: what they give on fixed frames says it.
    fn version(&self, _overrides: &Map<String, Value>) -> Option<String> {
        None
    }

    /// Whether it builds from its defaults; a method that is nothing without a setting does not join lists by itself.
    fn ready(&self) -> bool {
        true
    }

    /// All parameters at their defaults.
    fn defaults(&self) -> Map<String, Value> {
        defaults(self.params())
    }
}

impl fmt::Debug for dyn Factory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Factory").field("id", &self.id()).finish_non_exhaustive()
    }
}

/// Builds a method from checked parameters.
type New<P> = Box<dyn Fn(P) -> Result<Box<dyn Denoiser>, ParamError> + Send + Sync>;

/// A method that this program was compiled with.
struct Compiled<P> {
    id: String,
    summary: String,
    readme: Option<&'static str>,
    table: Vec<Param>,
    new: New<P>,
}

/// The factory of a method of this program: its parameters are a struct made by [`crate::parameters`], `new` its
/// constructor.
///
/// ```
/// use noisefloor_denoiser::{MonteCarlo, NoParams, method};
///
/// let plain = method("plain", "the input itself", None, |_: NoParams| Ok(MonteCarlo));
/// assert!(plain.build(&serde_json::Map::new()).is_ok());
/// ```
pub fn method<P, D>(
    id: impl Into<String>,
    summary: impl Into<String>,
    readme: Option<&'static str>,
    new: impl Fn(P) -> Result<D, ParamError> + Send + Sync + 'static,
) -> Arc<dyn Factory>
where
    P: Parameters + 'static,
    D: Denoiser + 'static,
{
    let new: New<P> = Box::new(move |params| new(params).map(|method| Box::new(method) as _));
    Arc::new(Compiled { id: id.into(), summary: summary.into(), readme, table: P::table(), new })
}

impl<P: Parameters> Factory for Compiled<P> {
    fn id(&self) -> &str {
        &self.id
    }

    fn summary(&self) -> &str {
        &self.summary
    }

    fn params(&self) -> &[Param] {
        &self.table
    }

    fn build(&self, overrides: &Map<String, Value>) -> Result<Box<dyn Denoiser>, BuildError> {
        check_overrides(&self.id, &self.table, overrides)?;
        let mut merged = self.defaults();
        merged.extend(overrides.clone());
        let params: P = serde_json::from_value(Value::Object(merged))
            .map_err(|error| BuildError::Internal { method: self.id.clone(), text: error.to_string() })?;
        (self.new)(params).map_err(|error| BuildError::out_of_range(&self.id, error))
    }

    fn readme(&self) -> Option<&str> {
        self.readme
    }
}

/// Checks names and values against a parameter table: what every factory does first.
///
/// # Errors
/// [`BuildError::UnknownParameter`] listing the nearest names with their ranges, [`BuildError::OutOfRange`].
pub fn check_overrides(
    method: &str,
    table: &[Param],
    overrides: &Map<String, Value>,
) -> Result<(), BuildError> {
    let find = |name: &str| table.iter().find(|param| param.name == name);
    for (name, value) in overrides {
        let Some(param) = find(name) else {
            return Err(BuildError::UnknownParameter {
                method: method.into(),
                parameter: shown(name),
                nearest: nearest(name, table.iter().map(|param| param.name.as_str()))
                    .iter()
                    .filter_map(|near| find(near))
                    .map(offer)
                    .collect(),
            });
        };
        check(param, value).map_err(|error| BuildError::out_of_range(method, error))?;
    }
    Ok(())
}

/// A parameter that exists, for a message.
pub(crate) fn offer(param: &Param) -> String {
    format!("{} ({})", param.name, param.range())
}

/// Why a name and its parameters give no method.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// No method of this name.
    #[error("unknown method `{id}`; nearest: {}", nearest.join(", "))]
    UnknownMethod {
        /// Name given.
        id: String,
        /// The closest names that exist.
        nearest: Vec<String>,
    },
    /// The method has no such parameter.
    #[error("method `{method}` has no parameter `{parameter}`; {}", known(nearest))]
    UnknownParameter {
        /// Method id.
        method: String,
        /// Name given.
        parameter: String,
        /// The closest names that exist, each with its range.
        nearest: Vec<String>,
    },
    /// Combinators in combinators, more than are accepted.
    #[error("method `{id}` is guarded {levels} times; allowed: at most {most}")]
    Nesting {
        /// Name given; the beginning of a long one.
        id: String,
        /// How deep it goes.
        levels: usize,
        /// How deep it may go.
        most: usize,
    },
    /// A value of the wrong type or out of range.
    #[error("method `{method}`: parameter `{parameter}` is {value}; allowed: {range}")]
    OutOfRange {
        /// Method id.
        method: String,
        /// Parameter.
        parameter: String,
        /// Value given.
        value: String,
        /// Allowed values.
        range: String,
    },
    /// The table allows what the method's struct does not take: a mistake of the method.
    #[error("method `{method}` does not take what its own table allows: {text}")]
    Internal {
        /// Method id.
        method: String,
        /// What was wrong.
        text: String,
    },
}

impl BuildError {
    pub(crate) fn out_of_range(method: &str, error: ParamError) -> Self {
        let ParamError { parameter, value, range } = error;
        Self::OutOfRange { method: method.into(), parameter, value, range }
    }
}

fn known(nearest: &[String]) -> String {
    if nearest.is_empty() { "it takes none".into() } else { format!("nearest: {}", nearest.join("; ")) }
}
