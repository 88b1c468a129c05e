//! Speed of the non-local means engine: variants and instruction sets on one thread, one thread against two, and the
//! naive loop for the ratio. Elements of the throughput are pixel-offsets: a pixel and one neighbour inside the image.
//! On a busy machine look at the lower end of the interval.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_benchmarks::{NlmFrame, NlmVariant, nlm_variants};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::nlm::{NlmParams, filter_at, naive};

/// Window radius of rousselle2013rdfc for most scenes.
const RADIUS: usize = 10;

fn run(frame: &NlmFrame, variant: &NlmVariant, level: InstructionSet) {
    let params = NlmParams::new(frame.width, frame.height, RADIUS, 0.45);
    let filtered = filter_at(&params, &variant.passes, &frame.inputs(variant.features), level);
    black_box(filtered.expect("valid input"));
}

fn levels() -> impl Iterator<Item = InstructionSet> {
    // Without hardware fused multiply-add in the binary the portable form takes minutes: see the small image.
    let whole = |level: &InstructionSet| *level != InstructionSet::Portable || cfg!(target_arch = "aarch64");
    InstructionSet::ALL.into_iter().rev().filter(|level| level.is_available()).filter(whole)
}

fn variants(criterion: &mut Criterion) {
    let frame = NlmFrame::new(512, 512);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    for variant in nlm_variants() {
        let mut group = criterion.benchmark_group(format!("kernels/nlm/512x512/{}", variant.name));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        group.throughput(Throughput::Elements(frame.pixel_offsets(RADIUS)));
        for level in levels() {
            group.bench_function(level.name(), |bencher| {
                pool.install(|| bencher.iter(|| run(&frame, &variant, level)));
            });
        }
        group.finish();
    }
}

fn threads(criterion: &mut Criterion) {
    let frame = NlmFrame::new(1024, 1024);
    let mut group = criterion.benchmark_group("kernels/nlm/1024x1024");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    group.throughput(Throughput::Elements(frame.pixel_offsets(RADIUS)));
    let variants = nlm_variants();
    for variant in variants.iter().filter(|v| ["colour_f3", "candidates_8_features"].contains(&v.name)) {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            let id = BenchmarkId::new(variant.name, format!("threads_{threads}"));
            group.bench_function(id, |bencher| {
                pool.install(|| bencher.iter(|| run(&frame, variant, InstructionSet::best())));
            });
        }
    }
    group.finish();
}

fn against_the_naive_loop(criterion: &mut Criterion) {
    let frame = NlmFrame::new(64, 48);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let params = NlmParams::new(frame.width, frame.height, RADIUS, 0.45);
    for variant in nlm_variants() {
        // The naive derivative runs every weight four times; the plain variants tell the ratio.
        if variant.passes.iter().any(|pass| pass.derivative) {
            continue;
        }
        let mut group = criterion.benchmark_group(format!("kernels/nlm/64x48/{}", variant.name));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        group.throughput(Throughput::Elements(frame.pixel_offsets(RADIUS)));
        for level in InstructionSet::ALL.into_iter().filter(|level| level.is_available()) {
            group.bench_function(level.name(), |bencher| {
                pool.install(|| bencher.iter(|| run(&frame, &variant, level)));
            });
        }
        let inputs = frame.inputs(variant.features);
        group.bench_function("naive_f32", |bencher| {
            bencher.iter(|| {
                naive::filter_f32(black_box(&params), &variant.passes, &inputs).expect("valid input")
            });
        });
        group.finish();
    }
}

criterion_group!(benches, variants, threads, against_the_naive_loop);
criterion_main!(benches);
