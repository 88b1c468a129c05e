//! Helpers of the tests.

mod bounds;
mod citations;
mod filter;
mod membership;
mod neighbors;

use noisefloor_conformance::assert_conforms;
use noisefloor_denoiser::{DenoiseError, Denoiser, Diagnostics, Guarded, Input, Need, Output, half_widths};
use noisefloor_frame::{Estimate, Flash, Frame, Image, Samples, Sampling, Variance};
use noisefloor_stats::{Level, t_quantile};
use noisefloor_synthetic::{Guides, ImageKind, MeanImage, SampleLaw, SyntheticScene};

use crate::*;

/// Uniforms in [0, 1) by SplitMix64.
fn uniforms(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}

fn image(width: usize, height: usize, mut value: impl FnMut() -> f32) -> Image {
    Image::from_fn(width, height, 3, |_, _, _| value())
}

fn estimate(mean: Image, variance: Image) -> Estimate {
    Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: None }
}

fn frame(mean: Image, variance: Image, n: u32) -> Frame {
    Frame::from_color(estimate(mean, variance), Samples::uniform(n), Sampling::Independent)
}

fn run(params: Params, frame: &Frame) -> Output {
    VirtualFlash::new(params).unwrap().denoise(&Input::new(frame)).unwrap()
}

/// Random data of every scale with fireflies, zero variances and a flash image unrelated to it.
fn wild_frame(seed: u64) -> Frame {
    let (w, h) = (37, 29);
    let mut u = uniforms(seed);
    let mean = image(w, h, || match u() {
        r if r < 0.02 => 1e6 * u(),
        r if r < 0.04 => 0.0,
        _ => 1.0 + u(),
    });
    let variance = image(w, h, || match u() {
        r if r < 0.02 => 1e10 * u(),
        r if r < 0.2 => 0.0,
        _ => 0.05 * u() * u(),
    });
    let mut f = frame(mean, variance, 16);
    let noisy = |u: &mut dyn FnMut() -> f32| {
        let mean = image(w, h, &mut *u);
        estimate(mean, image(w, h, || 0.01 * u()))
    };
    let (base, light) = (noisy(&mut u), noisy(&mut u));
    let covariance = Some(image(w, h, || 0.01 * (u() - 0.5)));
    f.flash = Some(Flash::Parts { base, light, covariance });
    f
}

const SPREADS: [SpreadKind; 4] =
    [SpreadKind::Least, SpreadKind::Raw, SpreadKind::Propagated, SpreadKind::Halves];

fn steps() -> [Params; 2] {
    [Params::default(), Params { steps: 1, ..Params::default() }]
}

fn gaussian_edge(sd: f64) -> SyntheticScene {
    let law = SampleLaw::Gaussian { sd, relative: false };
    SyntheticScene::new(MeanImage::of(ImageKind::Edges), law, 48, 32).unwrap()
}

#[test]
fn one_step_and_two_conform() {
    for params in steps() {
        assert_conforms(&VirtualFlash::new(params).unwrap());
    }
}
