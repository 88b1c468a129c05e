//! Seconds of `geometric-corrected` by stage: `cargo run --release -p noisefloor-benchmarks --example geometric [WIDTH]
//! [HEIGHT] [THREADS]`. Kernels of about 9 pixels, as noisy as radii from 16 samples are. The minimum of five runs.

use noisefloor_benchmarks::{noise, surfaces};
use noisefloor_denoiser::{Denoiser, Input, Output};
use noisefloor_frame::{Estimate, FeatureId, Frame, Image, Samples, Sampling, Variance};
use noisefloor_geometric::{CorrectedParams, GeometricCorrected, Material};
use noisefloor_kernels::InstructionSet;

/// Standard error of the mean relative to it.
const ERROR: f32 = 0.2;

fn frame(width: usize, height: usize) -> Frame {
    let mut noise = noise();
    let mean = Image::from_fn(width, height, 3, |c, x, y| {
        (0.3 + 0.2 * surfaces(c, x, y)) * (1.0 + noise(ERROR)).max(0.0)
    });
    // Relative error of a variance from 16 samples, common to the channels.
    let spread = Image::from_fn(width, height, 1, |_, _, _| (1.0 + noise((2.0f32 / 15.0).sqrt())).max(0.0));
    let variance = Image::from_fn(width, height, 3, |c, x, y| {
        let level = 0.3 + 0.2 * surfaces(c, x, y);
        (level * ERROR).powi(2) / 3.0 * spread.get(0, x, y)
    });
    let color = Estimate { mean, variance: Some(Variance::of_mean(variance)), halves: None };
    let mut frame = Frame::from_color(color, Samples::uniform(16), Sampling::Independent);
    let patch = |x: usize, y: usize, side: usize| ((x / side) * 7 + (y / side) * 3) % 5;
    let features = [
        (FeatureId::Material, Image::from_fn(width, height, 1, |_, x, y| patch(x, y, 60) as f32)),
        (FeatureId::Albedo, Image::from_fn(width, height, 3, |_, x, y| 0.1 + 0.2 * patch(x, y, 60) as f32)),
        (
            FeatureId::Depth,
            Image::from_fn(width, height, 1, |_, x, y| 3.0 + 1e-3 * x as f32 + (y / 97 % 3) as f32),
        ),
        (
            FeatureId::Normal,
            Image::from_fn(width, height, 3, |c, x, _| if x / 111 % 3 == c { 1.0 } else { 0.1 }),
        ),
    ];
    frame.features.extend(features.map(|(id, mean)| (id, Estimate::from_mean(mean))));
    frame
}

fn main() {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse::<usize>().expect("a number"));
    let (width, height) = (args.next().unwrap_or(1280), args.next().unwrap_or(960));
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(args.next().unwrap_or(0)).build().expect("threads start");
    println!("{width}x{height} pixels, {} threads, {}", pool.current_num_threads(), InstructionSet::best());
    let frame = frame(width, height);
    for material in [Material::Ids, Material::Albedo] {
        let params = CorrectedParams { material, pixels_per_error: 20.0, ..CorrectedParams::default() };
        let method = GeometricCorrected::new(params).expect("in range");
        let run = || {
            let start = std::time::Instant::now();
            let output = pool.install(|| method.denoise(&Input::new(&frame)).expect("a sound frame"));
            (start.elapsed().as_secs_f64(), output)
        };
        let runs: Vec<(f64, Output)> = (0..5).map(|_| run()).collect();
        let (seconds, best) = runs.iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("five runs");
        println!("{material:?}: {seconds:.3} s, {} {:.2}", best.figures[0].name, best.figures[0].value);
        for stage in &best.stages {
            println!("  {:<14}{:>8.3} s", stage.name, stage.seconds);
        }
    }
}
