//! Frames and images, held against a reference.

use noisefloor_frame::{Counts, Finding, FindingKind, Frame, Image, Sampling};

use crate::brightness::{self, Brightness};
use crate::sums::sums;
use crate::{Against, Planes, Sketch, dependence, picture, variance};

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

impl Against<'_> {
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
