use noisefloor_study::exhibit::Cell;

use super::exhibit::{implied, milliseconds};
use crate::readme::{Block, Chosen, Kind, headed_by, push};

pub(super) const KINDS: &[Kind] = &[Kind { name: "equal-time", keys: &[], make: equal_time }];

fn equal_time(chosen: &Chosen<'_>) -> Vec<Block> {
    let heads = [
        "scene",
        "row",
        "as much time as",
        "level",
        "used",
        "implied by this run",
        "denoising",
        "one sample",
    ];
    let mut out = headed_by("equal-time", &heads);
    for e in &chosen.view.summary.equal_time {
        let cells = vec![
            Cell::text(&e.scene),
            Cell::text(&e.label),
            Cell::text(&e.with),
            Cell::count(e.spp.into()),
            Cell::count(e.used.into()),
            implied(e),
            milliseconds(Some(e.denoise_seconds)),
            milliseconds(e.seconds_per_sample),
        ];
        push(&mut out, cells);
    }
    vec![Block::Table(out)]
}
