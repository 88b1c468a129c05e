//! Parameters of a method as one table: validation, help, JSON and README tables follow from it.

use std::fmt;
use std::ops::{Bound, RangeBounds};

use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use thiserror::Error;

/// What a parameter may be.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Kind {
    /// A finite number between two limits.
    Number {
        /// Lower limit.
        min: Bound<f64>,
        /// Upper limit.
        max: Bound<f64>,
        /// Unit, empty for none.
        unit: String,
    },
    /// A whole number between two limits, both of which are allowed.
    Integer {
        /// Least.
        min: i64,
        /// Most.
        max: i64,
        /// Unit, empty for none.
        unit: String,
    },
    /// One of these words.
    Choice(Vec<String>),
    /// True or false.
    Flag,
    /// A list of names.
    Names {
        /// How many at most.
        most: usize,
    },
    /// Any text.
    Text,
}

impl Kind {
    /// Whether a JSON value is allowed.
    #[must_use]
    pub fn allows(&self, value: &Value) -> bool {
        match self {
            Self::Number { min, max, .. } => {
                value.as_f64().is_some_and(|v| v.is_finite() && (*min, *max).contains(&v))
            }
            Self::Integer { min, max, .. } => value.as_i64().is_some_and(|v| (*min..=*max).contains(&v)),
            Self::Choice(words) => value.as_str().is_some_and(|given| words.iter().any(|word| word == given)),
            Self::Flag => value.is_boolean(),
            Self::Names { most } => {
                value.as_array().is_some_and(|list| list.len() <= *most && list.iter().all(Value::is_string))
            }
            Self::Text => value.is_string(),
        }
    }
}

/// The allowed values with their unit, for people.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = match self {
            Self::Number { min, max, unit } => {
                match (min, max) {
                    (Bound::Included(a), Bound::Included(b)) => write!(f, "{a} to {b}")?,
                    (Bound::Included(a), Bound::Excluded(b)) => write!(f, "at least {a} and below {b}")?,
                    (Bound::Excluded(a), Bound::Included(b)) => write!(f, "above {a}, at most {b}")?,
                    (Bound::Excluded(a), Bound::Excluded(b)) => write!(f, "above {a} and below {b}")?,
                    (Bound::Included(a), Bound::Unbounded) => write!(f, "{a} or more")?,
                    (Bound::Excluded(a), Bound::Unbounded) => write!(f, "above {a}")?,
                    (Bound::Unbounded, Bound::Included(b)) => write!(f, "at most {b}")?,
                    (Bound::Unbounded, Bound::Excluded(b)) => write!(f, "below {b}")?,
                    (Bound::Unbounded, Bound::Unbounded) => f.write_str("any number")?,
                }
                unit
            }
            Self::Integer { min, max, unit } => {
                match (max.checked_sub(*min), *max) {
                    (Some(1), _) => write!(f, "{min} | {max}")?,
                    (_, i64::MAX) => write!(f, "{min} or more")?,
                    _ => write!(f, "{min} to {max}")?,
                }
                unit
            }
            Self::Choice(words) => return f.write_str(&words.join(" | ")),
            Self::Flag => return f.write_str("true | false"),
            Self::Names { most } => return write!(f, "up to {most} names"),
            Self::Text => return f.write_str("text"),
        };
        match unit.as_str() {
            "" => Ok(()),
            "%" | "px" => write!(f, " {unit}"),
            other => write!(f, ", {other}"),
        }
    }
}

/// One line of a method's parameter table.
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// Field name in configurations.
    pub name: String,
    /// Allowed values.
    pub kind: Kind,
    /// Whether null is allowed too: the method, or one of its other parameters, then decides.
    pub nullable: bool,
    /// Value unless said otherwise.
    pub default: Value,
    /// Symbol in the source work; empty for none.
    pub symbol: String,
    /// Where the source work speaks of it, such as `Sec. 3.5`; empty where it does not.
    pub section: String,
    /// What it does.
    pub about: String,
}

impl Param {
    /// A parameter of this kind that is yet to get its name.
    #[must_use]
    pub fn new(kind: Kind) -> Self {
        Self {
            name: String::new(),
            kind,
            nullable: false,
            default: Value::Null,
            symbol: String::new(),
            section: String::new(),
            about: String::new(),
        }
    }

    /// Gives the number its unit.
    #[must_use]
    pub fn unit(mut self, of: &str) -> Self {
        if let Kind::Number { unit, .. } | Kind::Integer { unit, .. } = &mut self.kind {
            of.clone_into(unit);
        }
        self
    }

    /// Its symbol in the source work.
    #[must_use]
    pub fn symbol(self, symbol: &str) -> Self {
        Self { symbol: symbol.into(), ..self }
    }

    /// Where the source work speaks of it.
    #[must_use]
    pub fn section(self, section: &str) -> Self {
        Self { section: section.into(), ..self }
    }

    /// Allows null.
    #[must_use]
    pub fn or_null(self) -> Self {
        Self { nullable: true, ..self }
    }

    /// Name, text and default value.
    #[must_use]
    pub fn named(self, name: &str, about: &str, default: Value) -> Self {
        // Text of documentation comments begins with the blank after the slashes and is wrapped.
        let about = about.split_whitespace().collect::<Vec<_>>().join(" ");
        Self { name: name.into(), about, default, ..self }
    }

    /// Whether a JSON value is allowed.
    #[must_use]
    pub fn allows(&self, value: &Value) -> bool {
        (self.nullable && value.is_null()) || self.kind.allows(value)
    }

    /// The allowed values with their unit, for people.
    #[must_use]
    pub fn range(&self) -> String {
        if self.nullable { format!("null | {}", self.kind) } else { self.kind.to_string() }
    }

    /// What it does, with symbol and place in the source, for people.
    #[must_use]
    pub fn described(&self) -> String {
        let symbol = if self.symbol.is_empty() { String::new() } else { format!("{}: ", self.symbol) };
        let section = if self.section.is_empty() { String::new() } else { format!(" ({})", self.section) };
        format!("{symbol}{}{section}", self.about.trim_end_matches('.'))
    }
}

/// Kinds of parameters by their everyday names, for [`crate::parameters`].
pub mod kinds {
    use std::ops::{Bound, RangeBounds, RangeInclusive};

    use super::{Choices, Kind, Param};

    /// A number in this range: `0.0..=1.0`, `0.0..`, or a pair of bounds for open ends.
    #[must_use]
    pub fn number(range: impl RangeBounds<f64>) -> Param {
        let kind = Kind::Number {
            min: range.start_bound().cloned(),
            max: range.end_bound().cloned(),
            unit: String::new(),
        };
        Param::new(kind)
    }

    /// A number above this one.
    #[must_use]
    pub fn above(least: f64) -> Param {
        number((Bound::Excluded(least), Bound::Unbounded))
    }

    /// A number between these two, neither of which is allowed.
    #[must_use]
    pub fn between(least: f64, most: f64) -> Param {
        number((Bound::Excluded(least), Bound::Excluded(most)))
    }

    /// A whole number.
    #[must_use]
    pub fn integer(range: RangeInclusive<usize>) -> Param {
        let limit = |v: usize| i64::try_from(v).unwrap_or(i64::MAX);
        let kind =
            Kind::Integer { min: limit(*range.start()), max: limit(*range.end()), unit: String::new() };
        Param::new(kind)
    }

    /// A word of an enumeration.
    #[must_use]
    pub fn choice<C: Choices>() -> Param {
        Param::new(Kind::Choice(C::WORDS.iter().map(|word| (*word).to_owned()).collect()))
    }

    /// True or false.
    #[must_use]
    pub fn flag() -> Param {
        Param::new(Kind::Flag)
    }

    /// A list of names.
    #[must_use]
    pub fn names(most: usize) -> Param {
        Param::new(Kind::Names { most })
    }

    /// Any text.
    #[must_use]
    pub fn text() -> Param {
        Param::new(Kind::Text)
    }
}

/// An enumeration of words, made by [`crate::choices`].
pub trait Choices {
    /// The words in order.
    const WORDS: &'static [&'static str];
}

/// A parameter whose value is not allowed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("parameter `{parameter}` is {value}; allowed: {range}")]
pub struct ParamError {
    /// Parameter.
    pub parameter: String,
    /// Value given.
    pub value: String,
    /// Allowed values.
    pub range: String,
}

/// A struct of parameters with its table; made by [`crate::parameters`].
pub trait Parameters: Default + Serialize + DeserializeOwned {
    /// The table: one line per field, in order.
    fn table() -> Vec<Param>;

    /// Checks every field against the table.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    fn check(&self) -> Result<(), ParamError> {
        let given = serde_json::to_value(self).unwrap_or(Value::Null);
        Self::table()
            .iter()
            .try_for_each(|param| check(param, given.get(&param.name).unwrap_or(&Value::Null)))
    }
}

/// One value against its line of the table.
pub(crate) fn check(param: &Param, value: &Value) -> Result<(), ParamError> {
    if param.allows(value) {
        return Ok(());
    }
    Err(ParamError { parameter: param.name.clone(), value: shown(&value.to_string()), range: param.range() })
}

/// All defaults of a table as a JSON object.
#[must_use]
pub fn defaults(table: &[Param]) -> Map<String, Value> {
    table.iter().map(|param| (param.name.clone(), param.default.clone())).collect()
}

/// Declares a struct of parameters: each field with its text, type, default, and allowed values. The text of the comment is
/// what help and tables show; kinds are those of [`kinds`](crate::param::kinds). Gives the struct `Default`, serde and
/// [`Parameters`].
///
/// ```
/// use noisefloor_denoiser::{Parameters, parameters};
///
/// parameters! {
///     /// Parameters of a filter.
///     pub struct Params {
///         /// Radius of the window.
///         radius_px: usize = 3, integer(0..=32).unit("px").symbol("R").section("Sec. 4");
///         /// Falloff over the window's width.
///         falloff: f64 = 0.5, above(0.0);
///     }
/// }
///
/// assert_eq!(Params::table()[0].range(), "0 to 32 px");
/// let wrong = Params { falloff: 0.0, ..Params::default() }.check().unwrap_err();
/// assert_eq!(wrong.to_string(), "parameter `falloff` is 0.0; allowed: above 0");
/// ```
#[macro_export]
macro_rules! parameters {
    ($(#[$outer:meta])* $vis:vis struct $name:ident {
        $($(#[doc = $about:literal])+ $field:ident: $type:ty = $default:expr, $kind:expr;)*
    }) => {
        $(#[$outer])*
        #[derive(Debug, Clone, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        #[serde(deny_unknown_fields, default)]
        $vis struct $name {
            $($(#[doc = $about])+ pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $crate::Parameters for $name {
            fn table() -> Vec<$crate::Param> {
                #[allow(unused_imports)]
                use $crate::param::kinds::*;
                // A method may take no parameters.
                #[allow(unused_variables)]
                let defaults = $crate::param::json(&Self::default());
                vec![$({
                    let default = defaults.get(stringify!($field)).cloned().unwrap_or_default();
                    $kind.named(stringify!($field), concat!($($about),+), default)
                }),*]
            }
        }
    };
}

/// Declares an enumeration of words for a parameter: each with its text and its word in configurations. Gives it serde and
/// [`Choices`].
#[macro_export]
macro_rules! choices {
    ($(#[$outer:meta])* $vis:vis enum $name:ident {
        $($(#[doc = $about:literal])+ $variant:ident = $word:literal,)+
    }) => {
        $(#[$outer])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize)]
        $vis enum $name {
            $($(#[doc = $about])+ #[serde(rename = $word)] $variant,)+
        }

        impl $crate::Choices for $name {
            const WORDS: &'static [&'static str] = &[$($word),+];
        }
    };
}

/// A struct of parameters as a JSON object.
#[doc(hidden)]
#[must_use]
pub fn json<P: Serialize>(params: &P) -> Map<String, Value> {
    match serde_json::to_value(params) {
        Ok(Value::Object(object)) => object,
        _ => Map::new(),
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
