//! Frames that recipes run methods on.

use std::borrow::Cow;
use std::sync::OnceLock;

use noisefloor_frame::{Frame, Samples, Statistic};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene, hard_case};

/// Columns and rows of most frames: no multiple of any tile or vector, and quick.
pub(crate) const SIZE: (usize, usize) = (23, 17);
/// Samples per pixel unless they are what a recipe is about.
pub(crate) const SPP: u32 = 16;

/// A frame as a method sees it, with a name.
#[derive(Debug)]
pub(crate) struct Case {
    /// A phrase.
    pub name: Cow<'static, str>,
    /// The frame, sanitised.
    pub frame: Frame,
    /// Whether its values are so near the end of the number range that a method may have no answer.
    pub extreme: bool,
}

impl Case {
    /// Sanitises the frame, as whoever hands one to a method does.
    ///
    /// # Panics
    /// If no pixel has a colour; recipes make no such frame, as nobody hands one to a method.
    pub fn new(name: impl Into<Cow<'static, str>>, mut frame: Frame) -> Self {
        frame.sanitize().expect("every frame of a recipe has a pixel with a colour");
        Self { name: name.into(), frame, extreme: false }
    }

    /// The complete frame, changed.
    pub fn edited(name: impl Into<Cow<'static, str>>, edit: impl FnOnce(&mut Frame)) -> Self {
        let mut frame = complete().clone();
        edit(&mut frame);
        Self::new(name, frame)
    }
}

/// Optional statistics that methods can need.
pub(crate) const STATISTICS: [Statistic; 3] = [Statistic::ThirdMoment, Statistic::Least, Statistic::Greatest];

/// A frame with every buffer that a synthetic scene has.
///
/// # Panics
/// If a side is 0 or above 65536; recipes ask for none.
pub(crate) fn render(width: usize, height: usize, spp: u32, seed: u64) -> Frame {
    let law = SampleLaw::LogNormal { sigma: 0.7 };
    let scene = SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, width, height);
    scene.expect("the law and the sizes of recipes are in range").render_with(spp, seed, &STATISTICS)
}

/// [`render`] at the usual size and samples, made once.
pub(crate) fn complete() -> &'static Frame {
    static FRAME: OnceLock<Frame> = OnceLock::new();
    FRAME.get_or_init(|| render(SIZE.0, SIZE.1, SPP, 11))
}

/// The complete frame that says another number of samples of itself.
pub(crate) fn counted(samples: Samples) -> Frame {
    Frame { samples, ..complete().clone() }
}

/// Hard cases of the synthetic scenes by name.
pub(crate) fn known(names: &[&'static str]) -> Vec<Case> {
    let cases = names.iter().filter_map(|name| hard_case(name));
    cases.map(|case| Case::new(case.name, case.raw)).collect()
}
