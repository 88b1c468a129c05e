//! What may stand in for an input that a frame lacks.

use std::borrow::Cow;
use std::fmt;

use serde_json::Value;

use crate::Need;

/// A parameter with a value, as a study or a command line sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Name of the parameter.
    pub parameter: Cow<'static, str>,
    /// Value.
    pub value: Value,
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            Value::String(word) => write!(f, "{}={word}", self.parameter),
            value => write!(f, "{}={value}", self.parameter),
        }
    }
}

/// A setting under which a method does without some of its needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// The setting.
    pub setting: Setting,
    /// Needs that it takes away.
    pub lifts: Vec<Need>,
    /// Needs that it brings.
    pub asks: Vec<Need>,
}

impl Alternative {
    /// A setting that takes needs away and brings none.
    #[must_use]
    pub fn new(
        parameter: impl Into<Cow<'static, str>>,
        value: impl Into<Value>,
        lifts: impl Into<Vec<Need>>,
    ) -> Self {
        let setting = Setting { parameter: parameter.into(), value: value.into() };
        Self { setting, lifts: lifts.into(), asks: Vec::new() }
    }

    /// The same with needs of its own.
    #[must_use]
    pub fn asking(self, asks: impl Into<Vec<Need>>) -> Self {
        Self { asks: asks.into(), ..self }
    }
}
