//! Seconds of nonlinearly weighted first-order regression, for the whole method by stage and for its two filters beside their
//! naive twins: `cargo run --release -p noisefloor-benchmarks --example nfor [WIDTH] [HEIGHT] [LEVEL]`, with LEVEL an instruction
//! set. The minimum of three runs; the twins run once, on an image of 40×30 pixels.

use std::time::Instant;

use noisefloor_baselines::nfor::{Nfor, Params, Profile};
use noisefloor_benchmarks::method_frame;
use noisefloor_denoiser::{Denoiser, Input, Output};
use noisefloor_frame::{FeatureId, Frame, Image, Variance};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::regression::dense::{
    Alone, Channel, Fit, Join, Planes, Solver, Weighting, means, naive, regress,
};

fn main() {
    let mut args = std::env::args().skip(1);
    let mut side = |default: usize| args.next().map_or(default, |arg| arg.parse().expect("a number"));
    let (width, height) = (side(640), side(480));
    if let Some(level) = args.next() {
        level.parse::<InstructionSet>().expect("an instruction set").force().expect("one of this processor");
    }
    println!("{width}x{height} pixels, 7 feature channels, {}", InstructionSet::in_use());
    let frame = method_frame(width, height, false);
    for (name, profile) in [("program", Profile::Program), ("best", Profile::Best)] {
        let method = Nfor::new(Params { profile, ..Params::default() }).expect("in range");
        for threads in [1, 2] {
            let (seconds, output) =
                fastest(threads, || method.denoise(&Input::new(&frame)).expect("a sound frame"));
            println!("{name}, {threads} threads: {seconds:.3} s, {}", stages(&output));
        }
    }
    let small = method_frame(40, 30, false);
    let names = ["REG", "NLM of three channels, patch 3×3"];
    let filters: [fn(&Frame); 2] = [regression, filter];
    let twins: [fn(&Frame); 2] = [naive_regression, naive_filter];
    for ((name, fast), twin) in names.into_iter().zip(filters).zip(twins) {
        let per_megapixel = |seconds: f64, frame: &Frame| 1e6 * seconds / frame.pixels() as f64;
        let [one, two] = [1, 2].map(|threads| per_megapixel(fastest(threads, || fast(&frame)).0, &frame));
        let start = Instant::now();
        twin(&small);
        let slow = per_megapixel(start.elapsed().as_secs_f64(), &small);
        println!(
            "{name}: {one:.2} s per megapixel, {two:.2} s on two threads; the f64 twin takes {:.0} times as long",
            slow / one
        );
    }
}

fn stages(output: &Output) -> String {
    let stages = output.stages.iter().map(|stage| format!("{} {:.3}", stage.name, stage.seconds));
    stages.collect::<Vec<_>>().join(", ")
}

/// The least time of three runs, and what the last gave.
fn fastest<T: Send>(threads: usize, run: impl Fn() -> T + Sync) -> (f64, T) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    let once = || {
        let start = Instant::now();
        let out = pool.install(&run);
        (start.elapsed().as_secs_f64(), out)
    };
    let mut best = once();
    for _ in 0..2 {
        let (seconds, out) = once();
        best = (seconds.min(best.0), out);
    }
    best
}

fn weighting(frame: &Frame, patch: usize) -> Weighting {
    let (width, height) = (frame.width(), frame.height());
    Weighting { width, height, window: 9, patch, k: 1.0, scale: 1.0, epsilon: 1e-7 }
}

fn guide(frame: &Frame) -> Vec<Channel<'_>> {
    let variance = frame.color.variance.as_ref().map(Variance::mean_variance).expect("a variance");
    let channels = frame.color.mean.planes().zip(variance.planes());
    channels.map(|(value, variance)| Channel { value, variance }).collect()
}

fn of_regression(frame: &Frame) -> (Fit, Planes<'_>) {
    let fit =
        Fit { weighting: weighting(frame, 3), join: Join::Minimum, solver: Solver::Dropped, positions: true };
    let features = [FeatureId::Albedo, FeatureId::Normal, FeatureId::Depth];
    let features = features.iter().filter_map(|id| frame.feature(id)).flat_map(|f| f.mean.planes()).collect();
    let image = [0, 1, 2].map(|c| frame.color.mean.plane(c));
    (fit, Planes { guide: guide(frame), features, image })
}

fn regression(frame: &Frame) {
    let (fit, planes) = of_regression(frame);
    std::hint::black_box(regress(&fit, &planes).expect("valid input"));
}

fn naive_regression(frame: &Frame) {
    let (fit, planes) = of_regression(frame);
    std::hint::black_box(naive::regress(&fit, &planes).expect("valid input"));
}

fn alone(frame: &Frame) -> Vec<Alone<'_>> {
    let image: &Image = &frame.color.mean;
    let channels = guide(frame).into_iter().zip(image.planes());
    channels.map(|(guide, target)| Alone { guide, targets: vec![target] }).collect()
}

fn filter(frame: &Frame) {
    std::hint::black_box(means(&weighting(frame, 1), &alone(frame)).expect("valid input"));
}

fn naive_filter(frame: &Frame) {
    std::hint::black_box(naive::means(&weighting(frame, 1), &alone(frame)).expect("valid input"));
}
