use noisefloor_frame::{Finding, FindingKind, Frame, Image, Reference, Sampling};
use noisefloor_inputs::{Against, FrameCheck, Mean};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

pub const GAUSSIAN: SampleLaw = SampleLaw::Gaussian { sd: 0.5, relative: true };
pub const HEAVY: SampleLaw = SampleLaw::LogNormal { sigma: 1.5 };
pub const SPIKES: SampleLaw = SampleLaw::Bernoulli { q: 0.02, bright: 0.5 };
pub const RARE: SampleLaw = SampleLaw::Bernoulli { q: 0.002, bright: 0.2 };

/// Laws from harmless to hostile.
pub const LAWS: [SampleLaw; 5] = [GAUSSIAN, SampleLaw::Exponential, HEAVY, SPIKES, RARE];

pub fn scene(law: SampleLaw, width: usize, height: usize) -> SyntheticScene {
    SyntheticScene::new(MeanImage::of(ImageKind::Mixed), law, width, height)
        .unwrap()
        .with_common_channels(true)
}

/// Eight parts of 32 samples, drawn apart from every frame with a seed below 2³².
pub fn reference(scene: &SyntheticScene) -> Reference {
    let parts: Vec<Image> = (0..8).map(|k| scene.render(32, (1 << 40) + k).color.mean).collect();
    Reference::from_parts(parts, 32, Sampling::Independent).unwrap()
}

pub const REFERENCE_SPP: f64 = 256.0;

pub fn check(reference: &Reference, frame: &Frame) -> FrameCheck {
    Against::new(reference, Some(REFERENCE_SPP)).frame(frame, &[], Mean::OfTheReference)
}

pub fn found(reference: &Reference, frame: &Frame) -> Vec<Finding> {
    check(reference, frame).findings
}

/// The first finding, which must be of this kind.
pub fn first(reference: &Reference, frame: &Frame, kind: FindingKind) -> Finding {
    let found = found(reference, frame);
    assert_eq!(found.first().map(|f| f.kind), Some(kind), "{found:?}");
    found[0].clone()
}
