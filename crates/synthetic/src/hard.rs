//! Frames that break careless methods, for tests of methods and for telling one version of a method from another.

use noisefloor_frame::{Frame, Hygiene};

use crate::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene, broken};

/// A frame that breaks careless methods.
#[derive(Debug, Clone)]
pub struct HardCase {
    /// Stable name, a phrase.
    pub name: &'static str,
    /// The frame as it came from outside: not yet sanitised.
    pub raw: Frame,
}

impl HardCase {
    /// What a method sees: [`Frame::sanitize`] has been applied, as the contract of a denoiser promises. Buffers may
    /// still contradict each other, which [`Frame::inspect`] would refuse: a method must bear that, too.
    #[must_use]
    pub fn frame(&self) -> (Frame, Hygiene) {
        let mut frame = self.raw.clone();
        let hygiene = frame.sanitize().expect("every hard case has a pixel with a colour");
        (frame, hygiene)
    }
}

const GAUSSIAN: SampleLaw = SampleLaw::Gaussian { sd: 0.3, relative: false };
const SIZE: (usize, usize) = (40, 24);

/// A mixed scene with all features and the flash in parts, under `law`.
fn scene(law: SampleLaw, (width, height): (usize, usize)) -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, width, height)
        .expect("the laws and sizes of this file are in range")
}

fn sound() -> Frame {
    scene(GAUSSIAN, SIZE).render(16, 1)
}

/// A case: name, and how its frame is made.
type Recipe = (&'static str, fn() -> Frame);

/// [`sound`] with something broken.
fn with(edit: impl FnOnce(&mut Frame)) -> Frame {
    let mut frame = sound();
    edit(&mut frame);
    frame
}

/// A constant image of mean `level`; samples have standard deviation `sd`.
fn constant(level: f64, sd: f64) -> Frame {
    let image = MeanImage { kind: ImageKind::Constant, level, contrast: 0.0, period: 8 };
    SyntheticScene::new(image, SampleLaw::Gaussian { sd, relative: false }, SIZE.0, SIZE.1)
        .expect("level and spread are in range")
        .render(16, 2)
}

const RECIPES: &[Recipe] = &[
    ("NaN in colour, variance, features and flash", || with(|f| broken::scattered(f, f32::NAN))),
    ("infinity in colour, variance, features and flash", || with(|f| broken::scattered(f, f32::INFINITY))),
    ("negative infinity in colour, variance, features and flash", || {
        with(|f| broken::scattered(f, f32::NEG_INFINITY))
    }),
    ("a single pixel with a colour", || with(broken::one_color)),
    ("every fourth pixel NaN", || with(broken::quarter_nan)),
    ("negative radiance", || with(|f| f.color.mean = f.color.mean.map(|v| v - 0.75))),
    ("negative variances", || with(broken::negative_variances)),
    ("one sample", || scene(GAUSSIAN, SIZE).render(1, 3)),
    ("two samples", || scene(GAUSSIAN, SIZE).render(2, 4)),
    ("three samples", || scene(SampleLaw::Exponential, SIZE).render(3, 5)),
    ("zero variance everywhere", || {
        with(|f| {
            broken::zero_variance(f, &[0, 1, 2]);
            broken::zero_guide_variance(f);
        })
    }),
    ("zero variance in one channel", || with(|f| broken::zero_variance(f, &[1]))),
    ("noise-free features and flash", || with(broken::zero_guide_variance)),
    ("fireflies a million times brighter", || with(|f| broken::fireflies(f, 1e6))),
    ("rare bright samples", || scene(SampleLaw::Bernoulli { q: 0.01, bright: 1.0 }, SIZE).render(16, 6)),
    // s² near 1e-3: E[x²] − E[x]² in f32 would lose all of it.
    ("mean a million, sample variance a thousandth", || constant(1e6, 0.0316)),
    ("constant image", || constant(0.5, 0.0)),
    ("black image", || constant(0.0, 0.0)),
    ("scale 1e-8", || with(|f| broken::scaled(f, 1e-8))),
    ("scale 1e-4", || with(|f| broken::scaled(f, 1e-4))),
    ("scale 1e4", || with(|f| broken::scaled(f, 1e4))),
    ("scale 1e8", || with(|f| broken::scaled(f, 1e8))),
    ("constant features and flash", || with(broken::constant_guides)),
    ("collinear features", || with(broken::collinear_features)),
    ("background at depth zero without normal", || with(|f| broken::background(f, 0.0))),
    ("background at infinite depth", || with(|f| broken::background(f, f32::INFINITY))),
    ("black flash", || with(broken::black_flash)),
    ("ready-made flash", || scene(GAUSSIAN, SIZE).with_guides(Guides::FlashReady).render(16, 7)),
    ("no flash", || scene(GAUSSIAN, SIZE).with_guides(Guides::NoFlash).render(16, 8)),
    ("colour only", || scene(GAUSSIAN, SIZE).with_guides(Guides::None).render(16, 9)),
    ("colour without variance and halves", || {
        with(|f| {
            f.color.variance = None;
            f.color.halves = None;
        })
    }),
    ("sample counts from 1 on", || with(|f| broken::uneven_counts(f, 1))),
    ("sample counts from 2 on", || with(|f| broken::uneven_counts(f, 2))),
    ("1×1", || scene(GAUSSIAN, (1, 1)).render(16, 10)),
    ("1×1 of two samples", || scene(GAUSSIAN, (1, 1)).render(2, 11)),
    ("2×1", || scene(GAUSSIAN, (2, 1)).render(16, 12)),
    ("1×7", || scene(GAUSSIAN, (1, 7)).render(16, 13)),
    ("50×1", || scene(GAUSSIAN, (50, 1)).render(16, 14)),
    ("smaller than any window", || scene(GAUSSIAN, (5, 4)).render(16, 15)),
    ("odd width 15", || scene(GAUSSIAN, (15, 11)).render(16, 16)),
    ("odd width 33", || scene(GAUSSIAN, (33, 17)).render(16, 17)),
    ("width 64 plus 1", || scene(GAUSSIAN, (65, 9)).render(16, 18)),
];

/// All hard cases, with full features and flash unless their name says otherwise. Deterministic.
#[must_use]
pub fn hard_cases() -> Vec<HardCase> {
    RECIPES.iter().map(|(name, make)| HardCase { name, raw: make() }).collect()
}

/// The case of this name.
#[must_use]
pub fn hard_case(name: &str) -> Option<HardCase> {
    RECIPES.iter().find(|(n, _)| *n == name).map(|(name, make)| HardCase { name, raw: make() })
}
