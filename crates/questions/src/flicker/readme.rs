use noisefloor_study::exhibit::TableCell;

use super::exhibit::ratio;
use crate::readme::{Block, Chosen, Kind, code, headed_by, plain, push};
use crate::shown;

pub(super) const KINDS: &[Kind] = &[Kind { name: "flicker", keys: &[], make: flicker }];

fn flicker(chosen: &Chosen<'_>) -> Vec<Block> {
    let heads = [
        "sequence",
        "samples per pixel",
        "row",
        "temporal variance",
        "ratio to the first row",
        "squared error",
    ];
    let mut out = headed_by("flicker", &heads);
    let all = &chosen.view.summary.flicker;
    // Sequences in their order, each with all its rows.
    let mut sequences: Vec<&str> = Vec::new();
    for f in all {
        if !sequences.contains(&f.sequence.as_str()) {
            sequences.push(&f.sequence);
        }
    }
    for f in sequences.into_iter().flat_map(|name| all.iter().filter(move |f| f.sequence == name)) {
        let cells = vec![
            TableCell::text(&f.sequence),
            TableCell::count(f.spp.into()),
            code(&f.label),
            plain(&shown::value(&f.variance)),
            plain(&ratio(f)),
            plain(&shown::value(&f.squared_error)),
        ];
        push(&mut out, cells);
    }
    vec![Block::Table(out)]
}
