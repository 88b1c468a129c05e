//! The channels of one layer in plane order, whatever a program calls them.

use std::path::Path;

use noisefloor_frame::FindingKind;

use crate::IoError;

/// Channels in plane order.
#[derive(Debug, PartialEq)]
pub(crate) struct Arranged {
    /// Their indices in the file.
    pub(crate) indices: Vec<usize>,
    /// What to tell about them.
    pub(crate) words: Option<(FindingKind, String)>,
}

/// Why the channels of a layer are not those that it should have.
#[derive(Debug, PartialEq)]
pub(crate) enum Problem {
    Missing(String),
    Unexpected(String),
    Twice(String),
}

impl Problem {
    pub(crate) fn error(self, file: &Path, layer: String, order: &[String]) -> IoError {
        let (file, expected) = (file.to_owned(), order.join(", "));
        match self {
            Self::Missing(channel) => IoError::IncompleteLayer { file, layer, channel, expected },
            Self::Unexpected(channel) => IoError::UnexpectedChannel { file, layer, channel, expected },
            Self::Twice(channel) => IoError::DuplicateChannel { file, layer, channel },
        }
    }

    pub(crate) fn words(&self) -> String {
        match self {
            Self::Missing(channel) => format!("it has no channel `{channel}`"),
            Self::Unexpected(channel) => format!("its channel `{channel}` has no meaning"),
            Self::Twice(channel) => format!("its channel `{channel}` is there twice"),
        }
    }
}

/// Sets of names that stand for one another, in plane order.
const SETS: [&[&str]; 8] =
    [&["R", "G", "B"], &["X", "Y", "Z"], &["X", "Y"], &["U", "V"], &["R", "G"], &["Z"], &["Y"], &["V"]];

/// Brings channels into the given order. Channels beyond it are left out. With `other_names` another set of as many
/// names, or for one plane whatever channel is alone or first of red, green and blue, stands for the layer's own;
/// letters may be small or large.
pub(crate) fn arrange(
    channels: &[(String, usize)],
    order: &[String],
    other_names: bool,
) -> Result<Arranged, Problem> {
    for (k, (name, _)) in channels.iter().enumerate() {
        if channels[..k].iter().any(|(earlier, _)| earlier == name) {
            return Err(Problem::Twice(name.clone()));
        }
    }
    let own: Vec<&str> = order.iter().map(String::as_str).collect();
    let missing = match pick(channels, &own, str::eq) {
        Ok(indices) => {
            let words = beyond(channels, &indices);
            return Ok(Arranged { words: words.map(|w| (FindingKind::LayerLeftOut, w)), indices });
        }
        Err(missing) => missing,
    };
    let same_letters = pick(channels, &own, |a, b| a.eq_ignore_ascii_case(b));
    if let Ok(indices) = same_letters {
        return Ok(renamed(channels, &own, indices));
    }
    if other_names {
        let sets = SETS.iter().filter(|set| set.len() == own.len());
        let mut picked = sets.filter_map(|set| pick(channels, set, |a, b| a.eq_ignore_ascii_case(b)).ok());
        if let Some(indices) = picked.next() {
            return Ok(renamed(channels, &own, indices));
        }
        let grey = pick(channels, &["R", "G", "B"], str::eq).ok();
        match (own.as_slice(), channels, grey) {
            ([_], [(_, only)], _) => return Ok(renamed(channels, &own, vec![*only])),
            ([_], _, Some(rgb)) => return Ok(renamed(channels, &own, vec![rgb[0]])),
            _ => {}
        }
    }
    let unexpected = channels.iter().find(|(name, _)| !own.contains(&name.as_str()));
    Err(match unexpected {
        Some((name, _)) if channels.len() >= own.len() => Problem::Unexpected(name.clone()),
        _ => Problem::Missing(missing),
    })
}

/// Indices of the channels with these names, or the first name that is not there.
fn pick(
    channels: &[(String, usize)],
    names: &[&str],
    same: impl Fn(&str, &str) -> bool,
) -> Result<Vec<usize>, String> {
    let find = |wanted: &&str| {
        let mut found = channels.iter().filter(|(name, _)| same(name, wanted));
        match (found.next(), found.next()) {
            (Some((_, index)), None) => Ok(*index),
            _ => Err((*wanted).to_owned()),
        }
    };
    names.iter().map(find).collect()
}

/// Words about the channels that are not among `used`.
fn beyond(channels: &[(String, usize)], used: &[usize]) -> Option<String> {
    let left: Vec<String> = channels
        .iter()
        .filter(|(_, index)| !used.contains(index))
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    match left.as_slice() {
        [] => None,
        [one] => Some(format!("its channel {one} was left out")),
        many => Some(format!("its channels {} were left out", many.join(", "))),
    }
}

fn renamed(channels: &[(String, usize)], own: &[&str], indices: Vec<usize>) -> Arranged {
    let name =
        |index: &usize| channels.iter().find(|(_, i)| i == index).map_or("", |(name, _)| name.as_str());
    let read: Vec<&str> = indices.iter().map(name).collect();
    let mut text = format!("its channels {} were read as {}", read.join(", "), own.join(", "));
    if let Some(more) = beyond(channels, &indices) {
        text.push_str(&format!("; {more}"));
    }
    Arranged { indices, words: Some((FindingKind::LayerReadAs, text)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str], order: &[&str]) -> Result<(Vec<usize>, Option<FindingKind>), Problem> {
        let channels: Vec<(String, usize)> = names.iter().map(|n| (*n).to_owned()).zip(0..).collect();
        let order: Vec<String> = order.iter().map(|n| (*n).to_owned()).collect();
        arrange(&channels, &order, true).map(|a| (a.indices, a.words.map(|(kind, _)| kind)))
    }

    const RGB: &[&str] = &["R", "G", "B"];
    const XYZ: &[&str] = &["X", "Y", "Z"];

    #[test]
    fn a_layer_is_read_whatever_its_channels_are_called() {
        let (out, other) = (Some(FindingKind::LayerLeftOut), Some(FindingKind::LayerReadAs));
        assert_eq!(of(&["B", "G", "R"], RGB), Ok((vec![2, 1, 0], None)));
        assert_eq!(of(&["A", "B", "G", "R"], RGB), Ok((vec![3, 2, 1], out)));
        assert_eq!(of(RGB, XYZ), Ok((vec![0, 1, 2], other)));
        assert_eq!(of(&["b", "g", "r"], RGB), Ok((vec![2, 1, 0], other)));
        assert_eq!(of(&["R", "X", "Y", "Z"], XYZ), Ok((vec![1, 2, 3], out)));
        assert_eq!(of(&["V"], &["Z"]), Ok((vec![0], other)));
        assert_eq!(of(&["depth"], &["Z"]), Ok((vec![0], other)));
        assert_eq!(of(&["B", "G", "R"], &["Z"]), Ok((vec![2], other)));
        assert_eq!(of(&["W", "X", "Y", "Z"], &["X", "Y"]), Ok((vec![1, 2], out)));
        assert_eq!(of(&["U", "V"], &["X", "Y"]), Ok((vec![0, 1], other)));
    }

    #[test]
    fn what_is_not_there_is_not_made_up() {
        assert_eq!(of(&["X", "Y"], XYZ), Err(Problem::Missing("Z".into())));
        assert_eq!(of(&["R", "G", "Q"], RGB), Err(Problem::Unexpected("Q".into())));
        assert_eq!(of(&["Z", "Z"], &["Z"]), Err(Problem::Twice("Z".into())));
    }

    #[test]
    fn core_layers_take_no_other_names() {
        let channels = [("X".to_owned(), 0), ("Y".to_owned(), 1), ("Z".to_owned(), 2)];
        let order = ["R", "G", "B"].map(str::to_owned);
        assert_eq!(arrange(&channels, &order, false), Err(Problem::Unexpected("X".into())));
    }
}
