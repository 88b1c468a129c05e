//! Path samples and rays per second on one thread and on all: built-in scenes at depth 8, with the colour alone and
//! with the usual features and the virtual flash.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use noisefloor_frame::Frame;
use noisefloor_render::{
    PhotonMaps, PhotonSettings, Prepared, Quantity, Recorded, RenderRequest, Silent, render,
};
use noisefloor_scenes::find;

const SIZE: usize = 256;
const SPP: u32 = 4;

/// The features that nearly every published method asks for, and the flash.
const USUAL: [Quantity; 7] = [
    Quantity::Albedo,
    Quantity::Normal,
    Quantity::Depth,
    Quantity::Visibility,
    Quantity::Direct,
    Quantity::Material,
    Quantity::Flash,
];

fn prepared(id: &str) -> Prepared {
    Prepared::new(&(find(id).expect("it is built in").build)()).expect("it is valid")
}

fn frame(request: &RenderRequest<'_>) -> Frame {
    black_box(render(request, &Silent).expect("the request is valid"))
}

fn rays(frame: &Frame) -> u64 {
    frame.provenance.extra["rays"].parse().expect("the renderer counts its rays")
}

fn path_samples(c: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    for id in ["cornell-diffuse", "cornell", "toaster", "outdoor", "fog", "spin"] {
        let scene = prepared(id);
        let mut group = c.benchmark_group(format!("render/{id}"));
        group.throughput(Throughput::Elements((SIZE * SIZE) as u64 * u64::from(SPP)));
        group.sample_size(10);
        let records = [("colour", Recorded::color_only()), ("features and flash", Recorded::exactly(USUAL))];
        for (name, record) in &records {
            let request =
                RenderRequest { record: record.clone(), ..RenderRequest::new(&scene, SIZE, SIZE, SPP) };
            group.bench_function(format!("{name}, one thread"), |b| {
                b.iter(|| one.install(|| frame(&request)))
            });
            if id == "cornell-diffuse" {
                group.bench_function(format!("{name}, all threads"), |b| b.iter(|| frame(&request)));
            }
        }
        let request =
            RenderRequest { record: Recorded::color_only(), ..RenderRequest::new(&scene, SIZE, SIZE, SPP) };
        group.throughput(Throughput::Elements(rays(&frame(&request))));
        group.bench_function("rays, one thread", |b| b.iter(|| one.install(|| frame(&request))));
        group.finish();
    }
}

/// Light paths per second into the maps of a scene, and samples per second that look at them.
fn photons(c: &mut Criterion) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let scene = prepared("rings");
    let settings = PhotonSettings { paths: 50_000, caustic_paths: 200_000, ..PhotonSettings::default() };
    let maps = || PhotonMaps::new(&scene, &settings, 0).expect("the settings are valid");
    let mut group = c.benchmark_group("render/rings, photon mapping");
    group.sample_size(10);
    group.throughput(Throughput::Elements(u64::from(settings.caustic_paths)));
    group.bench_function("light paths, one thread", |b| b.iter(|| one.install(|| black_box(maps()))));
    let maps = maps();
    let size = SIZE / 2;
    let request = RenderRequest {
        integrator: noisefloor_render::Integrator::PhotonMapping,
        photons: Some(&maps),
        record: Recorded::color_only(),
        ..RenderRequest::new(&scene, size, size, SPP)
    };
    group.throughput(Throughput::Elements((size * size) as u64 * u64::from(SPP)));
    group.bench_function("samples, one thread", |b| b.iter(|| one.install(|| frame(&request))));
    group.finish();
}

criterion_group!(benches, path_samples, photons);
criterion_main!(benches);
