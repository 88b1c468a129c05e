//! Seconds of the whole method of rousselle2013rdfc by stage, and the memory that it takes: `cargo run --release -p
//! noisefloor-benchmarks --example rdfc [SIZE] [THREADS] [WINDOW RADIUS]`. The minimum of five runs.

use noisefloor_benchmarks::method_frame;
use noisefloor_denoiser::{Denoiser, Input, StageSeconds};
use noisefloor_kernels::InstructionSet;
use noisefloor_rdfc::{Params, Rdfc};

fn main() {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse::<usize>().expect("a number"));
    let size = args.next().unwrap_or(1024);
    let threads = args.next().unwrap_or(0);
    let radius = args.next().unwrap_or(10);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    println!(
        "{size}x{size} pixels, {} threads, {}, window radius {radius}",
        pool.current_num_threads(),
        InstructionSet::best()
    );
    for (name, position) in [("8 feature channels", false), ("10 feature channels", true)] {
        let place = if position { "position" } else { "depth" };
        let features = ["albedo", "normal", place, "visibility"].map(String::from).to_vec();
        let params = Params { features, window_radius_px: radius, ..Params::default() };
        let method = Rdfc::new(params).expect("in range");
        let frame = method_frame(size, size, position);
        let before = memory("VmRSS");
        let run = || {
            let start = std::time::Instant::now();
            let output = pool.install(|| method.denoise(&Input::new(&frame)).expect("a sound frame"));
            (start.elapsed().as_secs_f64(), output.stages)
        };
        let runs: Vec<(f64, Vec<StageSeconds>)> = (0..5).map(|_| run()).collect();
        let best = runs.iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("five runs");
        let megapixels = (size * size) as f64 / 1e6;
        println!("{name}: {:.3} s, {:.3} megapixels/s", best.0, megapixels / best.0);
        for stage in &best.1 {
            println!("  {:<14}{:>8.3} s", stage.name, stage.seconds);
        }
        if let (Some(before), Some(peak)) = (before, memory("VmHWM")) {
            println!("  memory: {before:.0} MiB before, peak {peak:.0} MiB");
        }
    }
}

/// A figure of this process in MiB, where the system tells.
fn memory(field: &str) -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(field)?.strip_prefix(':'))?;
    Some(line.split_whitespace().next()?.parse::<f64>().ok()? / 1024.0)
}
