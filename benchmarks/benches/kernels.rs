//! Speed of the filter kernels: each instruction set, one and two threads, and the naive loop for the ratio.
//!
//! `kernels/flash_filter/vfi_1280x960` is the figure to compare with moon2013flash: both steps (7×7, then 31×31, patch
//! 5×5) on an image of that size. `…/steps_128x96` is small enough for the naive `f32` loop; times there divide into
//! the ratio, and the elements of the throughput are pixel-offsets (a pixel and one neighbour inside the image).
//! `kernels/cross_bilateral/96x64` is the bank of li2012sbf, seven guides and six planes, beside its naive loop; pixel-offsets are
//! those of the largest window. On a busy machine look at the lower end of the interval.

use std::f32::consts::{FRAC_1_SQRT_2, SQRT_2};
use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_benchmarks::{noise, surfaces};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::cross_bilateral::{self, BilateralGuide, BilateralParams, Spatial};
use noisefloor_kernels::flash_filter::{
    FlashInputs, FlashParams, Guide, Membership, PatchWeights, filter_into, naive,
};

/// A frame as from a renderer at 64 samples: flat surfaces with noise, and a guide with a tenth of it.
struct Frame {
    width: usize,
    height: usize,
    source: [Vec<f32>; 3],
    /// 99 % half-widths.
    half_width: [Vec<f32>; 3],
    guide: [Vec<f32>; 3],
    sigma_r2: Vec<f32>,
}

impl Frame {
    fn new(width: usize, height: usize) -> Self {
        let mut noise = noise();
        let mean = |i: usize, c: usize| surfaces(c, i % width, i / width);
        let planes = [0, 1, 2];
        let n = width * height;
        let (error, flash_error) = (0.05, 0.005);
        Self {
            width,
            height,
            source: planes.map(|c| (0..n).map(|i| mean(i, c) + noise(error)).collect()),
            half_width: planes.map(|_| vec![2.656 * error; n]),
            guide: planes.map(|c| (0..n).map(|i| mean(i, c) + noise(flash_error)).collect()),
            // σ_r = 2 standard errors of the guide.
            sigma_r2: vec![4.0 * flash_error * flash_error; n],
        }
    }

    fn params(&self, window_radius: usize) -> FlashParams {
        FlashParams {
            width: self.width,
            height: self.height,
            window_radius,
            spatial_sigma: (2 * window_radius + 1) as f32 / 3.0,
            patch: PatchWeights::gaussian(2, 1.25).expect("in range"),
        }
    }

    fn inputs<'a>(&'a self, source: &'a [Vec<f32>; 3], tested: bool) -> FlashInputs<'a> {
        let half_width = self.half_width.each_ref().map(Vec::as_slice);
        FlashInputs {
            source: source.each_ref().map(Vec::as_slice),
            membership: if tested { Membership::Joint(half_width) } else { Membership::Off },
            guide: Some(Guide { planes: self.guide.each_ref().map(Vec::as_slice), sigma_r2: &self.sigma_r2 }),
            before: &[],
            after: &[],
        }
    }

    /// Pixel-offsets of one pass: for each pixel the neighbours inside the image.
    fn pixel_offsets(&self, radius: usize) -> u64 {
        let line = |n: usize| -> u64 {
            (0..n).map(|i| ((i + radius + 1).min(n) - i.saturating_sub(radius)) as u64).sum()
        };
        line(self.width) * line(self.height)
    }

    fn buffer(&self) -> [Vec<f32>; 3] {
        // Written once, so that the timed part does not wait for memory pages.
        [(); 3].map(|()| vec![1.0; self.width * self.height])
    }
}

fn step(
    frame: &Frame,
    source: &[Vec<f32>; 3],
    radius: usize,
    tested: bool,
    level: InstructionSet,
    out: &mut [Vec<f32>; 3],
) {
    let [r, g, b] = out;
    filter_into(&frame.params(radius), &frame.inputs(source, tested), level, [r, g, b]).expect("valid input");
}

fn levels() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().rev().filter(|level| level.is_available())
}

fn both_steps(criterion: &mut Criterion) {
    let frame = Frame::new(1280, 960);
    let (mut first, mut second) = (frame.buffer(), frame.buffer());
    let mut group = criterion.benchmark_group("kernels/flash_filter/vfi_1280x960");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(frame.pixel_offsets(3) + frame.pixel_offsets(15)));
    // Without hardware fused multiply-add in the binary the portable form takes a minute: see the small image.
    for level in levels().filter(|&level| level != InstructionSet::Portable || cfg!(target_arch = "aarch64"))
    {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            group.bench_function(BenchmarkId::new(level.name(), format!("threads_{threads}")), |bencher| {
                bencher.iter(|| {
                    pool.install(|| {
                        step(&frame, &frame.source, 3, true, level, &mut first);
                        step(&frame, &first, 15, true, level, &mut second);
                    });
                    black_box(&second);
                });
            });
        }
    }
    group.finish();
}

fn against_the_naive_loop(criterion: &mut Criterion) {
    let frame = Frame::new(128, 96);
    let mut out = frame.buffer();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    for (name, radius, tested) in [("7x7", 3, true), ("31x31", 15, true), ("31x31_all_members", 15, false)] {
        let mut group = criterion.benchmark_group(format!("kernels/flash_filter/steps_128x96/{name}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        group.throughput(Throughput::Elements(frame.pixel_offsets(radius)));
        // One portable figure is enough: on x86-64 it is slow, see `InstructionSet::Portable`.
        for level in levels().filter(|&level| tested || level != InstructionSet::Portable) {
            group.bench_function(level.name(), |bencher| {
                pool.install(|| {
                    bencher.iter(|| {
                        step(&frame, &frame.source, radius, tested, level, &mut out);
                        black_box(&out);
                    });
                });
            });
        }
        let (params, inputs) = (frame.params(radius), frame.inputs(&frame.source, tested));
        group.bench_function("naive_f32", |bencher| {
            bencher.iter(|| naive::filter_f32(black_box(&params), black_box(&inputs)).expect("valid input"));
        });
        group.finish();
    }
}

fn bank_of_bilateral_filters(criterion: &mut Criterion) {
    let (width, height) = (96, 64);
    let frame = Frame::new(width, height);
    let values: Vec<&[f32]> = frame.guide.iter().chain(&frame.source).map(Vec::as_slice).collect();
    let variance = vec![0.01; width * height];
    let guides: Vec<_> = (0..7)
        .map(|k| BilateralGuide { value: values[k % 3], variance: &variance, sigma: [0.8, 0.25, 0.6][k / 3] })
        .collect();
    let bank = [0.0, FRAC_1_SQRT_2, 1.0, SQRT_2, 2.0, 2.0 * SQRT_2, 4.0, 4.0 * SQRT_2, 8.0].map(Spatial::new);
    let params = BilateralParams { width, height, floor: 0.01 };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let mut group = criterion.benchmark_group(format!("kernels/cross_bilateral/{width}x{height}"));
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    group.throughput(Throughput::Elements(frame.pixel_offsets(16)));
    for level in levels() {
        group.bench_function(level.name(), |bencher| {
            pool.install(|| {
                bencher.iter(|| {
                    let out = cross_bilateral::filter_at(&params, &guides, &values, &bank, level);
                    black_box(out.expect("valid input"));
                });
            });
        });
    }
    group.bench_function("naive_f32", |bencher| {
        bencher.iter(|| {
            cross_bilateral::naive::filter_f32(black_box(&params), &guides, &values, &bank)
                .expect("valid input")
        });
    });
    group.finish();
}

criterion_group!(benches, both_steps, against_the_naive_loop, bank_of_bilateral_filters);
criterion_main!(benches);
