//! Seconds of nonlinearly weighted first-order regression, for the whole method by stage and for its two filters beside their
//! naive twins: `cargo run --release -p noisefloor-benchmarks --example nfor [WIDTH] [HEIGHT] [LEVEL]`, with LEVEL an instruction
//! set. The minimum of three runs; the twins run once, on an image of 40×30 pixels.

use std::time::Instant;

use noisefloor_baselines::nfor::{Nfor, Params, Profile};
use noisefloor_benchmarks::{method_frame, naive_patch_means, naive_regression, patch_means, regression};
use noisefloor_denoiser::{Denoiser, Input, Output};
use noisefloor_frame::Frame;
use noisefloor_kernels::InstructionSet;

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
    let filters: [fn(&Frame); 2] = [regression, patch_means];
    let twins: [fn(&Frame); 2] = [naive_regression, naive_patch_means];
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
