//! The same bits on every instruction set. On its own, as the choice is that of a whole process.

use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::Frame;
use noisefloor_kernels::InstructionSet;
use noisefloor_robust_first_order::{Params, RobustFirstOrder};
use noisefloor_synthetic::{ImageKind, MeanImage, SampleLaw, SyntheticScene};

fn frame() -> Frame {
    let law = SampleLaw::Gaussian { sd: 0.4, relative: false };
    let mut frame = SyntheticScene::new(MeanImage::of(ImageKind::Edges), law, 70, 50).unwrap().render(16, 1);
    let albedo = frame.color.clone();
    frame.features.insert(noisefloor_frame::FeatureId::Albedo, albedo);
    frame
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let frame = frame();
    let mut known: Option<Vec<u32>> = None;
    for level in InstructionSet::ALL.into_iter().filter(|level| level.is_available()) {
        level.force().unwrap();
        let output = RobustFirstOrder::new(Params::default()).unwrap().denoise(&Input::new(&frame)).unwrap();
        let images = [output.image, output.error_estimate.unwrap(), output.estimate_of.unwrap().1];
        let bits: Vec<u32> = images.iter().flat_map(|i| i.data().iter().map(|v| v.to_bits())).collect();
        assert!(known.get_or_insert_with(|| bits.clone()) == &bits, "{level}");
    }
}
