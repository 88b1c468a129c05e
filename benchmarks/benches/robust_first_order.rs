//! Speed of the whole method of liu2018robust on flat surfaces with noise, on one thread and two. Elements of the throughput are
//! pixels. The source reports no seconds.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_benchmarks::{method_frame, one_model};
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_robust_first_order::RobustFirstOrder;

fn whole_method(criterion: &mut Criterion) {
    for size in [256, 800] {
        let mut group = criterion.benchmark_group(format!("robust-first-order/{size}x{size}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        group.throughput(Throughput::Elements((size * size) as u64));
        let frame = method_frame(size, size, false);
        let method = RobustFirstOrder::default();
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            group.bench_function(BenchmarkId::new("surfaces", format!("threads_{threads}")), |bencher| {
                bencher.iter(|| {
                    pool.install(|| black_box(method.denoise(&Input::new(&frame)).expect("a sound frame")))
                });
            });
        }
        group.finish();
    }
}

fn one_model_against_its_hat_matrix(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("robust-first-order/one_model");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    one_model(|by_moments, by_hat_matrix| {
        group.bench_function("moments", |bencher| bencher.iter(&mut *by_moments));
        group.bench_function("hat_matrix", |bencher| bencher.iter(&mut *by_hat_matrix));
    });
    group.finish();
}

criterion_group!(benches, whole_method, one_model_against_its_hat_matrix);
criterion_main!(benches);
