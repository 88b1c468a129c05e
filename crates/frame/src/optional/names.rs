//! What statistics are called: on the command line, in study files and in layers of files.

use std::fmt;
use std::str::FromStr;

use super::rows::TABLE;
use super::statistic::{BoxCox, Statistic};
use crate::FrameError;

/// As it is asked for by name and called in files: the id of its row, for a Box–Cox transform with λ and the floor, such as
/// `box-cox:0.5:0.001`.
impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().id)?;
        match self {
            Self::BoxCox(transform) => write!(f, ":{}:{}", transform.lambda(), transform.floor()),
            _ => Ok(()),
        }
    }
}

impl FromStr for Statistic {
    type Err = FrameError;

    fn from_str(text: &str) -> Result<Self, FrameError> {
        let plain = [Self::ThirdMoment, Self::Least, Self::Greatest, Self::FourParts, Self::Position];
        if let Some(found) = plain.into_iter().find(|statistic| statistic.row().id == text) {
            return Ok(found);
        }
        let unknown = || {
            let ids: Vec<_> = TABLE.iter().map(|row| row.id).collect();
            let known = format!("{}, with box-cox:λ:floor such as box-cox:0.5:0.001", ids.join(", "));
            FrameError::UnknownStatistic { text: text.to_owned(), known }
        };
        let numbers = text.strip_prefix("box-cox:").and_then(|numbers| numbers.split_once(':'));
        let (lambda, floor) = numbers.ok_or_else(unknown)?;
        let number = |text: &str| text.parse::<f64>().map_err(|_| unknown());
        BoxCox::new(number(lambda)?, number(floor)?).map(Self::BoxCox)
    }
}
