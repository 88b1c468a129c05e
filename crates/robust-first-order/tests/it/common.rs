//! Frames with known truth.

use noisefloor_denoiser::{Denoiser, Diagnostics, Input, Output};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling, Variance};
use noisefloor_robust_first_order::{Params, RobustFirstOrder};

/// Standard normal numbers by SplitMix64 and Box–Muller.
pub struct Normals {
    state: u64,
    spare: Option<f64>,
}

impl Normals {
    pub fn new(seed: u64) -> Self {
        Self { state: seed, spare: None }
    }

    fn uniform(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn next(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        let (r, angle) = ((-2.0 * u.ln()).sqrt(), std::f64::consts::TAU * v);
        self.spare = Some(r * angle.sin());
        r * angle.cos()
    }
}

/// Halves of normal noise around `truth`; their mean has the standard deviation `sd` and says so.
pub fn estimate(truth: &Image, sd: f32, normals: &mut Normals) -> Estimate {
    let mut half = || truth.map(|v| v + sd * std::f32::consts::SQRT_2 * normals.next() as f32);
    let halves = [half(), half()];
    Estimate {
        mean: halves[0].zip_map(&halves[1], |a, b| 0.5 * (a + b)),
        variance: Some(Variance::of_mean(truth.map(|_| sd * sd))),
        halves: Some(halves),
    }
}

/// A smooth ramp of three channels in [0.2, 0.8].
pub fn ramp(width: usize, height: usize) -> Image {
    Image::from_fn(width, height, 3, |c, x, y| {
        0.2 + 0.5 * x as f32 / width as f32 + 0.05 * (y as f32 / height as f32) + 0.02 * c as f32
    })
}

/// Two halves, dark and bright, with a texture that a feature shows too.
pub fn step(width: usize, height: usize) -> Image {
    Image::from_fn(width, height, 3, |c, x, y| {
        let side = if 2 * x < width { 0.2 } else { 0.6 };
        side + 0.1 * ((x / 4 + y / 4 + c) % 2) as f32
    })
}

/// Samples of `truth` with features: the truth itself as texture, a flat normal, a slanted depth.
pub fn frame(truth: &Image, sd: f32, seed: u64) -> Frame {
    let mut normals = Normals::new(seed);
    let color = estimate(truth, sd, &mut normals);
    let mut frame = Frame::from_color(color, Samples::uniform(16), Sampling::Independent);
    let (w, h) = (truth.width(), truth.height());
    let mut add = |id, truth: &Image, sd| frame.features.insert(id, estimate(truth, sd, &mut normals));
    add(FeatureId::Albedo, truth, 0.01);
    add(FeatureId::Normal, &Image::from_fn(w, h, 3, |c, _, _| f32::from(c == 2)), 0.0);
    add(FeatureId::Depth, &Image::from_fn(w, h, 1, |_, x, _| 5.0 + 0.01 * x as f32), 0.001);
    frame
}

/// A frame without any noise, and without features.
pub fn exact(truth: &Image) -> Frame {
    let variance = Some(Variance::of_mean(truth.map(|_| 0.0)));
    let color = Estimate { mean: truth.clone(), variance, halves: Some([truth.clone(), truth.clone()]) };
    Frame::from_color(color, Samples::uniform(16), Sampling::Independent)
}

/// The frame at `exposure` times its own.
pub fn exposed(frame: &Frame, exposure: f64) -> Frame {
    let times = |image: &Image, by: f64| image.map(|v| (f64::from(v) * by) as f32);
    let mut out = frame.clone();
    out.color.mean = times(&frame.color.mean, exposure);
    out.color.halves = frame.color.halves.as_ref().map(|h| h.each_ref().map(|half| times(half, exposure)));
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance);
    out.color.variance = variance.map(|v| Variance::of_mean(times(v, exposure * exposure)));
    out
}

pub fn run(params: &Params, frame: &Frame) -> Output {
    let method = RobustFirstOrder::new(params.clone()).unwrap();
    method.denoise(&Input::new(frame)).unwrap_or_else(|e| panic!("{e}"))
}

pub fn diagnose(params: &Params, frame: &Frame) -> Output {
    let input = Input::new(frame).with_diagnostics(Diagnostics::On { probe: None });
    let method = RobustFirstOrder::new(params.clone()).unwrap();
    method.denoise(&input).unwrap_or_else(|e| panic!("{e}"))
}

pub fn diagnostic<'a>(output: &'a Output, name: &str) -> &'a Image {
    &output.diagnostics.iter().find(|d| d.name == name).unwrap_or_else(|| panic!("no `{name}`")).image
}

pub fn figure(output: &Output, name: &str) -> f64 {
    output.figures.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no `{name}`")).value
}

pub fn largest_difference(a: &Image, b: &Image) -> f32 {
    a.data().iter().zip(b.data()).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

pub fn squared_error(image: &Image, truth: &Image) -> f64 {
    let square = |(a, b): (&f32, &f32)| (f64::from(*a) - f64::from(*b)).powi(2);
    image.data().iter().zip(truth.data()).map(square).sum::<f64>() / image.data().len() as f64
}
