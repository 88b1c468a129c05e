//! How fast this machine renders.

use std::time::Instant;

use noisefloor_render::{Prepared, Recorded, RenderRequest, Silent, render};

/// Camera samples per second.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rate {
    pub(super) per_second: f64,
}

/// Seconds of rendering that are enough to tell.
const ENOUGH: f64 = 0.25;

/// Most samples per pixel, whatever the clock says.
const MOST: u32 = 256;

/// Renders the first built-in scene at 64×48 pixels, with more samples until it takes a quarter of a second: less than a
/// second in all, since each try has four times the samples of the one before.
pub(super) fn rate() -> anyhow::Result<Rate> {
    let scenes = noisefloor_scenes::builtin();
    let scene = scenes.iter().find(|entry| !entry.photon_mapped).unwrap_or(&scenes[0]);
    let prepared = Prepared::new(&(scene.build)())?;
    let mut spp = 1;
    loop {
        let request = RenderRequest {
            record: Recorded::color_only(),
            max_memory: crate::memory::allowed(None),
            ..RenderRequest::new(&prepared, 64, 48, spp)
        };
        let start = Instant::now();
        let frame = render(&request, &Silent)?;
        let seconds = start.elapsed().as_secs_f64();
        if seconds >= ENOUGH || spp >= MOST {
            let samples = frame.pixels() as f64 * f64::from(spp);
            return Ok(Rate { per_second: samples / seconds.max(1e-9) });
        }
        spp *= 4;
    }
}
