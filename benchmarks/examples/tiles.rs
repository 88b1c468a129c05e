use noisefloor_benchmarks::{NlmFrame, nlm_variants};
use noisefloor_kernels::InstructionSet;
use noisefloor_kernels::inside::nlm_in_tiles;
use noisefloor_kernels::nlm::NlmParams;
use std::time::Instant;
fn main() {
    let frame = NlmFrame::new(256, 256);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    let filter = std::env::args().nth(1).unwrap_or_default();
    let only = std::env::args().nth(2).unwrap_or_default();
    pool.install(|| {
        for variant in nlm_variants().iter().filter(|v| v.name.contains(&filter)) {
            for level in [InstructionSet::Avx512, InstructionSet::Avx2]
                .into_iter()
                .filter(|l| only.is_empty() || l.name() == only)
            {
                print!("{:<24}{:>8}", variant.name, level.name());
                for tile in [(64, 16), (64, 32)] {
                    let params = NlmParams::new(256, 256, 10, 0.45);
                    let inputs = frame.inputs(variant.features);
                    let t = (0..5)
                        .map(|_| {
                            let s = Instant::now();
                            std::hint::black_box(
                                nlm_in_tiles(&params, &variant.passes, &inputs, level, tile).unwrap(),
                            );
                            s.elapsed().as_secs_f64()
                        })
                        .fold(f64::INFINITY, f64::min);
                    print!(" {tile:?}{:6.2}", 1e9 * t / frame.pixel_offsets(10) as f64);
                }
                println!();
            }
        }
    });
}
