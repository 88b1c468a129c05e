//! Channel names on disk: the one place that knows what a layer is called.
//!
//! A channel is `layer.channel`, or `layer.statistic.channel` with the statistics `variance`, `halfA` and `halfB`;
//! colour has no layer name (`R`, `variance.R`). Optional statistics of the colour are layers of their own, such as
//! `optional.least.R` and, of several images, `optional.four-parts.part0.R`. Importers for other programs' names belong here
//! too.

use noisefloor_frame::{self as frame, FeatureId};

/// Which buffer of a frame a channel belongs to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Layer {
    Color,
    Feature(FeatureId),
    FlashBase,
    FlashLight,
    FlashCovariance,
    FlashReady,
    Samples,
    /// One of the independent parts of a reference.
    Part(usize),
    /// An image of an optional statistic of the colour: its name, and which of the images of its row.
    Optional(String, usize),
}

/// What the names of layers of optional statistics begin with.
const OPTIONAL: &str = "optional.";

/// What of the buffer a channel holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Statistic {
    Mean,
    Variance,
    HalfA,
    HalfB,
}

impl Statistic {
    pub(crate) const ALL: [Self; 4] = [Self::Mean, Self::Variance, Self::HalfA, Self::HalfB];

    pub(crate) fn suffix(self) -> &'static str {
        match self {
            Self::Mean => "",
            Self::Variance => "variance",
            Self::HalfA => "halfA",
            Self::HalfB => "halfB",
        }
    }
}

const RGB: &[&str] = &["R", "G", "B"];
const Y: &[&str] = &["Y"];

impl Layer {
    /// An image of an optional statistic.
    pub(crate) fn optional(statistic: frame::Statistic, image: usize) -> Self {
        Self::Optional(statistic.to_string(), image)
    }

    /// `four-parts.part0`, or `least`, which has one image.
    fn optional_from_name(name: &str) -> Option<Self> {
        let one = |name: &str| name.parse::<frame::Statistic>().ok().filter(|s| s.row().images.len() == 1);
        if let Some(statistic) = one(name) {
            return Some(Self::optional(statistic, 0));
        }
        let (name, image) = name.rsplit_once('.')?;
        let statistic: frame::Statistic = name.parse().ok()?;
        let images = statistic.row().images;
        let image = images.iter().position(|own| *own == image).filter(|_| images.len() > 1)?;
        Some(Self::optional(statistic, image))
    }

    fn from_name(name: &str) -> Self {
        let part = name.strip_prefix("part").and_then(|number| number.parse().ok());
        match (name, part) {
            (_, Some(part)) => Self::Part(part),
            ("flashBase", _) => Self::FlashBase,
            ("flashLight", _) => Self::FlashLight,
            ("flashCov", _) => Self::FlashCovariance,
            ("flash", _) => Self::FlashReady,
            ("samples", _) => Self::Samples,
            _ => Self::Feature(FeatureId::from_name(name)),
        }
    }

    /// Name without the statistic; empty for colour.
    fn prefix(&self) -> String {
        match self {
            Self::Color => String::new(),
            Self::Feature(id) => id.name().to_owned(),
            Self::FlashBase => "flashBase".into(),
            Self::FlashLight => "flashLight".into(),
            Self::FlashCovariance => "flashCov".into(),
            Self::FlashReady => "flash".into(),
            Self::Samples => "samples".into(),
            Self::Part(k) => format!("part{k}"),
            Self::Optional(statistic, image) => match statistic.parse().map(frame::Statistic::row) {
                Ok(row) if row.images.len() > 1 => format!("{OPTIONAL}{statistic}.{}", row.images[*image]),
                _ => format!("{OPTIONAL}{statistic}"),
            },
        }
    }

    /// Channel names in plane order; `None` if the file decides.
    pub(crate) fn channels(&self) -> Option<&'static [&'static str]> {
        match self {
            Self::Feature(id) => id.channel_names(),
            Self::Samples => Some(Y),
            _ => Some(RGB),
        }
    }

    /// Whether such a layer exists.
    fn has(&self, statistic: Statistic) -> bool {
        match self {
            Self::FlashCovariance | Self::Part(_) | Self::Optional(..) => statistic == Statistic::Mean,
            Self::Samples => matches!(statistic, Statistic::Mean | Statistic::HalfA),
            _ => true,
        }
    }
}

/// Layer with statistic as messages name it: `color`, `color.variance`, `albedo.halfA`.
pub(crate) fn title(layer: &Layer, statistic: Statistic) -> String {
    let name = if *layer == Layer::Color { "color".to_owned() } else { layer.prefix() };
    match statistic {
        Statistic::Mean => name,
        _ => format!("{name}.{}", statistic.suffix()),
    }
}

/// Full channel name on disk.
pub(crate) fn channel_name(layer: &Layer, statistic: Statistic, channel: &str) -> String {
    let mut name = layer.prefix();
    for piece in [statistic.suffix(), channel] {
        if !name.is_empty() && !piece.is_empty() {
            name.push('.');
        }
        name.push_str(piece);
    }
    name
}

/// Inverse of [`channel_name`]. An error says why the name means nothing.
///
/// A name without a dot that is not `R`, `G` or `B` is a feature of one channel.
pub(crate) fn parse(name: &str) -> Result<(Layer, Statistic, String), &'static str> {
    if name.split('.').any(str::is_empty) {
        return Err("a piece of the name is empty");
    }
    let Some((path, channel)) = name.rsplit_once('.') else {
        return parse_bare(name);
    };
    if let Some(optional) = path.strip_prefix(OPTIONAL) {
        let layer = Layer::optional_from_name(optional).ok_or("there is no such optional statistic")?;
        return Ok((layer, Statistic::Mean, channel.to_owned()));
    }
    let (prefix, statistic) = split_statistic(path);
    let layer = match (prefix, statistic) {
        ("", _) => Layer::Color,
        _ => Layer::from_name(prefix),
    };
    if !layer.has(statistic) {
        return Err("this layer has no such statistic");
    }
    Ok((layer, statistic, channel.to_owned()))
}

fn parse_bare(name: &str) -> Result<(Layer, Statistic, String), &'static str> {
    if RGB.contains(&name) {
        return Ok((Layer::Color, Statistic::Mean, name.to_owned()));
    }
    if split_statistic(name).0.is_empty() {
        return Err("this name is a layer and needs a channel");
    }
    let layer = Layer::from_name(name);
    let channel = match layer.channels() {
        Some([only]) => (*only).to_owned(),
        Some(_) => return Err("this name is a layer of several channels"),
        None => "Y".to_owned(),
    };
    Ok((layer, Statistic::Mean, channel))
}

/// `albedo.variance` → `("albedo", Variance)`, `variance` → `("", Variance)`.
fn split_statistic(path: &str) -> (&str, Statistic) {
    let (prefix, last) = path.rsplit_once('.').unwrap_or(("", path));
    let found = Statistic::ALL.into_iter().find(|s| *s != Statistic::Mean && s.suffix() == last);
    found.map_or((path, Statistic::Mean), |statistic| (prefix, statistic))
}

/// Channel names for an image, or a feature of no fixed kind, with this many planes.
pub(crate) fn default_channels(count: usize) -> Vec<String> {
    let letters: &[&str] = match count {
        1 => Y,
        2 => &["X", "Y"],
        3 => RGB,
        4 => &["R", "G", "B", "A"],
        _ => return (0..count).map(|k| k.to_string()).collect(),
    };
    letters.iter().map(|&name| name.to_owned()).collect()
}

/// Sorts channel names into plane order: letters as in RGB, XYZ and UV, alpha behind them, numbers by value.
/// Undoes the alphabetical order of the format for every result of [`default_channels`].
pub(crate) fn sort_by_plane<T>(channels: &mut [(String, T)]) {
    const LETTERS: [&str; 10] = ["R", "G", "B", "X", "Y", "Z", "W", "U", "V", "A"];
    channels.sort_by_cached_key(|(name, _)| {
        let letter = LETTERS.iter().position(|l| l.eq_ignore_ascii_case(name)).unwrap_or(LETTERS.len());
        (letter, name.parse::<u64>().unwrap_or(u64::MAX), name.clone())
    });
}

/// The colour channel that is missing from a free set of channels, if some of them, but not all, are there.
/// A lone `R` passes: some programs call every single channel so.
pub(crate) fn missing_of_rgb<'a>(channels: impl Iterator<Item = &'a str> + Clone) -> Option<&'static str> {
    let has = |name: &str| channels.clone().any(|channel| channel == name);
    if !has("G") && !has("B") {
        return None;
    }
    RGB.iter().copied().find(|name| !has(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        let extra = || Layer::Feature(FeatureId::Extra("ViewLayer.Position".into()));
        let mut layers: Vec<Layer> = FeatureId::KNOWN.into_iter().map(Layer::Feature).collect();
        layers.extend([Layer::Color, Layer::FlashBase, Layer::FlashLight, Layer::FlashReady]);
        layers.extend([extra(), Layer::Samples, Layer::FlashCovariance, Layer::Part(0), Layer::Part(17)]);
        for name in ["third-moment", "least", "four-parts", "box-cox:0.5:0.001", "position"] {
            let statistic: frame::Statistic = name.parse().unwrap();
            layers.extend((0..statistic.row().images.len()).map(|image| Layer::optional(statistic, image)));
        }
        for layer in layers {
            for statistic in Statistic::ALL.into_iter().filter(|s| layer.has(*s)) {
                for channel in layer.channels().unwrap_or(&["3"]) {
                    let name = channel_name(&layer, statistic, channel);
                    let expected = (layer.clone(), statistic, (*channel).to_owned());
                    assert_eq!(parse(&name), Ok(expected), "{name}");
                }
            }
        }
    }

    #[test]
    fn names_on_disk_are_the_documented_ones() {
        let albedo = Layer::Feature(FeatureId::Albedo);
        assert_eq!(channel_name(&Layer::Color, Statistic::Mean, "R"), "R");
        assert_eq!(channel_name(&Layer::Color, Statistic::HalfA, "G"), "halfA.G");
        assert_eq!(channel_name(&albedo, Statistic::Variance, "B"), "albedo.variance.B");
        assert_eq!(channel_name(&Layer::Samples, Statistic::HalfA, "Y"), "samples.halfA.Y");
        assert_eq!(channel_name(&Layer::Part(3), Statistic::Mean, "R"), "part3.R");
        assert_eq!(title(&Layer::Color, Statistic::Variance), "color.variance");
        let name = |statistic: &str, image| {
            channel_name(&Layer::optional(statistic.parse().unwrap(), image), Statistic::Mean, "R")
        };
        assert_eq!(name("third-moment", 0), "optional.third-moment.R");
        assert_eq!(name("four-parts", 3), "optional.four-parts.part3.R");
        assert_eq!(name("box-cox:-0.5:0.01", 1), "optional.box-cox:-0.5:0.01.variance.R");
    }

    #[test]
    fn bare_names_are_colour_or_single_channel_features() {
        assert_eq!(parse("depth"), Ok((Layer::Feature(FeatureId::Depth), Statistic::Mean, "Z".into())));
        let extra = Layer::Feature(FeatureId::Extra("dzdx".into()));
        assert_eq!(parse("dzdx"), Ok((extra, Statistic::Mean, "Y".into())));
        for wrong in [
            "variance",
            "halfA",
            "albedo",
            "flashCov.variance.R",
            ".R",
            "a..R",
            "",
            "samples.variance.Y",
            "optional.least.thirdMoment.R",
            "optional.four-parts.R",
        ] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn every_default_channel_set_survives_alphabetical_order() {
        for count in 1..=12 {
            let planes = default_channels(count);
            let mut on_disk: Vec<(String, usize)> = planes.iter().cloned().zip(0..).collect();
            on_disk.sort();
            sort_by_plane(&mut on_disk);
            assert!(on_disk.iter().map(|(_, k)| *k).eq(0..count), "{on_disk:?}");
        }
    }

    #[test]
    fn partial_colour_is_noticed() {
        let missing = |names: &[&'static str]| missing_of_rgb(names.iter().copied());
        assert_eq!(missing(&["R", "G"]), Some("B"));
        assert_eq!(missing(&["G", "B", "A"]), Some("R"));
        assert_eq!(missing(&["R"]), None);
        assert_eq!(missing(&["X", "Y"]), None);
    }
}
