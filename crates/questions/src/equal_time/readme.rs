use noisefloor_study::exhibit::TableCell;

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
            TableCell::text(&e.scene),
            TableCell::text(&e.label),
            TableCell::text(&e.with),
            TableCell::count(e.spp.into()),
            TableCell::count(e.used.into()),
            implied(e),
            milliseconds(Some(e.denoise_seconds)),
            milliseconds(e.seconds_per_sample),
        ];
        push(&mut out, cells);
    }
    vec![Block::Table(out)]
}
