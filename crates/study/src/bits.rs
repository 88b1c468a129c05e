//! Hashes of results by their bits.

use noisefloor_frame::{Counts, Estimate, Flash, Frame, Image, Optional, Statistic, Tapped, TappedSample};

use crate::Key;

/// Collects the bits of results. Everything is preceded by its length or shape, so that nothing can be mistaken for
/// something else.
#[derive(Debug, Clone)]
pub struct Bits(blake3::Hasher);

impl Bits {
    /// Begins for a purpose: equal bits for different purposes have different hashes.
    pub fn of(purpose: &str) -> Self {
        let mut bits = Self(blake3::Hasher::new());
        bits.text(purpose);
        bits
    }

    /// A whole number.
    pub fn number(&mut self, value: u64) {
        self.0.update(&value.to_le_bytes());
    }

    /// A text, after its length.
    pub fn text(&mut self, text: &str) {
        self.number(text.len() as u64);
        self.0.update(text.as_bytes());
    }

    /// Values by their bits; which NaN it is does not count.
    pub fn values(&mut self, values: &[f32]) {
        self.number(values.len() as u64);
        for value in values {
            let bits = if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() };
            self.0.update(&bits.to_le_bytes());
        }
    }

    /// Shape and values of an image.
    pub fn image(&mut self, image: &Image) {
        for size in [image.width(), image.height(), image.channels()] {
            self.number(size as u64);
        }
        self.values(image.data());
    }

    /// Any number of images.
    pub fn images<'a>(&mut self, images: impl IntoIterator<Item = &'a Image>) {
        for image in images {
            self.number(1);
            self.image(image);
        }
        self.number(0);
    }

    fn estimate(&mut self, estimate: &Estimate) {
        let Estimate { mean, variance, halves } = estimate;
        self.image(mean);
        self.images(variance.as_ref().map(noisefloor_frame::Variance::mean_variance));
        self.images(halves.iter().flatten());
    }

    fn counts(&mut self, counts: &Counts) {
        match counts {
            Counts::Uniform(n) => self.number(u64::from(*n)),
            Counts::PerPixel(map) => {
                self.text("per pixel");
                self.number(map.len() as u64);
                map.iter().for_each(|n| self.number(u64::from(*n)));
            }
        }
    }

    /// Everything that a frame carries, apart from where it came from and how long that took.
    pub fn frame(&mut self, frame: &Frame) {
        // Without `..`: a new part of a frame must be thought of here.
        let Frame { color, features, flash, optional, samples, sampling, provenance: _ } = frame;
        self.estimate(color);
        self.number(features.len() as u64);
        for (id, estimate) in features {
            self.text(id.name());
            self.estimate(estimate);
        }
        match flash {
            None => self.text("no flash"),
            Some(Flash::Ready(flash)) => {
                self.text("flash");
                self.estimate(flash);
            }
            Some(Flash::Parts { base, light, covariance }) => {
                self.text("flash in parts");
                self.estimate(base);
                self.estimate(light);
                self.images(covariance);
            }
        }
        // Nothing where nothing was asked for: hashes of such frames are those of before there was any.
        if !optional.is_empty() {
            self.optional(optional);
        }
        self.counts(samples.total());
        self.counts(samples.half_a());
        self.text(sampling.name());
    }

    fn optional(&mut self, optional: &Optional) {
        self.text("optional");
        self.number(optional.recorded().len() as u64);
        for (statistic, images) in optional.recorded() {
            self.text(statistic.row().id);
            if let Statistic::BoxCox(transform) = statistic {
                self.number(transform.lambda().to_bits());
                self.number(transform.floor().to_bits());
            }
            self.images(images);
        }
        if let Some(parts) = optional.four_parts() {
            parts.samples.iter().for_each(|counts| self.counts(counts));
        }
        self.number(optional.tapped().len() as u64);
        for Tapped { x, y, first, samples } in optional.tapped() {
            for number in [*x as u64, *y as u64, u64::from(*first), samples.len() as u64] {
                self.number(number);
            }
            for TappedSample { color, position } in samples {
                color.iter().chain(position).for_each(|v| self.number(u64::from(v.to_bits())));
            }
        }
    }

    /// The hash in hexadecimal.
    pub fn finish(self) -> Key {
        self.0.finalize().to_hex()[..32].to_owned()
    }
}

/// Hash of everything that a frame carries.
#[must_use]
pub fn hash_of_frame(frame: &Frame) -> Key {
    let mut bits = Bits::of("frame");
    bits.frame(frame);
    bits.finish()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use noisefloor_frame::{BoxCox, Samples, Sampling, Variance};
    use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

    use super::*;

    /// With an optional statistic and a tapped pixel.
    fn with_optional(value: f32, floor: f64, position: f32) -> Frame {
        let moments = Statistic::BoxCox(BoxCox::new(0.5, floor).unwrap());
        let images = vec![Image::filled(6, 5, 3, value); 3];
        let samples = vec![TappedSample { color: [0.25; 3], position: [0.5, position] }];
        let tapped = vec![Tapped { x: 2, y: 1, first: 0, samples }];
        Frame { optional: Optional::new(vec![(moments, images)], None, tapped).unwrap(), ..probe() }
    }

    fn probe() -> Frame {
        let law = SampleLaw::Gaussian { sd: 0.3, relative: false };
        let mut frame = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, 6, 5).unwrap().render(4, 1);
        let Some(Flash::Parts { covariance, .. }) = &mut frame.flash else { panic!("the flash is in parts") };
        covariance.get_or_insert_with(|| Image::filled(6, 5, 3, 0.25));
        frame
    }

    /// Moves one value of an image to the next number above.
    fn nudge(image: &mut Image) {
        let last = image.data().len() - 1;
        let value = &mut image.data_mut()[last];
        *value = f32::from_bits(value.to_bits() ^ 1);
    }

    fn nudge_variance(estimate: &mut Estimate) {
        let mut image = estimate.variance.take().unwrap().into_mean_variance();
        nudge(&mut image);
        estimate.variance = Some(Variance::of_mean(image));
    }

    /// The frame with one bit changed in each of its planes, one after the other.
    fn perturbed() -> Vec<Frame> {
        let mut out = Vec::new();
        let parts = 1 + probe().features.len() + 2;
        for part in 0..parts {
            for plane in 0..4 {
                let mut frame = probe();
                let mut all = vec![&mut frame.color];
                all.extend(frame.features.values_mut());
                if let Some(Flash::Parts { base, light, .. }) = &mut frame.flash {
                    all.extend([base, light]);
                }
                let estimate = all.swap_remove(part);
                match plane {
                    0 => nudge(&mut estimate.mean),
                    1 if estimate.variance.is_some() => nudge_variance(estimate),
                    2 | 3 if estimate.halves.is_some() => {
                        nudge(&mut estimate.halves.as_mut().unwrap()[plane - 2]);
                    }
                    _ => continue,
                }
                out.push(frame);
            }
        }
        let mut covariance = probe();
        if let Some(Flash::Parts { covariance: Some(image), .. }) = &mut covariance.flash {
            nudge(image);
        }
        out.push(covariance);
        for samples in [Samples::uniform(5), Samples::uniform(4).with_half_a(Counts::Uniform(1))] {
            out.push(Frame { samples, ..probe() });
        }
        let mut counts = vec![4; 30];
        out.push(Frame { samples: Samples::per_pixel(counts.clone()), ..probe() });
        counts[29] = 5;
        out.push(Frame { samples: Samples::per_pixel(counts), ..probe() });
        out.push(Frame { sampling: Sampling::LowDiscrepancy, ..probe() });
        out.extend([with_optional(1.0, 1e-3, 0.5), with_optional(2.0, 1e-3, 0.5)]);
        out.extend([with_optional(1.0, 1e-2, 0.5), with_optional(1.0, 1e-3, 0.25)]);
        // A plane that is not there is not one of zeros.
        let mut without = probe();
        without.color.halves = None;
        out.push(without);
        out
    }

    #[test]
    fn any_plane_of_a_frame_changes_its_hash() {
        let all = perturbed();
        assert!(all.len() > 20, "{} frames", all.len());
        let hashes: BTreeSet<Key> = all.iter().chain([&probe()]).map(hash_of_frame).collect();
        assert_eq!(hashes.len(), all.len() + 1);
    }

    #[test]
    fn where_a_frame_came_from_and_how_long_it_took_is_no_part_of_it() {
        let mut other = probe();
        other.provenance.render_seconds = Some(7.0);
        other.provenance.extra.insert("note".into(), "x".into());
        assert_eq!(hash_of_frame(&other), hash_of_frame(&probe()));
    }
}
