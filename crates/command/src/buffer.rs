//! Parts of a frame by name.

use noisefloor_denoiser::Need;
use noisefloor_frame::{Estimate, FeatureId, Flash, Frame, Image, Variance};

/// What of an estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Mean,
    Variance,
    HalfA,
    HalfB,
}

/// Which estimate.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Layer {
    Color,
    Feature(FeatureId),
    Flash,
}

/// One image of a frame, by the name that its layer has in files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Buffer {
    layer: Layer,
    part: Part,
}

impl Buffer {
    /// `color`, `variance`, `halfA`, `halfB`, `albedo`, `albedo.variance`, …, `flash`; any other word is a feature of that
    /// name.
    pub fn from_name(name: &str) -> Self {
        let part = |word| match word {
            "variance" => Some(Part::Variance),
            "halfA" => Some(Part::HalfA),
            "halfB" => Some(Part::HalfB),
            _ => None,
        };
        if let Some(part) = part(name) {
            return Self { layer: Layer::Color, part };
        }
        let (layer, part) = match name.rsplit_once('.') {
            Some((layer, word)) => match part(word) {
                Some(part) => (layer, part),
                None => (name, Part::Mean),
            },
            None => (name, Part::Mean),
        };
        let layer = match layer {
            "color" | "colour" => Layer::Color,
            "flash" => Layer::Flash,
            feature => Layer::Feature(FeatureId::from_name(feature)),
        };
        Self { layer, part }
    }

    /// What a frame must have for it; the mean of the colour is always there.
    pub fn need(&self) -> Option<Need> {
        match (&self.layer, self.part) {
            (Layer::Color, Part::Mean) => None,
            (Layer::Color, Part::Variance) => Some(Need::ColorVariance),
            (Layer::Color, _) => Some(Need::ColorHalves),
            (Layer::Feature(id), Part::Mean) => Some(Need::Feature(id.clone())),
            (Layer::Feature(id), Part::Variance) => Some(Need::FeatureVariance(id.clone())),
            (Layer::Feature(id), _) => Some(Need::FeatureHalves(id.clone())),
            (Layer::Flash, Part::Variance) => Some(Need::FlashVariance),
            (Layer::Flash, _) => Some(Need::Flash),
        }
    }

    /// The name of a feature that has no fixed meaning.
    pub fn extra(&self) -> Option<&str> {
        match &self.layer {
            Layer::Feature(FeatureId::Extra(name)) => Some(name),
            _ => None,
        }
    }

    /// The image, if the frame has it. Variances are those of means.
    pub fn of(&self, frame: &Frame) -> Option<Image> {
        let estimate: &Estimate = match &self.layer {
            Layer::Color => &frame.color,
            Layer::Feature(id) => frame.feature(id)?,
            Layer::Flash => match frame.flash.as_ref()? {
                Flash::Ready(ready) => ready,
                // At the intensity that its maker chose: base and light as they are.
                Flash::Parts { base, light, .. } => {
                    return (self.part == Part::Mean)
                        .then(|| base.mean.zip_map(&light.mean, |base, light| base + light));
                }
            },
        };
        match self.part {
            Part::Mean => Some(estimate.mean.clone()),
            Part::Variance => estimate.variance.as_ref().map(Variance::mean_variance).cloned(),
            Part::HalfA => estimate.halves.as_ref().map(|[a, _]| a.clone()),
            Part::HalfB => estimate.halves.as_ref().map(|[_, b]| b.clone()),
        }
    }
}
