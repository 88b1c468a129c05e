//! Equal planes: inputs that must be independent cannot agree bit for bit.

use std::collections::BTreeMap;

use noisefloor_frame::{Estimate, Image};
use serde::{Deserialize, Serialize};

/// Hashes of the colour planes of an input, each with its name: `mean`, `half A`, `half B`, `part 3`.
///
/// Planes without noise are left out, because two noise-free renderings rightly agree: those of one value, and those whose
/// variance is known to be zero everywhere.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Planes(BTreeMap<String, String>);

impl Planes {
    /// Of mean and half buffers.
    #[must_use]
    pub fn of(color: &Estimate) -> Self {
        let mut out = Self::default();
        let noisy = |channel: usize| match &color.variance {
            Some(variance) => {
                variance.mean_variance().planes().nth(channel).is_none_or(|p| p.iter().any(|v| *v != 0.0))
            }
            None => true,
        };
        out.add("mean", &color.mean, noisy);
        if let Some([a, b]) = &color.halves {
            out.add("half A", a, noisy);
            out.add("half B", b, noisy);
        }
        out
    }

    /// With the parts of a reference.
    #[must_use]
    pub fn with_parts(mut self, parts: &[Image]) -> Self {
        for (k, part) in parts.iter().enumerate() {
            self.add(&format!("part {k}"), part, |_| true);
        }
        self
    }

    fn add(&mut self, name: &str, image: &Image, noisy: impl Fn(usize) -> bool) {
        for (channel, plane) in image.planes().enumerate() {
            let first = plane[0].to_bits(); // an image has a pixel
            if plane.iter().all(|v| v.to_bits() == first) || !noisy(channel) {
                continue;
            }
            let mut hasher = blake3::Hasher::new();
            let mut bytes = Vec::with_capacity(plane.len() * 4);
            plane.iter().for_each(|v| bytes.extend_from_slice(&v.to_bits().to_le_bytes()));
            hasher.update(&bytes);
            let channel = ["R", "G", "B"].get(channel).copied().unwrap_or("?");
            self.0.insert(format!("{name}, {channel}"), hasher.finalize().to_hex()[..32].to_owned());
        }
    }

    /// The first plane that both have, by its name in each. Only planes of the same channel are compared: those of a grey
    /// picture are equal among themselves.
    #[must_use]
    pub fn equal(&self, other: &Self) -> Option<(String, String)> {
        let channel = |name: &str| name.rsplit(' ').next().unwrap_or_default().to_owned();
        let mut by_hash: BTreeMap<(&str, String), &str> = BTreeMap::new();
        for (name, hash) in &other.0 {
            by_hash.entry((hash, channel(name))).or_insert(name);
        }
        // The mean first, whatever the order of the alphabet.
        let mut own: Vec<(&String, &String)> = self.0.iter().collect();
        own.sort_by_key(|(name, _)| (!name.starts_with("mean"), (*name).clone()));
        own.into_iter().find_map(|(name, hash)| {
            by_hash.get(&(hash.as_str(), channel(name))).map(|other| (name.clone(), (*other).to_owned()))
        })
    }

    /// The first two planes of one input that are equal although they are said to come from different samples, such as two
    /// parts of a reference.
    #[must_use]
    pub fn twins(&self) -> Option<(String, String)> {
        let names: Vec<&String> = self.0.keys().collect();
        names.iter().enumerate().find_map(|(k, name)| {
            let channel = |name: &str| name.rsplit(' ').next().map(str::to_owned);
            let twin = names[k + 1..]
                .iter()
                .find(|other| channel(name) == channel(other) && self.0[**other] == self.0[*name])?;
            Some(((*name).clone(), (*twin).clone()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefloor_frame::Variance;

    fn image(seed: usize) -> Image {
        Image::from_fn(5, 4, 3, |c, x, y| ((seed * 7919 + c * 101 + y * 13 + x * 7) % 97) as f32)
    }

    #[test]
    fn equal_planes_are_found_in_whatever_role() {
        let reference = Planes::of(&Estimate::from_mean(image(1))).with_parts(&[image(2), image(3)]);
        let frame = Estimate { halves: Some([image(4), image(3)]), ..Estimate::from_mean(image(5)) };
        let (own, other) = Planes::of(&frame).equal(&reference).unwrap();
        assert_eq!((own.as_str(), other.as_str()), ("half B, B", "part 1, B"));
        assert_eq!(Planes::of(&Estimate::from_mean(image(6))).equal(&reference), None);
        assert_eq!(reference.twins(), None);
        let twins = Planes::default().with_parts(&[image(2), image(3), image(2)]).twins().unwrap();
        assert_eq!(twins, ("part 0, B".into(), "part 2, B".into()));
    }

    #[test]
    fn planes_without_noise_may_agree() {
        let black = Estimate::from_mean(Image::new(5, 4, 3));
        assert_eq!(Planes::of(&black), Planes::default(), "one value says nothing");
        let exact = Estimate {
            variance: Some(Variance::of_mean(Image::new(5, 4, 3))),
            ..Estimate::from_mean(image(1))
        };
        assert_eq!(Planes::of(&exact), Planes::default(), "no variance, no noise");
        let grey = Estimate::from_mean(Image::from_fn(5, 4, 3, |_, x, y| (x * y) as f32));
        assert_eq!(Planes::of(&grey).twins(), None, "channels of a grey picture");
    }
}
