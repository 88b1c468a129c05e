use std::fmt;

use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use thiserror::Error;

use crate::Denoiser;

/// One line of a method's parameter table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ParamDoc {
    /// Field name in configurations.
    pub name: &'static str,
    /// Allowed values, with unit.
    pub range: &'static str,
    /// What it does; symbol and section of the source.
    pub about: &'static str,
}

/// Builds a method from overrides of its defaults.
pub type Build = fn(&Map<String, Value>) -> Result<Box<dyn Denoiser>, BuildError>;

/// How a method is found by name and built from parameters.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Stable id.
    pub id: &'static str,
    /// One line for lists.
    pub summary: &'static str,
    /// Parameter table; the names are exactly the fields of `defaults`.
    pub params: &'static [ParamDoc],
    /// All parameters at their defaults, as a JSON object.
    pub defaults: fn() -> Value,
    /// Builds the method from overrides of the defaults (a JSON object); see [`build_with`].
    pub build: Build,
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entry").field("id", &self.id).finish_non_exhaustive()
    }
}

/// Why a name and its parameters give no method.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// No entry of this name.
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
}

fn known(nearest: &[String]) -> String {
    if nearest.is_empty() { "it takes none".into() } else { format!("nearest: {}", nearest.join("; ")) }
}

/// Merges overrides into the defaults and deserialises the parameter struct.
///
/// # Errors
/// [`BuildError::UnknownParameter`] listing the nearest names with their ranges, [`BuildError::OutOfRange`] for
/// values of the wrong type.
pub fn params_from<P: Default + Serialize + DeserializeOwned>(
    method: &str,
    docs: &[ParamDoc],
    overrides: &Map<String, Value>,
) -> Result<P, BuildError> {
    for name in overrides.keys() {
        if !docs.iter().any(|doc| doc.name == name) {
            return Err(BuildError::UnknownParameter {
                method: method.into(),
                parameter: shown(name),
                nearest: nearest(name, docs.iter().map(|d| d.name))
                    .into_iter()
                    .filter_map(|n| docs.iter().find(|d| d.name == n))
                    .map(|doc| format!("{} ({})", doc.name, doc.range))
                    .collect(),
            });
        }
    }
    // One at a time, so that a wrong type is blamed on the parameter that has it.
    let mut merged = serde_json::to_value(P::default()).unwrap_or(Value::Null);
    let mut params = P::default();
    for (name, value) in overrides {
        merged[name] = value.clone();
        params = serde_json::from_value(merged.clone()).map_err(|_| BuildError::OutOfRange {
            method: method.into(),
            parameter: name.clone(),
            value: shown(&value.to_string()),
            range: docs.iter().find(|d| d.name == name).map_or_else(String::new, |d| d.range.into()),
        })?;
    }
    Ok(params)
}

/// [`params_from`] followed by the method's own validating constructor, which names a parameter that is out of range.
///
/// # Errors
/// As [`params_from`], or [`BuildError::OutOfRange`] for the parameter that `new` rejects.
pub fn build_with<P, D>(
    method: &str,
    docs: &[ParamDoc],
    overrides: &Map<String, Value>,
    new: impl FnOnce(P) -> Result<D, &'static str>,
) -> Result<Box<dyn Denoiser>, BuildError>
where
    P: Default + Serialize + DeserializeOwned,
    D: Denoiser + 'static,
{
    let params: P = params_from(method, docs, overrides)?;
    let given = serde_json::to_value(&params).unwrap_or(Value::Null);
    match new(params) {
        Ok(denoiser) => Ok(Box::new(denoiser)),
        Err(name) => Err(BuildError::OutOfRange {
            method: method.into(),
            parameter: name.into(),
            value: given.get(name).map_or_else(String::new, |value| shown(&value.to_string())),
            range: docs.iter().find(|d| d.name == name).map_or_else(String::new, |d| d.range.into()),
        }),
    }
}

/// The longest name that is compared or shown in full: none that exists comes near.
const LONGEST_NAME: usize = 100;

/// A name or a value for a message: long ones end in `…`.
pub(crate) fn shown(name: &str) -> String {
    match name.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

/// The three names closest to `given`, closest first.
pub(crate) fn nearest<'a>(given: &str, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    // The time that a comparison takes grows with the product of both lengths.
    let given = given.char_indices().nth(LONGEST_NAME).map_or(given, |(end, _)| &given[..end]);
    let mut ranked: Vec<(f64, &str)> = names.map(|n| (strsim::jaro_winkler(given, n), n)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    ranked.into_iter().take(3).map(|(_, n)| n.to_owned()).collect()
}
