//! Path samples per second on one thread and on all: Cornell boxes and the built-in scenes at depth 8, with the colour
//! alone and with every feature and the virtual flash.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_render::{Prepared, Record, RenderRequest, Silent, render};
use noisefloor_scenes::find;

const SIZE: usize = 256;
const SPP: u32 = 4;

fn path_samples(c: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    for id in ["cornell-diffuse", "cornell", "toaster", "outdoor"] {
        let scene = Prepared::new(&(find(id).expect("it is built in").build)()).expect("it is valid");
        let mut group = c.benchmark_group(format!("render/{id}"));
        group.throughput(Throughput::Elements((SIZE * SIZE) as u64 * u64::from(SPP)));
        group.sample_size(10);
        for (name, record) in [("colour", Record::color_only()), ("everything", Record::Available)] {
            let request = RenderRequest { record, ..RenderRequest::new(&scene, SIZE, SIZE, SPP) };
            let frame = || black_box(render(&request, &Silent).expect("the request is valid"));
            group.bench_function(format!("{name}, one thread"), |b| b.iter(|| one.install(frame)));
            if id == "cornell-diffuse" {
                group.bench_function(format!("{name}, all threads"), |b| b.iter(frame));
            }
        }
        group.finish();
    }
}

criterion_group!(benches, path_samples);
criterion_main!(benches);
