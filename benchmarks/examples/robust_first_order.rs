//! Seconds of the whole method of liu2018robust by stage, models per pixel, and what its models gain over hat matrices:
//! `cargo run --release -p noisefloor-benchmarks --example robust_first_order [SIZE]`. The minimum of three runs, on one thread and two.

use std::time::Instant;

use noisefloor_benchmarks::{method_frame, one_model};
use noisefloor_denoiser::{Denoiser, Input, Output, StageSeconds};
use noisefloor_frame::{Frame, Image};
use noisefloor_kernels::InstructionSet;
use noisefloor_robust_first_order::RobustFirstOrder;

fn main() {
    let size = std::env::args().nth(1).map_or(800, |arg| arg.parse().expect("a number"));
    let method = RobustFirstOrder::default();
    for (name, frame) in [("surfaces", method_frame(size, size, false)), ("texture", textured(size))] {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            let run = || -> (f64, Output) {
                let start = Instant::now();
                let output = pool.install(|| method.denoise(&Input::new(&frame)).expect("a sound frame"));
                (start.elapsed().as_secs_f64(), output)
            };
            let runs: Vec<_> = (0..3).map(|_| run()).collect();
            let (seconds, output) = runs.iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("three runs");
            let figure = |name: &str| output.figures.iter().find(|f| f.name == name).map_or(0.0, |f| f.value);
            println!(
                "{name}, {size}x{size}, {threads} threads, {}: {seconds:.2} s, {:.2} s per megapixel, {:.0} models, {:.3} per pixel",
                InstructionSet::in_use(),
                seconds / (size * size) as f64 * 1e6,
                figure("models"),
                figure("models per pixel"),
            );
            for StageSeconds { name, seconds } in &output.stages {
                println!("  {name:<16}{seconds:>8.3} s");
            }
        }
    }
    model();
}

/// The frame of surfaces with a texture in the colour that no feature shows.
fn textured(size: usize) -> Frame {
    let mut frame = method_frame(size, size, false);
    frame.color.mean = with_texture(&frame.color.mean);
    frame.color.halves = frame.color.halves.map(|halves| halves.each_ref().map(with_texture));
    frame
}

fn with_texture(image: &Image) -> Image {
    let wave = |x: usize, y: usize| 0.3 * (x as f32 * 1.3).sin() * (y as f32 * 0.9).cos();
    Image::from_fn(image.width(), image.height(), 3, |c, x, y| image.get(c, x, y) + wave(x, y))
}

fn model() {
    one_model(|by_moments, by_hat_matrix| {
        let (fast, slow) = (time(200, by_moments), time(2, by_hat_matrix));
        println!(
            "one model, one bandwidth: {:.1} us, with its hat matrix {:.0} us: {:.0} times",
            fast * 1e6,
            slow * 1e6,
            slow / fast
        );
    });
}

/// Least seconds of one of `count` calls, of five goes.
fn time(count: u32, call: &mut dyn FnMut()) -> f64 {
    let mut go = || {
        let start = Instant::now();
        (0..count).for_each(|_| call());
        start.elapsed().as_secs_f64() / f64::from(count)
    };
    (0..5).map(|_| go()).fold(f64::INFINITY, f64::min)
}
