//! Speed of nonlinearly weighted first-order regression: the whole method on one thread and two, and its two filters beside
//! their plain loops in `f64`, on an image small enough for them. Elements of the throughput are pixels. The sources
//! report no seconds for a processor; their public program takes 200 CPU seconds for 1024×1024 pixels.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_baselines::nfor::{Nfor, Params, Profile};
use noisefloor_benchmarks::{method_frame, naive_patch_means, naive_regression, patch_means, regression};
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_frame::Frame;

fn whole_method(criterion: &mut Criterion) {
    let (width, height) = (640, 480);
    let mut group = criterion.benchmark_group(format!("nfor/{width}x{height}"));
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    group.throughput(Throughput::Elements((width * height) as u64));
    let frame = method_frame(width, height, false);
    for (name, profile) in [("program", Profile::Program), ("best", Profile::Best)] {
        let method = Nfor::new(Params { profile, ..Params::default() }).expect("in range");
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            group.bench_function(BenchmarkId::new(name, format!("threads_{threads}")), |bencher| {
                bencher.iter(|| {
                    pool.install(|| black_box(method.denoise(&Input::new(&frame)).expect("a sound frame")))
                });
            });
        }
    }
    group.finish();
}

fn against_the_plain_loops(criterion: &mut Criterion) {
    let frame = method_frame(40, 30, false);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    type Forms = [fn(&Frame); 2];
    let filters: [(&str, Forms); 2] =
        [("regression", [regression, naive_regression]), ("patch_means", [patch_means, naive_patch_means])];
    for (name, forms) in filters {
        let mut group = criterion.benchmark_group(format!("nfor/40x30/{name}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        group.throughput(Throughput::Elements(frame.pixels() as u64));
        for (form, run) in ["fast", "naive_f64"].into_iter().zip(forms) {
            group.bench_function(form, |bencher| pool.install(|| bencher.iter(|| run(&frame))));
        }
        group.finish();
    }
}

criterion_group!(benches, whole_method, against_the_plain_loops);
criterion_main!(benches);
