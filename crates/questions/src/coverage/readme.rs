use noisefloor_study::exhibit::{Table, TableCell};
use noisefloor_study::format;
use noisefloor_study::summary::SceneSummary;

use super::exhibit::{Covered, covered};
use crate::readme::{Block, Chosen, Kind, headed, plain, push};

pub(super) const KINDS: &[Kind] = &[Kind { name: "coverage", keys: &["scenes", "spp"], make: coverage }];

fn coverage(chosen: &Chosen<'_>) -> Vec<Block> {
    chosen.per_scene(|scene| Some(table(chosen, scene, &covered(chosen.view, &scene.id)?)))
}

fn table(chosen: &Chosen<'_>, scene: &SceneSummary, covered: &Covered<'_>) -> Table {
    let nominal = covered.nominal.iter().map(|n| format!("nominal {}", format::percent_short(*n)));
    let lowest = covered.nominal.first().map_or_else(String::new, |n| format::percent_short(*n));
    let sides = ["above", "below"].map(|side| format!("truth {side} {lowest}"));
    let first = std::iter::once("samples per pixel".to_owned());
    let heads = first.chain(nominal).chain(["constant".into(), "missed events".into()]).chain(sides);
    let mut out = headed(format!("coverage-{}", scene.id), heads);
    for (_, spp, cells) in
        covered.rows.iter().filter(|(class, spp, _)| *class == "all" && chosen.spp.contains(spp))
    {
        let cells = cells.iter().map(plain);
        push(&mut out, std::iter::once(TableCell::count((*spp).into())).chain(cells).collect());
    }
    out
}
