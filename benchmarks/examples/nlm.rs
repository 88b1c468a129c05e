//! Nanoseconds per pixel-offset of the non-local means engine, on one thread: `cargo run --release -p
//! noisefloor-benchmarks --example nlm [SIZE]`. The minimum of five runs each; Gflop/s count what the formula needs
//! and no overhead, and their share is of what the same core makes of fused multiply-adds alone.
//!
//! The last line is for `benchmarks/peers/compare.py`: one colour filter, window 21×21, patch 7×7, seconds.

use std::time::Instant;

use noisefloor_benchmarks::{NlmFrame, NlmVariant, nlm_variants};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::inside::{MULTIPLY_ADDS, multiply_adds};
use noisefloor_kernels::nlm::{NlmParams, filter_at};

const RADIUS: usize = 10;

fn main() {
    let size = std::env::args().nth(1).and_then(|arg| arg.parse().ok()).unwrap_or(512);
    let frame = NlmFrame::new(size, size);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    println!("{size}x{size} pixels, window radius {RADIUS}, one thread, minimum of 5 runs");
    println!("{:<24}{:>10}{:>16}{:>10}{:>8}", "variant", "level", "ns/px-offset", "Gflop/s", "share");
    pool.install(|| {
        let variants = nlm_variants();
        for variant in &variants {
            for level in [InstructionSet::Avx512, InstructionSet::Avx2]
                .into_iter()
                .filter(|level| level.is_available())
            {
                let nanoseconds = 1e9 * seconds(&frame, variant, level) / frame.pixel_offsets(RADIUS) as f64;
                let rate = variant.flop.map_or_else(String::new, |flop| {
                    let rate = flop / nanoseconds;
                    format!("{rate:>10.1}{:>8.2}", rate / peak(level))
                });
                println!("{:<24}{:>10}{nanoseconds:>16.2}{rate}", variant.name, level.name());
            }
        }
        let best = seconds(&frame, &variants[1], InstructionSet::best());
        println!("peer {} {best:.6}", InstructionSet::best());
    });
}

/// Gflop/s of fused multiply-adds alone.
fn peak(level: InstructionSet) -> f64 {
    let run = || {
        let start = Instant::now();
        let lanes = multiply_adds(level).expect("an available level");
        (2 * lanes * MULTIPLY_ADDS) as f64 / start.elapsed().as_nanos() as f64
    };
    (0..50).map(|_| run()).fold(0.0, f64::max)
}

fn seconds(frame: &NlmFrame, variant: &NlmVariant, level: InstructionSet) -> f64 {
    let params = NlmParams::new(frame.width, frame.height, RADIUS, 0.45);
    let inputs = frame.inputs(variant.features);
    let run = || {
        let start = Instant::now();
        std::hint::black_box(filter_at(&params, &variant.passes, &inputs, level).expect("valid input"));
        start.elapsed().as_secs_f64()
    };
    (0..5).map(|_| run()).fold(f64::INFINITY, f64::min)
}
