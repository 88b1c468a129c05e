//! Speed of the whole method of rousselle2013rdfc, everything of Algorithm 1 included: on one thread and two, with the
//! features of its figures (8 channels) and with positions for depths (10). Elements of the throughput are pixels. The
//! source reports 5.4 s for 1024×1024 pixels with a window radius of 10 on a GeForce GTX TITAN.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_benchmarks::method_frame;
use noisefloor_denoiser::{Denoiser, Input};
use noisefloor_rdfc::{Params, Rdfc};

fn params(position: bool) -> Params {
    let place = if position { "position" } else { "depth" };
    let features = ["albedo", "normal", place, "visibility"].map(String::from).to_vec();
    Params { features, ..Params::default() }
}

fn whole_method(criterion: &mut Criterion) {
    for size in [512, 1024] {
        let mut group = criterion.benchmark_group(format!("rdfc/{size}x{size}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        group.throughput(Throughput::Elements((size * size) as u64));
        for (name, position) in [("8_channels", false), ("10_channels", true)] {
            let frame = method_frame(size, size, position);
            let method = Rdfc::new(params(position)).expect("in range");
            for threads in [1, 2] {
                let pool =
                    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
                group.bench_function(BenchmarkId::new(name, format!("threads_{threads}")), |bencher| {
                    bencher.iter(|| {
                        pool.install(|| {
                            black_box(method.denoise(&Input::new(&frame)).expect("a sound frame"))
                        })
                    });
                });
            }
        }
        group.finish();
    }
}

criterion_group!(benches, whole_method);
criterion_main!(benches);
