//! Path samples per second and core on a diffuse Cornell box, with and without features and flash.
#[path = "../tests/common/mod.rs"]
mod common;

use noisefloor_render::{Prepared, Record, RenderRequest, Silent, render};

fn main() {
    let scene = Prepared::new(&common::cornell()).expect("the box is a valid scene");
    for (name, record) in [("colour", Record::color_only()), ("everything", Record::Available)] {
        let mut request = RenderRequest { record, ..RenderRequest::new(&scene, 256, 256, 32) };
        request.depth = 8;
        let best = (0..3)
            .map(|_| {
                let frame = render(&request, &Silent).expect("the request is valid");
                frame.provenance.render_seconds.unwrap_or(f64::INFINITY)
            })
            .fold(f64::INFINITY, f64::min);
        let samples = 256.0 * 256.0 * 32.0;
        println!(
            "{name}: {:.3} M samples/s/core",
            samples / best / rayon::current_num_threads() as f64 / 1e6
        );
    }
}
