//! A reference, ready to have frames held against it.

use noisefloor_frame::{Counts, Finding, FindingKind, Frame, Image, Reference, Sampling, SquaredError};

use crate::blocks::Blocks;
use crate::brightness::{self, Brightness};
use crate::sums::sums;
use crate::{Planes, Sketch, dependence, picture, variance};

/// A reference with what all frames need of it.
#[derive(Debug)]
pub struct Against<'a> {
    pub(crate) reference: &'a Reference,
    /// Samples per pixel of the reference, if known.
    pub(crate) spp: Option<f64>,
    pub(crate) exact: bool,
    pub(crate) blocks: Blocks,
    /// w = (m² + ε)^-½ per block, with m the block's mean and √ε a tenth of the image's: smooth, so that the reference's
    /// own noise does not weigh itself.
    pub(crate) weights: Vec<f64>,
    finite: Vec<bool>,
    pub(crate) planes: Planes,
}

/// What a frame's mean is expected to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mean {
    /// That of the reference: samples of the same image, their number not chosen by what was seen.
    OfTheReference,
    /// Another one, as with adaptive samples, or photon maps that the reference does not share.
    Biased,
}

/// What the checks of one frame found.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameCheck {
    /// Findings without a subject, for the caller to name.
    pub findings: Vec<Finding>,
    /// Whether the brightness of the whole image could be tested.
    pub brightness: Brightness,
    /// What [`crate::among`] needs.
    pub sketch: Sketch,
}

/// Of a reference, √ε in units of its mean.
const DARK: f64 = 0.1;

impl<'a> Against<'a> {
    /// `spp` are the samples per pixel of the reference, where they are known.
    #[must_use]
    pub fn new(reference: &'a Reference, spp: Option<f64>) -> Self {
        let mean = reference.mean();
        let blocks = Blocks::new(mean.width(), mean.height());
        let finite: Vec<bool> =
            (0..mean.pixels()).map(|p| mean.planes().all(|plane| plane[p].is_finite())).collect();
        let (mut sum, mut count) = (vec![0.0; blocks.count()], vec![0.0; blocks.count()]);
        for pixel in (0..mean.pixels()).filter(|&p| finite[p]) {
            let block = blocks.of(pixel);
            sum[block] += f64::from(grey(mean, pixel));
            count[block] += 1.0;
        }
        let all = sum.iter().sum::<f64>().abs() / count.iter().sum::<f64>().max(1.0);
        let floor = DARK * all;
        let weight = |(sum, count): (&f64, &f64)| {
            let brightness = (sum / count.max(1.0)).hypot(floor);
            if brightness > 0.0 { 1.0 / brightness } else { 1.0 }
        };
        let weights = sum.iter().zip(&count).map(weight).collect();
        let planes = Planes::of(&reference.frame.color).with_parts(&reference.parts);
        let exact = reference.squared_error() == SquaredError::Exact;
        Self { reference, spp: spp.filter(|n| *n >= 1.0), exact, blocks, weights, finite, planes }
    }

    /// Whether a pixel takes part: finite in the reference and not flagged.
    pub(crate) fn usable(&self, pixel: usize, invalid: &[bool]) -> bool {
        self.finite[pixel] && !invalid.get(pixel).is_some_and(|bad| *bad)
    }

    /// Σ w·g over the reference.
    pub(crate) fn light(&self) -> f64 {
        let mean = self.reference.mean();
        let one = |p: usize| self.weights[self.blocks.of(p)] * f64::from(grey(mean, p));
        (0..mean.pixels()).filter(|&p| self.finite[p]).map(one).sum()
    }

    /// What is wrong with the reference alone: parts or halves that are equal although they are said to be independent.
    #[must_use]
    pub fn alone(&self) -> Vec<Finding> {
        self.planes.twins().map(|(a, b)| twins(&a, &b)).into_iter().collect()
    }

    /// Holds a frame against the reference; `invalid` flags pixels that are not part of it (empty: none).
    ///
    /// A frame of another size is not looked at.
    #[must_use]
    pub fn frame(&self, frame: &Frame, invalid: &[bool], mean: Mean) -> FrameCheck {
        let planes = Planes::of(&frame.color);
        let mut out = FrameCheck {
            findings: planes.twins().map(|(a, b)| twins(&a, &b)).into_iter().collect(),
            brightness: Brightness::NotTested,
            sketch: Sketch { planes, ..Sketch::default() },
        };
        if !frame.color.mean.same_shape(self.reference.mean()) {
            return out;
        }
        if let Some((own, other)) = out.sketch.planes.equal(&self.planes) {
            out.findings.push(Finding::new(
                FindingKind::EqualData,
                "",
                format!("its {own} is bit for bit the reference's {other}: not independent"),
            ));
            return out;
        }
        let biased = mean == Mean::Biased
            || matches!(frame.samples.total(), Counts::PerPixel(_))
                && frame.samples.total().uniform().is_none();
        let blocks = sums(self, frame, invalid);
        out.findings.extend(dependence::frame(self, frame, invalid));
        let independent = out.findings.is_empty();
        let whole = brightness::whole(frame, &blocks);
        let picture = picture::frame(
            self,
            &frame.color.mean,
            invalid,
            &blocks,
            whole,
            brightness::by_pixels(frame, &blocks),
        );
        let another = picture.is_some();
        out.findings.extend(picture);
        out.brightness = if biased { Brightness::NotTested } else { whole };
        if !biased && !another {
            let found = brightness::findings(self, frame, &blocks, whole);
            let differs = found.is_some();
            out.findings.extend(found);
            if frame.sampling == Sampling::Independent && independent {
                out.findings.extend(variance::frame(self, frame, &blocks, differs));
            }
        }
        out.sketch = Sketch {
            sound: !another && !biased,
            ..Sketch::of(self, frame, invalid, &blocks, whole, out.sketch.planes)
        };
        out
    }

    /// Holds an image of which nothing but its values is known, such as a denoised one, against the reference. Only what
    /// no denoiser does is told: equal planes, and another picture for which is found what makes it fit.
    #[must_use]
    pub fn image(&self, image: &Image) -> Vec<Finding> {
        if !image.same_shape(self.reference.mean()) {
            return Vec::new();
        }
        let planes = Planes::of(&noisefloor_frame::Estimate::from_mean(image.clone()));
        if let Some((_, other)) = planes.equal(&self.planes) {
            let text =
                format!("it is bit for bit the reference's {other}: test and reference are not independent");
            return vec![Finding::new(FindingKind::EqualData, "", text)];
        }
        picture::image(self, image).into_iter().collect()
    }
}

fn twins(a: &str, b: &str) -> Finding {
    Finding::new(
        FindingKind::EqualData,
        "",
        format!("its {a} and its {b} are equal bit for bit: not independent"),
    )
}

/// Mean of the three channels.
pub(crate) fn grey(image: &Image, pixel: usize) -> f32 {
    (image.plane(0)[pixel] + image.plane(1)[pixel] + image.plane(2)[pixel]) / 3.0
}
