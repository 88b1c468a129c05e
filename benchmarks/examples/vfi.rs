//! Seconds of the whole method of moon2013flash by stage: `cargo run --release -p noisefloor-benchmarks --example vfi
//! [WIDTH] [HEIGHT] [THREADS]`. The minimum of five runs, for each spread of the second step's test.

use noisefloor_benchmarks::flash_frame;
use noisefloor_denoiser::{Denoiser, Input, StageSeconds};
use noisefloor_kernels::InstructionSet;
use noisefloor_virtual_flash::{Params, SpreadKind, VirtualFlash};

fn main() {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse::<usize>().expect("a number"));
    let width = args.next().unwrap_or(1280);
    let height = args.next().unwrap_or(960);
    let threads = args.next().unwrap_or(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    println!("{width}x{height} pixels, {} threads, {}", pool.current_num_threads(), InstructionSet::best());
    let frame = flash_frame(width, height);
    for second_spread in [SpreadKind::Least, SpreadKind::Raw] {
        let method = VirtualFlash::new(Params { second_spread, ..Params::default() }).expect("in range");
        let run = || {
            let start = std::time::Instant::now();
            let output = pool.install(|| method.denoise(&Input::new(&frame)).expect("a sound frame"));
            (start.elapsed().as_secs_f64(), output.stages)
        };
        let runs: Vec<(f64, Vec<StageSeconds>)> = (0..5).map(|_| run()).collect();
        let best = runs.iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("five runs");
        println!("{second_spread:?}: {:.3} s", best.0);
        for stage in &best.1 {
            println!("  {:<14}{:>8.3} s", stage.name, stage.seconds);
        }
    }
}
