use noisefloor_study::exhibit::TableCell;

use super::exhibit::{ours, theirs};
use crate::readme::{Block, Chosen, Kind, headed_by, plain, push};

pub(super) const KINDS: &[Kind] = &[Kind { name: "paper", keys: &[], make: paper }];

fn paper(chosen: &Chosen<'_>) -> Vec<Block> {
    let heads = ["what", "scene", "samples per pixel", "ours, 95 %", "source", "in words"];
    let mut out = headed_by("paper", &heads);
    for result in &chosen.view.summary.paper {
        let words = match &result.reason {
            None => result.verdict.name().to_owned(),
            Some(reason) => format!("{}: {reason}", result.verdict),
        };
        let theirs = theirs(result);
        let cells = vec![
            TableCell::text(&result.what),
            TableCell::text(chosen.view.scene_title(&result.scene)),
            TableCell::count(result.spp.into()),
            plain(&ours(result)),
            TableCell { text: format!("{} ({})", theirs.text, result.source), ..theirs },
            TableCell::text(words),
        ];
        push(&mut out, cells);
    }
    vec![Block::Table(out)]
}
