//! Which channels of a file form which buffer.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use noisefloor_frame::{FeatureId, Finding, FindingKind, Image};

use crate::IoError;
use crate::aliases;
use crate::arrange::arrange;
use crate::decode::{Buffers, Opened, Target};
use crate::names::{Layer, Statistic, missing_of_rgb, parse, sort_by_plane, title};

type Key = (Layer, Statistic);

/// Statistics of a layer that mean nothing without another.
pub(crate) const NEEDED_BY: [(Statistic, Statistic); 5] = [
    (Statistic::Variance, Statistic::Mean),
    (Statistic::HalfA, Statistic::Mean),
    (Statistic::HalfB, Statistic::Mean),
    (Statistic::HalfB, Statistic::HalfA),
    (Statistic::HalfA, Statistic::HalfB),
];

/// The layers of a file that can be used.
#[derive(Debug)]
pub(crate) struct Layers {
    /// Indices of their channels in the file, in plane order.
    found: BTreeMap<Key, Vec<usize>>,
    /// What was left out, or read under another name.
    pub(crate) findings: Vec<Finding>,
}

/// Whether a layer decides what the colour of a frame or a reference is: where it is wrong, so is the frame.
/// Everything else that cannot be used is left out and told.
fn is_core(layer: &Layer) -> bool {
    matches!(layer, Layer::Color | Layer::Samples | Layer::Part(_))
}

impl Layers {
    /// Sorts the channels of the wanted layers by layer and checks that each layer is complete.
    pub(crate) fn find(opened: &Opened, wanted: impl Fn(&Layer, Statistic) -> bool) -> Result<Self, IoError> {
        let file = &opened.file;
        let mut findings = Vec::new();
        let mut named: BTreeMap<Key, Vec<(String, usize)>> = BTreeMap::new();
        for (index, channel) in opened.channels.iter().enumerate() {
            match parse(&channel.name) {
                Ok((layer, statistic, piece)) if wanted(&layer, statistic) => {
                    named.entry((layer, statistic)).or_default().push((piece, index));
                }
                Ok(_) => {}
                Err(why) => findings.push(left_out(&channel.name, why)),
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
        let mut found = BTreeMap::new();
        for ((layer, statistic), channels) in named {
            let order: Vec<String> = match layer.channels() {
                Some(fixed) => fixed.iter().map(|&name| name.to_owned()).collect(),
                // The statistics of a freely named feature have the channels of its mean. Without a mean they mean
                // nothing, and are left out below.
                None => free_sets.get(&layer).cloned().unwrap_or_default(),
            };
            let layer_title = title(&layer, statistic);
            let part = layer.channels().is_none().then(|| missing_of_rgb(order.iter().map(String::as_str)));
            if let Some(Some(channel)) = part {
                findings.push(left_out(&layer_title, &format!("it has no channel `{channel}`")));
                continue;
            }
            if order.is_empty() {
                found.insert((layer, statistic), channels.iter().map(|(_, index)| *index).collect());
                continue;
            }
            match arrange(&channels, &order, !is_core(&layer)) {
                Ok(arranged) => {
                    findings
                        .extend(arranged.words.map(|(kind, text)| Finding::new(kind, &layer_title, text)));
                    found.insert((layer, statistic), arranged.indices);
                }
                Err(problem) if is_core(&layer) => return Err(problem.error(file, layer_title, &order)),
                Err(problem) => findings.push(left_out(&layer_title, &problem.words())),
            }
        }
        let mut layers = Self { found, findings };
        layers.prune();
        layers.point_out();
        Ok(layers)
    }

    /// Leaves out statistics without the layers that give them a meaning, and half a flash image.
    fn prune(&mut self) {
        let layers: BTreeSet<Layer> =
            self.found.keys().map(|(layer, _)| layer.clone()).filter(|layer| !is_core(layer)).collect();
        for layer in &layers {
            for (one, other) in NEEDED_BY {
                self.drop_without(layer, one, (layer, other));
            }
        }
        self.prune_optional();
        let parts = [Layer::FlashBase, Layer::FlashLight, Layer::FlashCovariance];
        for (one, other) in [(0, 1), (1, 0), (2, 0), (2, 1)] {
            for statistic in Statistic::ALL {
                self.drop_without(&parts[one], statistic, (&parts[other], Statistic::Mean));
            }
        }
    }

    /// Leaves out optional statistics of which an image is missing.
    fn prune_optional(&mut self) {
        let names = self.found.keys().filter_map(|(layer, _)| match layer {
            Layer::Optional(name, _) => Some(name.clone()),
            _ => None,
        });
        for name in names.collect::<BTreeSet<_>>() {
            let images =
                name.parse().map_or(0, |found: noisefloor_frame::Statistic| found.row().images.len());
            let all: Vec<Layer> = (0..images).map(|k| Layer::Optional(name.clone(), k)).collect();
            for other in &all {
                for one in &all {
                    self.drop_without(one, Statistic::Mean, (other, Statistic::Mean));
                }
            }
        }
    }

    fn drop_without(&mut self, layer: &Layer, statistic: Statistic, needed: (&Layer, Statistic)) {
        let key = (layer.clone(), statistic);
        if !self.found.contains_key(&(needed.0.clone(), needed.1)) && self.found.remove(&key).is_some() {
            let why = format!("there is no `{}`", title(needed.0, needed.1));
            self.findings.push(left_out(&title(layer, statistic), &why));
        }
    }

    /// Points out layers that no method reads by default and that look like ones that they do read.
    fn point_out(&mut self) {
        let titles = self.titles();
        for (layer, statistic) in self.found.keys() {
            if let (Layer::Feature(FeatureId::Extra(name)), Statistic::Mean) = (layer, statistic)
                && let Some(ours) = aliases::meant(name)
            {
                let there = titles.contains(&ours) || titles.contains(&format!("color.{ours}"));
                let text = aliases::words(&ours, there);
                self.findings.push(Finding::new(FindingKind::UnreadLayer, name, text));
            }
        }
    }

    pub(crate) fn get(&self, layer: &Layer, statistic: Statistic) -> Option<&[usize]> {
        self.found.get(&(layer.clone(), statistic)).map(Vec::as_slice)
    }

    pub(crate) fn keys(&self) -> impl Iterator<Item = &Key> {
        self.found.keys()
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
        for ((layer, statistic), channels) in self.found {
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

fn left_out(what: &str, why: &str) -> Finding {
    Finding::new(FindingKind::LayerLeftOut, what, format!("left out: {why}"))
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
