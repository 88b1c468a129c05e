//! Which channels of a file form which buffer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use noisefloor_frame::Image;

use crate::IoError;
use crate::decode::{Buffers, Opened, Target};
use crate::names::{Layer, Statistic, missing_of_rgb, parse, sort_by_plane, title};

type Key = (Layer, Statistic);

/// The layers of a file: indices of their channels in the file, in plane order.
#[derive(Debug)]
pub(crate) struct Layers(BTreeMap<Key, Vec<usize>>);

impl Layers {
    /// Sorts the channels of the wanted layers by layer and checks that each layer is complete.
    pub(crate) fn find(opened: &Opened, wanted: impl Fn(&Layer) -> bool) -> Result<Self, IoError> {
        let file = &opened.file;
        let mut named: BTreeMap<Key, Vec<(String, usize)>> = BTreeMap::new();
        for (index, channel) in opened.channels.iter().enumerate() {
            let (layer, statistic, piece) = parse(&channel.name).map_err(|why| IoError::Mislabelled {
                file: file.clone(),
                layer: channel.name.rsplit_once('.').map_or("", |(layer, _)| layer).to_owned(),
                channel: channel.name.clone(),
                why: why.to_owned(),
            })?;
            if wanted(&layer) {
                named.entry((layer, statistic)).or_default().push((piece, index));
            }
        }
        let free_sets: BTreeMap<Layer, Vec<String>> = named
            .iter_mut()
            .filter(|((layer, statistic), _)| layer.channels().is_none() && *statistic == Statistic::Mean)
            .map(|((layer, _), channels)| {
                sort_by_plane(channels);
                (layer.clone(), channels.iter().map(|(name, _)| name.clone()).collect())
            })
            .collect();
        let mut out = BTreeMap::new();
        for ((layer, statistic), channels) in named {
            let order = match layer.channels() {
                Some(fixed) => fixed.iter().map(|&name| name.to_owned()).collect(),
                // The statistics of a freely named feature have the channels of its mean. Without a mean they mean
                // nothing, which is for the caller to notice.
                None => free_sets.get(&layer).cloned().unwrap_or_default(),
            };
            let layer_title = || title(&layer, statistic);
            if layer.channels().is_none()
                && let Some(channel) = missing_of_rgb(order.iter().map(String::as_str))
            {
                let (channel, expected) = (channel.to_owned(), "R, G, B".to_owned());
                return Err(IoError::IncompleteLayer {
                    file: file.clone(),
                    layer: layer_title(),
                    channel,
                    expected,
                });
            }
            let indices = if order.is_empty() {
                channels.iter().map(|(_, index)| *index).collect()
            } else {
                arrange(file, layer_title, &channels, &order)?
            };
            out.insert((layer, statistic), indices);
        }
        Ok(Self(out))
    }

    pub(crate) fn get(&self, layer: &Layer, statistic: Statistic) -> Option<&[usize]> {
        self.0.get(&(layer.clone(), statistic)).map(Vec::as_slice)
    }

    pub(crate) fn keys(&self) -> impl Iterator<Item = &Key> {
        self.0.keys()
    }

    pub(crate) fn titles(&self) -> Vec<String> {
        let mut titles: Vec<String> =
            self.keys().map(|(layer, statistic)| title(layer, *statistic)).collect();
        titles.sort();
        titles
    }

    /// Decodes all of them.
    pub(crate) fn decode(self, opened: Opened) -> Result<Planned, IoError> {
        let (file, width, height) = (opened.file.clone(), opened.width, opened.height);
        let mut targets = vec![Target::Skip; opened.channels.len()];
        let (mut floats, mut counts) = (BTreeMap::new(), BTreeMap::new());
        let mut planes = Vec::new();
        for ((layer, statistic), channels) in self.0 {
            if layer == Layer::Samples {
                targets[channels[0]] = Target::Count { buffer: counts.len() };
                counts.insert(statistic, counts.len());
                continue;
            }
            for (plane, &index) in channels.iter().enumerate() {
                targets[index] = Target::Float { buffer: planes.len(), plane };
            }
            floats.insert((layer, statistic), planes.len());
            planes.push(channels.len());
        }
        let buffers = opened.decode(&targets, &planes, counts.len())?;
        Ok(Planned { file, width, height, planes, floats, counts, buffers })
    }
}

/// Brings channels into the given order.
fn arrange(
    file: &std::path::Path,
    layer: impl Fn() -> String,
    channels: &[(String, usize)],
    order: &[String],
) -> Result<Vec<usize>, IoError> {
    let file = || file.to_owned();
    for (k, (name, _)) in channels.iter().enumerate() {
        if !order.contains(name) {
            let (channel, expected) = (name.clone(), order.join(", "));
            return Err(IoError::UnexpectedChannel { file: file(), layer: layer(), channel, expected });
        }
        if channels[..k].iter().any(|(earlier, _)| earlier == name) {
            return Err(IoError::DuplicateChannel { file: file(), layer: layer(), channel: name.clone() });
        }
    }
    let find = |wanted: &String| {
        let found = channels.iter().find(|(name, _)| name == wanted);
        found.map(|(_, index)| *index).ok_or_else(|| {
            let (channel, expected) = (wanted.clone(), order.join(", "));
            IoError::IncompleteLayer { file: file(), layer: layer(), channel, expected }
        })
    };
    order.iter().map(find).collect()
}

/// The decoded layers of a file, to be taken one by one.
#[derive(Debug)]
pub(crate) struct Planned {
    file: PathBuf,
    width: usize,
    height: usize,
    planes: Vec<usize>,
    floats: BTreeMap<Key, usize>,
    counts: BTreeMap<Statistic, usize>,
    buffers: Buffers,
}

impl Planned {
    pub(crate) fn has(&self, layer: &Layer) -> bool {
        self.floats.contains_key(&(layer.clone(), Statistic::Mean))
    }

    pub(crate) fn take(&mut self, layer: &Layer, statistic: Statistic) -> Option<Image> {
        let buffer = self.floats.remove(&(layer.clone(), statistic))?;
        let data = std::mem::take(&mut self.buffers.floats[buffer]);
        let image = Image::from_vec(self.width, self.height, self.planes[buffer], data);
        Some(image.expect("the decoder fills buffers of exactly this shape, which is not empty"))
    }

    /// Sample counts: `Mean` for the total, `HalfA` for the first half.
    pub(crate) fn take_counts(&mut self, statistic: Statistic) -> Result<Option<Vec<u32>>, IoError> {
        let Some(buffer) = self.counts.remove(&statistic) else { return Ok(None) };
        if let Some((pixel, value)) = self.buffers.no_count[buffer] {
            let layer = title(&Layer::Samples, statistic);
            let (x, y) = (pixel % self.width, pixel / self.width);
            let expected = "a whole number of samples";
            return Err(IoError::Count { file: self.file.clone(), layer, x, y, value, expected });
        }
        Ok(Some(std::mem::take(&mut self.buffers.counts[buffer])))
    }
}
